#pragma once

#include <Eigen/Core>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// The last pairs (du, dr) of a residual, with dR = Q R updated as pairs come and go.
///
/// Pairs are stored divided by ||dr||, so that the diagonal of R shows how much each column adds to
/// the ones before it, whatever the scale of the residual was at the time.
class SecantMemory {
 public:
  /// For n unknowns and up to `capacity` pairs, at most as many as all unknowns; forgets all pairs.
  /// Vectors are allocated when a pair first needs them, and kept.
  void resize(Eigen::Index n, int capacity);
  /// Forgets all pairs. From now on P q is kept besides each column q of Q, or not.
  void clear(bool with_images = false);
  /// Pairs held.
  [[nodiscard]] int size() const { return size_; }

  /// Whether P q is kept besides each q, for `invert`.
  [[nodiscard]] bool has_images() const { return with_images_; }
  /// Whether those kept are of a P that was.
  [[nodiscard]] bool images_are_old() const { return with_images_ && images_are_old_; }
  /// Tells that P is another.
  void forget_images() { images_are_old_ = true; }
  /// Makes them anew: `apply(q, image)` for each.
  template <class Apply>
  void renew_images(Apply&& apply) {
    for (int j = 0; j < size_; ++j) {
      Vector& image = image_[static_cast<std::size_t>(j)];
      image.resize(n_);
      apply(q(j), image);
    }
    images_are_old_ = false;
  }

  /// Adds a pair, dropping the oldest ones for room and until max |R_ii| / min |R_ii| is at most
  /// `max_condition`. A pair with dr = 0 or a NaN is ignored.
  /// Cost: 4 n size() flops, twice if dr is all but dependent, and 6 n size() for each pair
  /// dropped. Allocates if so many pairs were never held.
  /// @param image  P dr, if images are kept; without it they are to be renewed
  void add(const Vector& du, const Vector& dr, double max_condition, const InnerProductRef& product,
           const Vector* image = nullptr);

  /// Begins anew with pairs whose factors are known: clear, then `append` oldest first.
  /// @param du  change of u
  /// @param q  the next orthonormal column of Q
  /// @param column  the next column of R, down to its diagonal at `size()`
  /// Images are to be renewed afterwards.
  /// @return false, and no pair is taken, if there is no room or the column adds too little
  bool append(const Vector& du, const Vector& q, const Eigen::Ref<const Eigen::VectorXd>& column,
              double max_condition);

  /// gamma = argmin ||r - dR gamma||; step = -dU gamma, remainder = r - dR gamma.
  /// Cost: 6 n size() flops. No allocation.
  void project(const Vector& r, Vector& step, Vector& remainder, const InnerProductRef& product);

  /// z = dU gamma + mixing P (r - dR gamma) without applying P, by the images; with P = 1 if there
  /// are none. Cost: 6 n size() flops, each column read once. No allocation.
  /// @param image  P r; r if there are no images
  void invert(const Vector& r, const Vector& image, double mixing, Vector& z,
              const InnerProductRef& product);

  /// Calls `walk` on every number that decides what follows, for saving and loading; `resize` must
  /// have been called.
  template <class Walker>
  void for_each_field(Walker& walk) {
    walk(size_);
    walk(first_);
    walk(with_images_);
    walk(images_are_old_);
    // Damaged, as the reader will find out.
    if (size_ < 0 || size_ > capacity_) size_ = 0;
    if (first_ < 0 || first_ >= capacity_) first_ = 0;
    for (int i = 0; i < size_; ++i) {
      du(i).resize(n_);
      q_[static_cast<std::size_t>(i)].resize(n_);
      walk(du(i));
      walk(q_[static_cast<std::size_t>(i)]);
      if (with_images_ && !images_are_old_) {
        image_[static_cast<std::size_t>(i)].resize(n_);
        walk(image_[static_cast<std::size_t>(i)]);
      }
      for (int j = 0; j <= i; ++j) walk(r_(j, i));
    }
  }
  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const {
    Eigen::Index numbers = work_.size() + r_.size();
    for (const std::vector<Vector>* vectors : {&du_, &q_, &image_}) {
      for (const Vector& v : *vectors) numbers += v.size();
    }
    return static_cast<std::size_t>(numbers) * sizeof(double);
  }
  /// Most pairs held.
  [[nodiscard]] int capacity() const { return capacity_; }

  /// Orthonormal column i of Q.
  [[nodiscard]] const Vector& q(int i) const { return q_[static_cast<std::size_t>(i)]; }

 private:
  double orthogonalise(const InnerProductRef& product);
  [[nodiscard]] bool well_conditioned(double diagonal, double max_condition) const;
  void drop_oldest(const InnerProductRef& product);
  Vectors first_of(const std::vector<Vector>& vectors);
  void find_gamma();
  void rotate(std::vector<Vector>& vectors, const InnerProductRef& product);
  Vector& du(int i) { return du_[static_cast<std::size_t>((first_ + i) % capacity_)]; }

  Eigen::Index n_ = 0;
  int capacity_ = 0;
  int size_ = 0;
  int first_ = 0;           // ring position of the oldest du
  std::vector<Vector> du_;  // ring
  std::vector<Vector> q_;   // in order, oldest first
  bool with_images_ = false;
  bool images_are_old_ = false;
  std::vector<Vector> image_;  // P q, likewise
  Eigen::MatrixXd r_;
  Vector work_;
  Eigen::VectorXd column_;  // coefficients of the newest column
  Eigen::VectorXd sums_;
  Eigen::VectorXd gamma_;
  Eigen::VectorXd cosines_;
  Eigen::VectorXd sines_;
  std::vector<const Vector*> columns_;  // those that an operation is about
  std::vector<Vector*> rotated_;
};

}  // namespace jfnk::detail

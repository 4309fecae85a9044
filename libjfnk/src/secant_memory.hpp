#pragma once

#include <Eigen/Core>

#include "jfnk/column_store.hpp"
#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// The last pairs (du, y) of a residual, y being its change, with the Gram matrix Y^T Y = R^T R.
///
/// Pairs are stored divided by ||dr||, so that the diagonal of R shows how much each column adds to
/// the ones before it, whatever the scale of the residual was at the time. Least squares are solved
/// by the normal equations: half the passes over the columns that an orthogonal basis takes, and
/// good to round-off times the square of the condition, which `max_condition` bounds.
class SecantMemory {
 public:
  /// For n unknowns and up to `capacity` pairs, at most as many as all unknowns; forgets all pairs.
  /// Vectors are allocated when a pair first needs them, and kept.
  /// @param single_precision  of the columns; the Gram matrix is that of the rounded ones
  void resize(Eigen::Index n, int capacity, bool single_precision = false);
  /// Forgets all pairs. From now on P y is kept besides each column y, or not.
  void clear(bool with_images = false);
  /// Pairs held.
  [[nodiscard]] int size() const { return size_; }

  /// Whether P y is kept besides each y, for `invert`.
  [[nodiscard]] bool has_images() const { return with_images_; }
  /// Whether those kept are of a P that was.
  [[nodiscard]] bool images_are_old() const { return with_images_ && images_are_old_; }
  /// Tells that P is another.
  void forget_images() { images_are_old_ = true; }
  /// Makes them anew: `apply(y, image)` for each.
  template <class Apply>
  void renew_images(Apply&& apply) {
    for (int j = 0; j < size_; ++j) {
      y_.copy_to(slot(j), work_);
      image_work_.resize(n_);
      apply(work_, image_work_);
      image_.assign(slot(j), 1.0, image_work_);
    }
    images_are_old_ = false;
  }

  /// A pair to be added.
  struct Pair {
    const Vector& du;
    const Vector& dr;
    double length;                  ///< ||dr||
    const Vector* image = nullptr;  ///< P dr, if images are kept; without it they are to be renewed
    /// What `project` is asked for next: its products with the columns are found on the way.
    const Vector* next = nullptr;
  };
  /// Adds a pair, dropping the oldest ones for room and until max |R_ii| / min |R_ii| is at most
  /// `max_condition`. A pair with dr = 0 or a NaN is ignored.
  /// Cost: 2 n size() flops, twice that with `next`; each column read once. Allocates if so many
  /// pairs were never held.
  void add(const Pair& pair, double max_condition, const InnerProductRef& product);
  /// Tells that `next` of the last pair is another vector by now.
  void forget_next() { next_known_ = false; }

  /// Begins anew with pairs whose factors are known: clear, then `append` oldest first.
  /// @param du  change of u
  /// @param q  the orthonormal columns of Q up to this one
  /// @param column  the next column of R, down to its diagonal at `size()`
  /// Images are to be renewed afterwards. Cost: 2 n size() flops, as many again in single
  /// precision.
  /// @return false, and no pair is taken, if there is no room or the column adds too little
  bool append(const Vector& du, const ColumnList& q,
              const Eigen::Ref<const Eigen::VectorXd>& column, double max_condition,
              const InnerProductRef& product);

  /// Begins anew with the latest pairs of before that there is room for: columns of du and of dr,
  /// oldest first. Images are to be renewed afterwards.
  void begin_with(const Eigen::MatrixXf& du, const Eigen::MatrixXf& dr, double max_condition,
                  const InnerProductRef& product);
  /// How many of these are still there: of a damaged snapshot any number.
  [[nodiscard]] int given() const { return given_; }
  /// The latest pairs, oldest first, as they are kept.
  /// @param[out] du, dr  resized
  void copy_latest(int count, Eigen::MatrixXf& du, Eigen::MatrixXf& dr,
                   const InnerProductRef& product = {}) const;

  /// gamma = argmin ||r - Y gamma||; step = -dU gamma, remainder = r - Y gamma.
  /// Cost: 6 n size() flops. No allocation.
  void project(const Vector& r, Vector& step, Vector& remainder, const InnerProductRef& product);

  /// z = sign (dU gamma + mixing P (r - Y gamma)) without applying P, by the images; with P = 1 if
  /// there are none. Cost: 6 n size() flops, each column read once. No allocation.
  /// @param image  P r; r if there are no images
  /// @param sign  1 or -1
  void invert(const Vector& r, const Vector& image, double mixing, double sign, Vector& z,
              const InnerProductRef& product);

  /// Calls `walk` on every number that decides what follows, for saving and loading; `resize` must
  /// have been called.
  template <class Walker>
  void for_each_field(Walker& walk) {
    walk(size_);
    walk(first_);
    walk(given_);
    walk(with_images_);
    walk(images_are_old_);
    // Damaged, as the reader will find out.
    if (size_ < 0 || size_ > capacity_) size_ = 0;
    if (first_ < 0 || first_ >= capacity_) first_ = 0;
    for (int i = 0; i < size_; ++i) {
      walk_column(walk, du_, slot(i));
      walk_column(walk, y_, slot(i));
      if (with_images_ && !images_are_old_) walk_column(walk, image_, slot(i));
      for (int j = 0; j <= i; ++j) walk(gram_(j, i));
      for (int j = 0; j <= i; ++j) walk(r_(j, i));
    }
  }
  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const {
    const Eigen::Index numbers = work_.size() + image_work_.size() + gram_.size() + r_.size();
    return static_cast<std::size_t>(numbers) * sizeof(double) + du_.bytes() + y_.bytes() +
           image_.bytes();
  }
  /// Most pairs held.
  [[nodiscard]] int capacity() const { return capacity_; }
  /// Column i of Y into y, oldest first.
  void copy_column(int i, Vector& y) const { y_.copy_to(slot(i), y); }

 private:
  [[nodiscard]] std::size_t slot(int i) const {
    return static_cast<std::size_t>((first_ + i) % capacity_);
  }
  /// What is in a slot; a writer leaves it, a reader puts there what it reads.
  template <class Walker>
  void walk_column(Walker& walk, ColumnStore& store, std::size_t at) {
    if (store.is_empty(at)) store.assign(at, 0.0, work_.setZero());
    store.copy_to(at, work_);
    walk(work_);
    store.assign(at, 1.0, work_);
  }
  bool extend_factor(int last, double max_condition);
  bool factorise(int size, double max_condition);
  [[nodiscard]] bool well_conditioned(int size, double max_condition) const;
  void drop_oldest();
  void list_columns(const ColumnStore& store, int count, ColumnList& list) const;
  const ColumnList& columns(const ColumnStore& store, int count);
  void store(const Pair& pair, std::size_t at, const InnerProductRef& product);
  void find_products(const Vector& r, const InnerProductRef& product);
  void find_gamma();

  Eigen::Index n_ = 0;
  int capacity_ = 0;
  int size_ = 0;
  int first_ = 0;  // slot of the oldest pair
  int given_ = 0;  // of the oldest, that were there from the beginning
  ColumnStore du_;
  ColumnStore y_;
  bool with_images_ = false;
  bool images_are_old_ = false;
  ColumnStore image_;     // P y
  Eigen::MatrixXd gram_;  // upper triangle
  Eigen::MatrixXd r_;     // its factor
  Vector work_;
  Vector image_work_;  // while images are renewed
  Eigen::VectorXd factors_;
  Eigen::VectorXd gamma_;
  bool next_known_ = false;
  Eigen::VectorXd next_;  // Y^T `next`
  ColumnList list_;
  ColumnList steps_;
};

}  // namespace jfnk::detail

#pragma once

#include <Eigen/Core>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// An approximate inverse Jacobian H = (I + w_k s_k^T) ... (I + w_1 s_1^T) P: Broyden's first
/// method (Broyden 1965), begun at a preconditioner, in product form.
///
/// Each factor makes H dr = du for one pair and leaves H as it is across du. With a preconditioner
/// that was once the inverse Jacobian this ends superlinearly, where the least squares of
/// `SecantMemory` need as many pairs as there are directions in which the Jacobian has changed.
class BroydenMemory {
 public:
  /// For n unknowns and up to `capacity` pairs; forgets all pairs. Vectors are allocated when a
  /// pair first needs them, and kept.
  void resize(Eigen::Index n, int capacity);
  /// Forgets all pairs.
  void clear() { size_ = 0; }
  /// Pairs held.
  [[nodiscard]] int size() const { return size_; }
  /// Whether there is no room for another pair.
  [[nodiscard]] bool full() const { return size_ == static_cast<int>(s_.size()); }

  /// P r becomes H r. Cost: 4 n size() flops, one sum of inner products. No allocation.
  void improve(Vector& z, const InnerProductRef& product);
  /// H r of before the last `add` becomes H r.
  void improve_by_last(Vector& z, const InnerProductRef& product) const;

  /// Adds a pair, damped so that H stays regular (Moré & Trangenstein 1976).
  /// @param du  change of u
  /// @param image  H dr, by the H of before
  /// @return false, and nothing changes, if there is no room, du = 0 or anything is not finite
  bool add(const Vector& du, const Vector& image, const InnerProductRef& product);

  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const {
    Eigen::Index numbers = along_.size();
    for (const std::vector<Vector>* vectors : {&s_, &w_}) {
      for (const Vector& v : *vectors) numbers += v.size();
    }
    return static_cast<std::size_t>(numbers) * sizeof(double);
  }

  /// Calls `walk` on every number that decides what follows, for saving and loading; `resize` must
  /// have been called.
  template <class Walker>
  void for_each_field(Walker& walk) {
    walk(size_);
    if (size_ < 0 || size_ > static_cast<int>(s_.size())) size_ = 0;  // damaged
    for (int i = 0; i < size_; ++i) {
      s_[static_cast<std::size_t>(i)].resize(n_);
      w_[static_cast<std::size_t>(i)].resize(n_);
      walk(s_[static_cast<std::size_t>(i)]);
      walk(w_[static_cast<std::size_t>(i)]);
      for (int j = 0; j < i; ++j) walk(along_(i, j));
    }
  }

 private:
  Vectors first_of(const std::vector<Vector>& vectors);

  Eigen::Index n_ = 0;
  int size_ = 0;
  std::vector<Vector> s_;
  std::vector<Vector> w_;
  Eigen::MatrixXd along_;  // s_i^T w_j, j < i: what factor i finds of those before it
  Eigen::VectorXd sums_;
  std::vector<const Vector*> columns_;  // those that an operation is about
};

}  // namespace jfnk::detail

#pragma once

#include <Eigen/Core>
#include <vector>

#include "jfnk/vector_operations.hpp"

namespace jfnk::detail {

/// Vectors of one size kept in double or in single precision, in numbered slots. Each is allocated
/// when its slot is first assigned, and kept.
class ColumnStore {
 public:
  /// For `slots` vectors of n numbers; those of another size or precision are let go.
  void resize(std::size_t slots, Eigen::Index n, bool single_precision);
  /// Slot = factor v, rounded to the precision it is kept in.
  void assign(std::size_t slot, double factor, const Vector& v,
              const InnerProductRef& product = {});
  /// Slot = factor v, and `kept` what it then holds, both of some rows: to be called for all of
  /// them, from whichever threads, after `reserve`.
  void assign_rows(std::size_t slot, double factor, const Vector& v, Rows rows);
  void copy_rows(std::size_t slot, Rows rows, Vector& kept) const;
  /// The same in single precision. @param[out] kept  those rows alone
  void copy_rows(std::size_t slot, Rows rows, Eigen::Ref<SingleVector> kept) const;
  /// Allocates a slot for n numbers.
  void reserve(std::size_t slot, Eigen::Index n);
  /// Turns slots i, i + 1: (a, b) becomes (c a + s b, c b - s a).
  void rotate(std::size_t i, double c, double s, const InnerProductRef& product = {});
  /// What is in a slot. @param[out] v  resized
  void copy_to(std::size_t slot, Vector& v, const InnerProductRef& product = {}) const;
  /// The vector in a slot: itself if it is in double precision, else a copy in `scratch`.
  const Vector& view(std::size_t slot, Vector& scratch, const InnerProductRef& product = {}) const {
    if (!is_single_) return doubles_[slot];
    copy_to(slot, scratch, product);
    return scratch;
  }
  [[nodiscard]] bool is_single() const { return is_single_; }
  /// Whether nothing was ever put there.
  [[nodiscard]] bool is_empty(std::size_t slot) const {
    return (is_single_ ? singles_[slot].size() : doubles_[slot].size()) == 0;
  }
  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const;

 private:
  friend class ColumnList;
  bool is_single_ = false;
  std::vector<Vector> doubles_;
  std::vector<SingleVector> singles_;
};

/// Vectors out of stores of one precision, in the order in which an operation takes them.
class ColumnList {
 public:
  void clear();
  void reserve(std::size_t count);
  void add(const ColumnStore& store, std::size_t slot);
  /// A vector in double precision, as are the others.
  void add(const Vector& v) { doubles_.push_back(&v); }
  [[nodiscard]] std::size_t size() const { return doubles_.size() + singles_.size(); }
  /// sums[j] = <column j, w>.
  void dots(const InnerProductRef& product, const Vector& w, double* sums) const;
  /// The same with several vectors.
  void dots(const InnerProductRef& product, std::span<const Products> products) const;
  /// w = own w + sum_j factors[j] column j; w is not read if own = 0.
  void combine(const InnerProductRef& product, double own, const double* factors, Vector& w) const;
  /// Some rows of that.
  void combine_rows(Rows rows, double own, const double* factors, Vector& w) const;

 private:
  std::vector<const Vector*> doubles_;
  std::vector<const SingleVector*> singles_;
};

}  // namespace jfnk::detail

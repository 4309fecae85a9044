#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <vector>

#include "factor_cost.hpp"
#include "jfnk/residual.hpp"
#include "lattice_pattern.hpp"
#include "symmetric_lu.hpp"

namespace jfnk::detail {

/// A sparse Jacobian whose entries are where a `LatticePattern` expects them; they follow from as
/// many products as there are colours of columns without a common row. All in the solver's units.
class LearntJacobian {
 public:
  /// Forgets everything; for n unknowns.
  void reset(Eigen::Index n);

  /// Where entries are expected, to be learnt before `group_columns`.
  [[nodiscard]] LatticePattern& pattern() { return pattern_; }

  /// Groups the columns; after the last change of the pattern.
  void group_columns();
  /// Groups that `group_columns` would make now.
  [[nodiscard]] int groups_to_come() const;
  /// Groups of columns, each of which costs a product.
  [[nodiscard]] int groups() const { return groups_; }
  /// The sum of the unit vectors of a group, n.
  void write_group(int group, Vector& v) const;
  /// The entries of a group's columns from the product of J with `write_group`.
  void read_group(int group, const Vector& product);

  /// What its factors would cost; after `group_columns`. Counting ends beyond so many entries.
  [[nodiscard]] FactorCost cost(double most_entries) const {
    return factor_cost(matrix_, order_of_elimination(matrix_), most_entries);
  }
  /// A bound of that which costs nothing: those of its band.
  [[nodiscard]] FactorCost cost_of_band() const;
  /// Factorises J + shift I. @return false if that is singular
  bool factorise(double shift);
  /// J v.
  [[nodiscard]] Vector multiply(const Vector& v) const { return matrix_ * v; }
  /// z = (J + shift I)^-1 r; after `factorise`.
  void apply(const Vector& r, Vector& z);

  /// Calls `walk` on every number that decides what `apply` does, for saving and loading; the
  /// pattern must have been walked before.
  template <class Walker>
  void for_each_field(Walker& walk) {
    if (groups_ == 0) group_columns();
    for (Eigen::Index k = 0; k < matrix_.nonZeros(); ++k) walk(matrix_.valuePtr()[k]);
    walk(shift_);
  }
  /// The shift of the last `factorise`.
  [[nodiscard]] double shift() const { return shift_; }

 private:
  bool factorise_plainly();

  Eigen::Index n_ = 0;
  LatticePattern pattern_;
  std::vector<int> group_of_;  // of each column
  int groups_ = 0;
  Eigen::SparseMatrix<double> matrix_;
  double shift_ = 0.0;
  Eigen::SparseMatrix<double> occupied_;    // J + shift I without zeros
  Order order_;                             // of its elimination
  Eigen::SparseMatrix<double> eliminated_;  // the same in that order
  SymmetricLu plain_;
  bool by_plain_ = false;  // else by those with pivots chosen
  bool analysed_ = false;  // those
  Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::NaturalOrdering<int>> factors_;
  Vector permuted_;
};

}  // namespace jfnk::detail

#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <cstdint>
#include <vector>

#include "factor_cost.hpp"
#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// A sparse Jacobian whose entries lie on few diagonals, as those of systems on lattices and chains
/// do, numbered node by node or field by field.
///
/// Single columns of J tell which diagonals are occupied; the entries then follow from as many
/// products as there are colours of columns without a common row. All in the solver's units.
class LearntJacobian {
 public:
  /// Forgets everything; for n unknowns. The main diagonal is known.
  void reset(Eigen::Index n);

  /// Learns from column j of J which diagonals are occupied; their mirror images count as well.
  /// @param column  J e_j, n; zero where F does not depend on the unknown
  /// @return whether any was new
  bool learn_column(Eigen::Index j, const Vector& column);

  /// Groups the columns; after the last `learn_column`.
  void group_columns();
  /// Groups of columns, each of which costs a product.
  [[nodiscard]] int groups() const { return groups_; }
  /// The sum of the unit vectors of a group, n.
  void write_group(int group, Vector& v) const;
  /// The entries of a group's columns from the product of J with `write_group`.
  void read_group(int group, const Vector& product);

  /// What its factors would cost; after `group_columns`. Counting ends beyond so many entries.
  [[nodiscard]] FactorCost cost(double most_entries) const {
    return factor_cost(matrix_, most_entries);
  }
  /// Factorises J + shift I. @return false if that is singular
  bool factorise(double shift);
  /// J v.
  [[nodiscard]] Vector multiply(const Vector& v) const { return matrix_ * v; }
  /// z = (J + shift I)^-1 r; after `factorise`.
  void apply(const Vector& r, Vector& z) const { z = factors_.solve(r); }

  /// Calls `walk` on every number that decides what `apply` does, for saving and loading; `reset`
  /// must have been called.
  template <class Walker>
  void for_each_field(Walker& walk) {
    std::int64_t count = static_cast<std::int64_t>(diagonals_.size());
    walk(count);
    if (count < 1 || count > 2 * n_) count = 1;  // damaged, as the reader will find out
    diagonals_.resize(static_cast<std::size_t>(count));
    for (Eigen::Index& diagonal : diagonals_) {
      walk(diagonal);
      if (diagonal < -n_ || diagonal > n_) diagonal = 0;
    }
    if (groups_ == 0) group_columns();
    for (Eigen::Index k = 0; k < matrix_.nonZeros(); ++k) walk(matrix_.valuePtr()[k]);
    walk(shift_);
  }
  /// The shift of the last `factorise`.
  [[nodiscard]] double shift() const { return shift_; }

 private:
  Eigen::Index n_ = 0;
  std::vector<Eigen::Index> diagonals_;  // row - column, ascending
  std::vector<int> group_of_;            // of each column
  int groups_ = 0;
  Eigen::SparseMatrix<double> matrix_;
  double shift_ = 0.0;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace jfnk::detail

#pragma once

#include <Eigen/SparseCore>

namespace jfnk::detail {

/// What factors of a sparse matrix would cost.
struct FactorCost {
  double entries = 0.0;     ///< of both factors
  double operations = 0.0;  ///< multiplications and additions
};

/// An order of elimination: indices()[new] = old.
using Order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;

/// The order of minimum degree.
/// @param pattern  square; values have no meaning
[[nodiscard]] Order order_of_elimination(const Eigen::SparseMatrix<double>& pattern);

/// Estimates the cost from the elimination tree, without pivoting (Liu 1990; Davis 2006, section
/// 4.5).
/// @param pattern  square, symmetric in structure; values have no meaning
/// @param most_entries  counting ends beyond so many
[[nodiscard]] FactorCost factor_cost(const Eigen::SparseMatrix<double>& pattern, const Order& order,
                                     double most_entries);

}  // namespace jfnk::detail

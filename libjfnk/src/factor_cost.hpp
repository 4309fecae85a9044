#pragma once

#include <Eigen/SparseCore>

namespace jfnk::detail {

/// What factors of a sparse matrix would cost.
struct FactorCost {
  double entries = 0.0;     ///< of both factors
  double operations = 0.0;  ///< multiplications and additions
};

/// Estimates it from the elimination tree under a minimum-degree ordering, without pivoting (Liu
/// 1990; Davis 2006, section 4.5).
/// @param pattern  square, symmetric in structure; values have no meaning
/// @param most_entries  counting ends beyond so many
[[nodiscard]] FactorCost factor_cost(const Eigen::SparseMatrix<double>& pattern,
                                     double most_entries);

}  // namespace jfnk::detail

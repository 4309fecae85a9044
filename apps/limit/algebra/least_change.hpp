#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace limit::algebra {

/// Changes x as little as it can (in the Euclidean norm) so that equations x = right_side to the
/// last digits. Equations may depend on each other as long as they do not contradict. Residuals are
/// summed in extended precision.
/// @return the largest residual that remains.
double satisfy(const Eigen::SparseMatrix<double, Eigen::RowMajor>& equations,
               const Eigen::VectorXd& right_side, Eigen::VectorXd& x);

}  // namespace limit::algebra

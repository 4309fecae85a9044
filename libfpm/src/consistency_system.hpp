#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fpm/stencil.hpp"

namespace fpm::detail {

/// Round-off of an area V_a G_ab, relative: its weights come from moment matrices with condition
/// numbers up to some hundreds.
inline constexpr double area_round_off = 1e3 * std::numeric_limits<double>::epsilon();

/// The part of differences d_b (Dim x neighbours) that no linear field explains, times kappa:
/// kappa_ab (T_a d)_b.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> weighted_remainder(
    const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights,
    const Eigen::Matrix<double, Dim, Eigen::Dynamic>& difference) {
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> weighted =
      geometry.offset * weights.kappa.asDiagonal();
  const Tensor<Dim> spread = weighted * geometry.offset.transpose();
  const Tensor<Dim> slope = difference * weighted.transpose() * spread.inverse();
  return (difference - slope * geometry.offset) * weights.kappa.asDiagonal();
}

/// A row's part of S: factor * T^T diag(kappa) T on [the row, its neighbours], dense and symmetric.
template <int Dim>
Eigen::MatrixXd row_matrix(const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights,
                           double factor) {
  const Eigen::Index count = geometry.size();
  Tensor<Dim> spread = Tensor<Dim>::Zero();
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto x = geometry.offset.col(k);
    spread += weights.kappa[k] * x * x.transpose();
  }
  // On differences d: T = I - X^T spread^-1 X diag(kappa), so diag(kappa) T is symmetric.
  const Eigen::MatrixXd weighted = geometry.offset * weights.kappa.asDiagonal();
  Eigen::MatrixXd on_differences = -(weighted.transpose() * spread.inverse() * weighted);
  on_differences.diagonal() += weights.kappa;
  on_differences *= factor;

  Eigen::MatrixXd matrix(count + 1, count + 1);
  matrix.bottomRightCorner(count, count) = on_differences;
  matrix.bottomLeftCorner(count, 1) = -on_differences.rowwise().sum();
  matrix.topRightCorner(1, count) = matrix.bottomLeftCorner(count, 1).transpose();
  matrix(0, 0) = on_differences.sum();
  return matrix;
}

/// Solves S x = b. S has the affine fields in its null space, to which b is orthogonal: a small
/// multiple of the diagonal makes it definite, and iterative refinement removes its trace. The
/// smoothest modes need the most of it, their eigenvalues are about (spacing / length)^4 of the
/// largest.
class RegularisedSolver {
 public:
  explicit RegularisedSolver(const Eigen::SparseMatrix<double>& lower) : lower_(lower) {
    constexpr double regularisation = 1e-10;
    Eigen::SparseMatrix<double> shifted = lower_;
    shifted.diagonal().array() += regularisation * lower_.diagonal().maxCoeff();
    factor_.compute(shifted);
    if (factor_.info() != Eigen::Success) {
      throw std::runtime_error("the consistency correction's matrix could not be factorised");
    }
  }

  struct Solution {
    Eigen::VectorXd x;
    double residual = 0.0;  // norm
    bool reached = false;   // the tolerance
  };

  /// @param round_off  residual below which the right-hand side means nothing
  /// @returns the best there is: a right-hand side that is not in the range of S leaves a residual
  Solution solve(const Eigen::VectorXd& right_hand_side, double round_off) const {
    constexpr double tolerance = 1e-10;  // of the residual, relative; the loads' error in a patch
    constexpr int max_refinements = 50;
    const double target = std::max(tolerance * right_hand_side.norm(), round_off);
    Solution best{Eigen::VectorXd::Zero(right_hand_side.size()), right_hand_side.norm(), false};
    Eigen::VectorXd x = factor_.solve(right_hand_side);
    for (int k = 0; k <= max_refinements; ++k) {
      const Eigen::VectorXd residual = right_hand_side - lower_.selfadjointView<Eigen::Lower>() * x;
      const double norm = residual.norm();
      if (!(norm < best.residual)) break;
      best = {x, norm, norm <= target};
      if (best.reached) break;
      x += factor_.solve(residual);
    }
    return best;
  }

 private:
  Eigen::SparseMatrix<double> lower_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace fpm::detail

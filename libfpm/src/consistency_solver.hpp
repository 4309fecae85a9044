#pragma once

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <optional>

namespace fpm::detail {

enum class SolutionMethod {
  factors,              ///< S has few entries beside those of its factors: in the plane, few rows
  conjugate_gradients,  ///< S is two neighbourhoods wide in space, and its factors fill steeply
};

/// Solves S x = b. S has the affine fields in its null space, to which b is orthogonal.
class ConsistencySolver {
 public:
  /// @param lower  triangle of S
  /// @throws std::runtime_error if factors are asked for and there are none
  ConsistencySolver(const Eigen::SparseMatrix<double>& lower, SolutionMethod method);
  ConsistencySolver(const ConsistencySolver&) = delete;  // its iterations read its own matrix
  ConsistencySolver& operator=(const ConsistencySolver&) = delete;

  struct Solution {
    Eigen::VectorXd x;
    double residual = 0.0;  // norm
    bool reached = false;   // the tolerance
    SolutionMethod method = SolutionMethod::factors;
  };

  /// @param round_off  residual below which the right-hand side means nothing
  /// @returns the best there is: a right-hand side that is not in the range of S leaves a residual.
  ///   What conjugate gradients do not reach is tried by factors
  /// @throws std::runtime_error  if there are none
  Solution solve(const Eigen::VectorXd& right_hand_side, double round_off);

 private:
  using Matrix = Eigen::SparseMatrix<double>;
  using ConjugateGradients =
      Eigen::ConjugateGradient<Matrix, Eigen::Lower, Eigen::IncompleteCholesky<double>>;

  void factorise();
  Solution refine(const Eigen::VectorXd& right_hand_side, double target, bool by_factors);

  Matrix lower_;
  std::optional<Eigen::SimplicialLDLT<Matrix>> factor_;
  std::optional<ConjugateGradients> gradients_;
};

}  // namespace fpm::detail

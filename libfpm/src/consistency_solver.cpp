#include "consistency_solver.hpp"

#include <algorithm>
#include <stdexcept>

namespace fpm::detail {

ConsistencySolver::ConsistencySolver(const Matrix& lower, SolutionMethod method) : lower_(lower) {
  if (method == SolutionMethod::factors) {
    factorise();
    return;
  }
  // Some hundred iterations are needed for 20 000 irregular rows in space.
  constexpr int max_iterations = 1000;
  gradients_.emplace();
  gradients_->setMaxIterations(max_iterations);
  gradients_->compute(lower_);
  if (gradients_->info() != Eigen::Success) gradients_.reset();
}

// A small multiple of the diagonal makes S definite, and iterative refinement removes its trace.
// The smoothest modes need the most of it, their eigenvalues are about (spacing / length)^4 of the
// largest.
void ConsistencySolver::factorise() {
  constexpr double regularisation = 1e-10;
  Matrix shifted = lower_;
  shifted.diagonal().array() += regularisation * lower_.diagonal().maxCoeff();
  factor_.emplace(shifted);
  if (factor_->info() != Eigen::Success) {
    throw std::runtime_error("the consistency correction's matrix could not be factorised");
  }
}

ConsistencySolver::Solution ConsistencySolver::refine(const Eigen::VectorXd& right_hand_side,
                                                      double target, bool by_factors) {
  // Conjugate gradients find their own residual, from which the true one departs by round-off.
  const int max_refinements = by_factors ? 50 : 3;
  const auto improvement = [&](const Eigen::VectorXd& residual, double norm) -> Eigen::VectorXd {
    if (by_factors) return factor_->solve(residual);
    gradients_->setTolerance(0.5 * target / norm);
    return gradients_->solve(residual);
  };
  const SolutionMethod method =
      by_factors ? SolutionMethod::factors : SolutionMethod::conjugate_gradients;
  Solution best{Eigen::VectorXd::Zero(right_hand_side.size()), right_hand_side.norm(), false,
                method};
  if (best.residual <= target) {  // nothing to be done, and no norm to divide by
    best.reached = true;
    return best;
  }
  Eigen::VectorXd x = improvement(right_hand_side, best.residual);
  for (int k = 0; k <= max_refinements; ++k) {
    const Eigen::VectorXd residual = right_hand_side - lower_.selfadjointView<Eigen::Lower>() * x;
    const double norm = residual.norm();
    if (!(norm < best.residual)) break;
    best = {x, norm, norm <= target, method};
    if (best.reached) break;
    x += improvement(residual, norm);
  }
  return best;
}

ConsistencySolver::Solution ConsistencySolver::solve(const Eigen::VectorXd& right_hand_side,
                                                     double round_off) {
  constexpr double tolerance = 1e-10;  // of the residual, relative; the loads' error in a patch
  const double target = std::max(tolerance * right_hand_side.norm(), round_off);
  Solution best;
  if (gradients_) {
    best = refine(right_hand_side, target, false);
    if (best.reached) return best;
  }
  if (!factor_) factorise();
  Solution by_factors = refine(right_hand_side, target, true);
  return gradients_ && best.residual < by_factors.residual ? best : by_factors;
}

}  // namespace fpm::detail

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace limit::solver {

/// Of the Newton systems H x + A' y = first, A x = second.
struct NewtonSolution {
  Eigen::VectorXd x, y;
};

/// Iterative refinement. Goes on as long as one of the two residuals is halved, and returns the
/// iterate that satisfies the equations, the second of them, best: what curvature of 1e10 makes of
/// x' last digits is no error of x.
/// @param solve  (first, second) -> NewtonSolution, roughly
/// @param left   NewtonSolution -> what is left of both sides, as a NewtonSolution
template <class Solve, class Left>
[[nodiscard]] NewtonSolution refined(const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                                     const Solve& solve, const Left& left) {
  NewtonSolution sum{Eigen::VectorXd::Zero(first.size()), Eigen::VectorXd::Zero(second.size())};
  NewtonSolution best = sum, rest{first, second};
  double least_rest = INFINITY, least_other = INFINITY;
  constexpr int most_refinements = 12;
  constexpr double enough = 1e-12;
  for (int i = 0; i <= most_refinements; ++i) {
    const NewtonSolution change = solve(rest.x, rest.y);
    sum.x += change.x;
    sum.y += change.y;
    rest = left(sum);
    const double now = rest.x.template lpNorm<Eigen::Infinity>();
    const double other = rest.y.template lpNorm<Eigen::Infinity>();
    const bool is_better = now < 0.5 * least_rest || other < 0.5 * least_other;
    if (other <= least_other) best = sum;
    least_rest = std::min(least_rest, now);
    least_other = std::min(least_other, other);
    if (!is_better || std::max(now, other) < enough) break;
  }
  return best;
}

}  // namespace limit::solver

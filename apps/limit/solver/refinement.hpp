#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace limit::solver {

/// Of the Newton systems H x + A' y = first, A x = second.
struct NewtonSolution {
  Eigen::VectorXd x, y;
};

/// Iterative refinement by generalised conjugate residuals: each correction goes as far, and along
/// with those before it, as leaves least of both sides. What a solve gets wrong in a few directions
/// only, as one does whose matrix was made definite where equations nearly depend on each other, is
/// gone after about as many corrections, however wrong. Goes on as long as what is left is halved
/// by two of them, and returns the iterate that satisfies the equations, the second of them, best.
/// @param solve  (first, second) -> NewtonSolution, roughly
/// @param left   NewtonSolution -> what is left of both sides, as a NewtonSolution
/// @param stiffness  of each x. What is left of the first equations counts over it, as an error in
///   x: what curvature of 1e10 makes of x' last digits is none.
template <class Solve, class Left>
[[nodiscard]] NewtonSolution refined(const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                                     const Solve& solve, const Left& left,
                                     const Eigen::VectorXd& stiffness) {
  struct Taken {
    NewtonSolution way, effect;
  };
  const auto weighed = [&](NewtonSolution rest) {
    rest.x.array() /= stiffness.array();
    return rest;
  };
  const auto product = [](const NewtonSolution& a, const NewtonSolution& b) {
    return a.x.dot(b.x) + a.y.dot(b.y);
  };
  std::vector<Taken> taken;
  NewtonSolution sum{Eigen::VectorXd::Zero(first.size()), Eigen::VectorXd::Zero(second.size())};
  NewtonSolution best = sum, rest{first, second};
  double least_other = INFINITY, before = INFINITY, last = INFINITY;
  constexpr int most_refinements = 20;
  constexpr double enough = 1e-12;
  for (int i = 0; i <= most_refinements; ++i) {
    NewtonSolution way = solve(rest.x, rest.y);
    const NewtonSolution now = weighed(rest), after = weighed(left({sum.x + way.x, sum.y + way.y}));
    NewtonSolution effect{now.x - after.x, now.y - after.y};
    for (const Taken& other : taken) {
      const double share = product(effect, other.effect);
      effect.x -= share * other.effect.x;
      effect.y -= share * other.effect.y;
      way.x -= share * other.way.x;
      way.y -= share * other.way.y;
    }
    const double size = std::sqrt(product(effect, effect));
    if (!(size > 0.0) || !std::isfinite(size)) break;
    for (Eigen::VectorXd* part : {&way.x, &way.y, &effect.x, &effect.y}) *part /= size;
    const double step = product(now, effect);
    sum.x += step * way.x;
    sum.y += step * way.y;
    taken.push_back({std::move(way), std::move(effect)});
    rest = left(sum);
    const double other = rest.y.template lpNorm<Eigen::Infinity>();
    const double all = std::max(weighed(rest).x.template lpNorm<Eigen::Infinity>(), other);
    if (other <= least_other) best = sum;
    least_other = std::min(least_other, other);
    if (all < enough || !(all < 0.5 * before)) break;
    before = std::exchange(last, all);
  }
  return best;
}

}  // namespace limit::solver

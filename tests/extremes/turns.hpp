#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bodies.hpp"
#include "sweep.hpp"

namespace extremes {

/// A body that was bent until it yields and is then turned as a whole: the stress that each
/// particle has in the body's frame stays, so after whole turns all is as before. In each step the
/// round-off of coordinates of order 1, over the spacing of 0.1 and times E over the stress (200),
/// strains neighbours by 2e-13 of their stress; steps add up, and a sum of some twenty neighbours
/// is ten times worse than one.
inline double drift_allowed(int steps) {
  return 10.0 * 2e-13 * steps;
}

/// Of stress, sub-points' stress, place and resultant of the internal forces, each over its size.
inline double drift_after(int turns, int steps_of_one, const verification::TestScene& scene) {
  using verification::increment_field;
  const auto model = model::build_model<2>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<2> equilibrium(model, state);
  verification::move(equilibrium, increment_field(model, state, [](const fpm::Vector<2>& x) {
                       return verification::bending<2>(x, 0.02);
                     }));
  const Eigen::MatrixXd stress = state.stress;
  const Eigen::MatrixXd deviator = state.subpoint_deviator;
  const Eigen::MatrixXd position = model.particles.position + state.displacement;
  fpm::Tensor<2> turn;
  const double angle = 2.0 * M_PI / steps_of_one;
  turn << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle), std::cos(angle) - 1.0;
  for (int k = 0; k < turns * steps_of_one; ++k) {
    verification::move(equilibrium, increment_field(model, state, [&](const fpm::Vector<2>& x) {
                         return fpm::Vector<2>(turn * x);
                       }));
  }
  const double size = stress.cwiseAbs().maxCoeff();
  double drift = (state.stress - stress).cwiseAbs().maxCoeff() / size;
  if (deviator.size() > 0) {
    drift = std::max(drift, (state.subpoint_deviator - deviator).cwiseAbs().maxCoeff() / size);
  }
  drift = std::max(
      drift, (model.particles.position + state.displacement - position).cwiseAbs().maxCoeff());
  verification::move(equilibrium, Eigen::VectorXd::Zero(model.unknowns()));
  const Eigen::VectorXd& force = equilibrium.unmasked_residual();
  for (int i = 0; i < 2; ++i) {
    const auto along = force.segment(i * model.size(), model.size());
    drift = std::max(drift, std::abs(along.sum()) / along.cwiseAbs().sum());
  }
  return drift;
}

/// An axis of turns, each of so many steps.
inline Axis turning(const std::vector<std::pair<int, int>>& turns) {
  Axis axis{"turns of a body × steps of each",
            "bent and yielded body: its stress, its place, its forces' resultant", 0.0,
            "round-off, 2e-12 of the stress in each step"};
  int most = 0;
  for (const auto& [count, steps] : turns) {
    axis.samples.push_back({fmt::format("{} × {}", count, steps), verification::body_scene({})});
    most = std::max(most, count * steps);
  }
  axis.tolerance = drift_allowed(most);
  axis.course = [turns](const verification::TestScene& scene, std::size_t k) {
    const double drift = drift_after(turns[k].first, turns[k].second, scene);
    EXPECT_LE(drift, drift_allowed(turns[k].first * turns[k].second));
    return drift;
  };
  return axis;
}

}  // namespace extremes

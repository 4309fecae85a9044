#pragma once

#include <string>
#include <vector>

#include "measure.hpp"

namespace extremes {

using verification::report;
using verification::Settings;
using Steps = std::vector<stepping::StepRecord>;
using PlaneRun = verification::Run<2>;
using SpaceRun = verification::Run<3>;

/// `key=value` or `key=[v, w]` with all digits.
inline std::string setting(const std::string& key, const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(17);
  text << key << '=';
  if (values.size() > 1) text << '[';
  for (std::size_t i = 0; i < values.size(); ++i) text << (i > 0 ? ", " : "") << values[i];
  if (values.size() > 1) text << ']';
  return text.str();
}

/// The shipped footing, 11 particles over B, to a settlement of 0.9 % of B, in units of `length`
/// metres and `stress` pascals, moved by `origin` metres.
inline Settings small_footing(double length = 1.0, double stress = 1.0, double origin = 0.0) {
  const auto x = [&](double metres) { return metres * length; };
  return {setting("geometry.spacing", {x(0.02)}),
          setting("geometry.min", {x(origin), x(-0.66)}),
          setting("geometry.max", {x(origin + 1.1), 0.0}),
          setting("symmetry.0.position", {x(origin)}),
          setting("drive.range_min", {x(origin)}),
          setting("drive.range_max", {x(origin + 0.22)}),
          setting("drive.reference_length", {x(0.22)}),
          setting("drive.width", {x(0.22)}),
          setting("drive.target", {x(0.002)}),
          setting("material.0.youngs_modulus", {50e6 * stress}),
          setting("material.0.cohesion", {2.5e3 * stress}),
          setting("material.0.density", {1850.0 * stress / length})};
}

inline Steps footing_steps(const Settings& settings) {
  PlaneRun run(verification::shipped_scene("footing.toml", settings));
  return run.complete();
}

/// No NaN or infinity anywhere in the state.
template <int Dim>
void expect_finite(verification::Run<Dim>& run) {
  run.state.for_each_particle_field([](const char* name, const char*, const auto& field) {
    EXPECT_TRUE(field.allFinite()) << name;
  });
}

}  // namespace extremes

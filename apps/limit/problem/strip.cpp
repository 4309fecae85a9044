#include "limit/problem/strip.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace limit::problem {

namespace {

constexpr double pi = std::numbers::pi;

// A little more than 50 degrees; beyond, the fans needed are out of proportion.
constexpr double most_friction = 50.01 * pi / 180.0;

}  // namespace

std::optional<Objection> objection_to(const Strip& strip) {
  const Soil& soil = strip.soil;
  const auto is_size = [](double x) { return std::isfinite(x) && x >= 0.0; };
  const auto found = [](double value) { return fmt::format("found {:g}", value); };
  const std::string size = "allowed is at least 0";
  if (!is_size(soil.cohesion)) return Objection{"cohesion", found(soil.cohesion), size};
  if (!(soil.friction_angle >= 0.0 && soil.friction_angle <= most_friction)) {
    return Objection{"friction_angle", found(soil.friction_angle * 180.0 / pi),
                     "allowed is 0 .. 50 [deg]"};
  }
  if (!is_size(soil.unit_weight)) return Objection{"unit_weight", found(soil.unit_weight), size};
  if (!is_size(strip.surcharge)) return Objection{"surcharge", found(strip.surcharge), size};
  if (!is_size(strip.half_width) || strip.half_width == 0.0) {
    return Objection{"half_width", found(strip.half_width), "allowed is more than 0"};
  }
  if (soil.cohesion > 0.0) return std::nullopt;
  if (soil.friction_angle == 0.0) {
    return Objection{"cohesion", "the soil has neither cohesion nor friction: it bears nothing",
                     "one of them is more than 0"};
  }
  if (strip.surcharge > 0.0 || soil.unit_weight > 0.0) return std::nullopt;
  return Objection{"cohesion", "without cohesion, weight and surcharge the soil bears nothing",
                   "one of them is more than 0"};
}

Box box_of(const Strip& strip) {
  const double phi = strip.soil.friction_angle, tangent = std::tan(phi);
  const double reach = 2 * std::tan(pi / 4 + phi / 2) * std::exp(pi / 2 * tangent);
  const double depth =
      std::cos(phi) / std::cos(pi / 4 + phi / 2) * std::exp((pi / 4 + phi / 2) * tangent);
  constexpr double room = 1.05;
  return {room * (1.0 + reach), room * depth};
}

mesh::Fan lower_fan(const Strip& strip, const Box& box) {
  const double tangent = std::tan(strip.soil.friction_angle);
  return mesh::even_fan(box.width, box.depth, 24 + static_cast<int>(std::lround(30 * tangent)), 8,
                        1.5);
}

mesh::Fan upper_fan(const Strip& strip, const Box& box) {
  const double tangent = std::tan(strip.soil.friction_angle);
  return mesh::even_fan(box.width, box.depth, 12 + static_cast<int>(std::lround(15 * tangent)), 8,
                        2.0);
}

Units units_of(const Strip& strip) {
  const Soil& soil = strip.soil;
  return {strip.half_width, soil.cohesion * std::cos(soil.friction_angle) +
                                (strip.surcharge + soil.unit_weight * strip.half_width) *
                                    std::sin(soil.friction_angle)};
}

Problem strip_problem(const Strip& strip, const mesh::Fan& fan) {
  Problem problem;
  problem.mesh = mesh::fan_mesh(fan);
  for (mesh::Point& node : problem.mesh.nodes) node *= strip.half_width;
  problem.soils = {strip.soil};
  problem.boundaries.resize(5);
  const auto boundary = [&](mesh::FanBoundary which) -> Boundary& {
    return problem.boundaries[static_cast<std::size_t>(which)];
  };
  boundary(mesh::FanBoundary::base) = {"base", Known::footing,
                                       strip.rough ? Known::footing : Known::traction};
  boundary(mesh::FanBoundary::base).may_open = !strip.tension;
  boundary(mesh::FanBoundary::surface) = {"surface"};
  boundary(mesh::FanBoundary::surface).normal_stress = -strip.surcharge;
  boundary(mesh::FanBoundary::wall) = {"wall", Known::support, Known::support};
  boundary(mesh::FanBoundary::floor) = {"floor", Known::support, Known::support};
  boundary(mesh::FanBoundary::axis) = {"axis", Known::support, Known::traction};
  problem.footing.may_move = {false, true, false};
  problem.footing.live_load = {0.0, -strip.half_width, 0.0};
  return problem;
}

}  // namespace limit::problem

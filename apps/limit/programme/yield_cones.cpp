#include "limit/programme/yield_cones.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace limit::programme {

Overburden::Overburden(const problem::Problem& problem) {
  // Next to no load: soil of next to no cohesion may carry no more, and centring crawls from where
  // all of the load is to where hardly any is, while the way up is short.
  constexpr double of_most = 0.0025;
  if (problem.most_multiplier) multiplier_ = of_most * *problem.most_multiplier;
  top_ = bottom_ = problem.mesh.nodes.front().y();
  for (const mesh::Point& node : problem.mesh.nodes) {
    top_ = std::max(top_, node.y());
    bottom_ = std::min(bottom_, node.y());
  }
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    mesh::Point first = problem.mesh.nodes[static_cast<std::size_t>(edge.first)],
                second = problem.mesh.nodes[static_cast<std::size_t>(edge.second)];
    if (first.x() > second.x()) std::swap(first, second);
    outline_.emplace_back(first, second);
  }
  for (const problem::Boundary& boundary : problem.boundaries) {
    const double live = multiplier_.value_or(0.0) * boundary.live_normal_stress;
    load_ = std::max(load_, -(boundary.normal_stress + live));
  }
}

double Overburden::surface_above(const mesh::Point& place) const {
  double surface = place.y();
  for (const auto& [first, second] : outline_) {
    if (place.x() < first.x() || place.x() > second.x()) continue;
    const double width = second.x() - first.x();
    const double share = width > 0.0 ? (place.x() - first.x()) / width : 0.0;
    surface = std::max(surface, first.y() + share * (second.y() - first.y()));
  }
  return surface;
}

double Overburden::at(const problem::Soil& soil, const mesh::Point& place) const {
  const double depth = surface_above(place) - place.y();
  double stress = load_ + soil.unit_weight * depth;
  if (multiplier_) {
    stress += *multiplier_ * soil.live_unit_weight * depth;
  } else if (soil.live_unit_weight > 0.0) {
    const double at_failure =
        4.0 * soil.cohesion * std::tan(std::numbers::pi / 4 + soil.friction_angle / 2);
    stress += at_failure * depth / (top_ - bottom_);
  }
  return stress;
}

YieldCone yield_cone(const problem::Soil& soil, double overburden, double reserve) {
  // Twice the share of the cohesion, so that even the apex of the true cone is out of reach.
  const double strength = soil.cohesion * std::cos(soil.friction_angle) * (1.0 - 2.0 * reserve);
  const double slope = std::sin(soil.friction_angle) * (1.0 - reserve);
  // A place without strength must not have a scale of zero.
  constexpr double least = 1e-6;
  return {strength, slope, std::max(strength + slope * overburden, least)};
}

YieldCone tension_cone(const problem::Soil& soil, double overburden, double reserve) {
  // At a free face there is no pressure, and next to no tension is no stress typical of the place.
  constexpr double least = 0.1;
  const double slope = 1.0 - reserve;
  const double scale = std::max(soil.tension + slope * overburden,
                                least * yield_cone(soil, overburden, reserve).scale);
  // Without tension, a share of the pressure is none where there is no pressure.
  constexpr double of_scale = 0.1;
  const double strength =
      soil.tension > 0.0 ? soil.tension * (1.0 - 2.0 * reserve) : -of_scale * reserve * scale;
  return {strength, slope, scale};
}

YieldCone half_line_cone(double scale) {
  return {0.0, 1.0, scale};
}

YieldCone contact_cone(double scale, double reserve) {
  return {-reserve * scale, 1.0, scale};
}

Eigen::Vector3d inner_point(const YieldCone& cone, double overburden) {
  const double strength = cone.strength + cone.slope * overburden;
  const double more = strength > 0.0 ? 0.0 : cone.scale / std::max(cone.slope, 1e-6);
  return {-overburden - more, 0.0, 0.0};
}

}  // namespace limit::programme

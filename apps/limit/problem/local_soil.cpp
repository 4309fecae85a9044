#include "limit/problem/local_soil.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace limit::problem {
namespace {

const mesh::Point& node_at(const Problem& problem, int node) {
  return problem.mesh.nodes[static_cast<std::size_t>(node)];
}

// Of what is linear between three corners, or two.
mesh::Point gradient_of(const std::array<mesh::Point, 3>& corners,
                        const std::array<double, 3>& values) {
  const mesh::Point first = corners[1] - corners[0], second = corners[2] - corners[0];
  if (corners[1] == corners[2]) return (values[1] - values[0]) / first.squaredNorm() * first;
  Eigen::Matrix2d ways;
  ways << first.transpose(), second.transpose();
  return ways.inverse() * Eigen::Vector2d(values[1] - values[0], values[2] - values[0]);
}

// The steeper friction angle of a soil that is divided.
double divided(double angle, double divisor) {
  return divisor == 1.0 ? angle : std::atan(std::tan(angle) / divisor);
}

}  // namespace

Soil soil_within(const Soil& soil, const std::array<mesh::Point, 3>& corners, Bound bound) {
  if (!soil.variation) return soil;
  std::array<mesh::Point, 3> places = corners;
  for (mesh::Point& place : places) place *= soil.variation_length;
  const Variation::Within within = soil.variation->within(places);
  const bool is_lower = bound == Bound::lower;
  std::array<double, 3> cohesion = within.cohesion;
  for (double& one : cohesion) one += is_lower ? within.below : within.above;
  // No linear one may be closer than one number.
  const double even = is_lower ? within.least : within.most;
  const double mean = (cohesion[0] + cohesion[1] + cohesion[2]) / 3.0;
  const double least = *std::ranges::min_element(cohesion);
  if ((is_lower ? mean < even : mean > even) || least <= 0.0) cohesion = {even, even, even};
  Soil local = soil;
  local.variation = nullptr;
  const double angle = is_lower ? within.gentlest : within.steepest;
  const double other = is_lower ? within.steepest : within.gentlest;
  double scale = 1.0 / (soil.variation_stress * soil.divisor);
  if (angle != other) scale *= std::tan(angle) / std::tan(other);
  for (double& one : cohesion) one *= scale;
  local.friction_angle = divided(angle, soil.divisor);
  local.cohesion_gradient = gradient_of(corners, cohesion);
  local.cohesion = cohesion[0] + local.cohesion_gradient.dot(local.centre - corners[0]);
  return local;
}

Soil soil_in(const Problem& problem, const mesh::Triangle& triangle, Bound bound) {
  const Soil& soil = problem.soils[static_cast<std::size_t>(triangle.region)];
  if (!soil.variation) return soil;
  return soil_within(soil,
                     {node_at(problem, triangle.nodes[0]), node_at(problem, triangle.nodes[1]),
                      node_at(problem, triangle.nodes[2])},
                     bound);
}

Soil soil_at(const Soil& soil, const mesh::Point& place) {
  if (!soil.variation) return soil.with_cohesion(soil.cohesion_at(place));
  const auto there = soil.variation->at(soil.variation_length * place);
  Soil local = soil.with_cohesion(there.cohesion / (soil.variation_stress * soil.divisor));
  local.friction_angle = divided(there.friction_angle, soil.divisor);
  local.variation = nullptr;
  return local;
}

// A bound in either soil, and the better one in the softer of them, under a mean pressure of one.
int region_across(const Problem& problem, const mesh::Edge& edge) {
  const auto region_of = [&](int triangle) {
    return problem.mesh.triangles[static_cast<std::size_t>(triangle)].region;
  };
  const int left = region_of(edge.left);
  if (edge.right < 0 || region_of(edge.right) == left) return left;
  const mesh::Point &first = node_at(problem, edge.first), &second = node_at(problem, edge.second);
  const mesh::Point middle = first + (second - first) / 2.0;
  const auto strength = [&](int region) {
    const Soil here = soil_at(problem.soils[static_cast<std::size_t>(region)], middle);
    if (here.is_curved()) return here.envelope.radius_about(1.0);
    return here.cohesion * std::cos(here.friction_angle) + std::sin(here.friction_angle);
  };
  const int right = region_of(edge.right);
  return strength(right) < strength(left) ? right : left;
}

Soil soil_across(const Problem& problem, const mesh::Edge& edge) {
  const Soil& chosen = problem.soils[static_cast<std::size_t>(region_across(problem, edge))];
  const mesh::Point &first = node_at(problem, edge.first), &second = node_at(problem, edge.second);
  return soil_within(chosen, {first, second, second}, Bound::upper);
}

}  // namespace limit::problem

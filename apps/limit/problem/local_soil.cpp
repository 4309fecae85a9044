#include "limit/problem/local_soil.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace limit::problem {
namespace {

const mesh::Point& node_at(const Problem& problem, int node) {
  return problem.mesh.nodes[static_cast<std::size_t>(node)];
}

const Soil& soil_of(const Problem& problem, int triangle) {
  const int region = problem.mesh.triangles[static_cast<std::size_t>(triangle)].region;
  return problem.soils[static_cast<std::size_t>(region)];
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
Soil soil_across(const Problem& problem, const mesh::Edge& edge) {
  const mesh::Point &first = node_at(problem, edge.first), &second = node_at(problem, edge.second);
  const Soil *left = &soil_of(problem, edge.left), *chosen = left;
  if (edge.right >= 0 && &soil_of(problem, edge.right) != left) {
    const mesh::Point middle = first + (second - first) / 2.0;
    const auto strength = [&](const Soil& soil) {
      const Soil here = soil_at(soil, middle);
      return here.cohesion * std::cos(here.friction_angle) + std::sin(here.friction_angle);
    };
    const Soil* const right = &soil_of(problem, edge.right);
    if (strength(*right) < strength(*left)) chosen = right;
  }
  return soil_within(*chosen, {first, second, second}, Bound::upper);
}

}  // namespace limit::problem

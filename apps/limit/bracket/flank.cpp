#include "limit/bracket/flank.hpp"

namespace limit::bracket {

// Taylor's number lies between 4 and 6 for most faces.
double estimated_factor(const problem::Problem& problem, double one) {
  double low = std::numeric_limits<double>::infinity(), high = -low, rise = 0.0, run = 0.0;
  const auto& nodes = problem.mesh.nodes;
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    const problem::Boundary& side = problem.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (side.normal != problem::Known::traction) continue;
    const mesh::Point &a = nodes[static_cast<std::size_t>(edge.first)],
                      &b = nodes[static_cast<std::size_t>(edge.second)];
    low = std::min({low, a.y(), b.y()});
    high = std::max({high, a.y(), b.y()});
    constexpr double level = 0.05;
    if (std::abs(b.y() - a.y()) <= level * std::abs(b.x() - a.x())) continue;
    rise += std::abs(b.y() - a.y());
    run += std::abs(b.x() - a.x());
  }
  double area = 0.0, cohesion = 0.0, friction = 0.0, weight = 0.0;
  for (const mesh::Triangle& triangle : problem.mesh.triangles) {
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(triangle.region)];
    const double here = mesh::twice_area(problem.mesh, triangle);
    area += here;
    cohesion += here * soil.cohesion;
    friction += here * std::tan(soil.friction_angle);
    weight += here * one * soil.live_unit_weight;
  }
  constexpr double stability = 5.0;
  const double factor =
      friction / area * run / rise + stability * cohesion / (weight * (high - low));
  return std::isfinite(factor) && factor > 0.0 ? std::clamp(factor, 1e-3, 1e3) : 1.0;
}

}  // namespace limit::bracket

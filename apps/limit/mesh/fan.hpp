#pragma once

#include <vector>

#include "limit/mesh/mesh.hpp"

namespace limit::mesh {

/// Boundaries of a fan's mesh, counterclockwise.
enum class FanBoundary { base, surface, wall, floor, axis };

/// A structured mesh of rays and rings around the edge (1, 0) of a footing of half width 1, in the
/// box 0 < x < width, -depth < y < 0. A structured fan resolves the singular point, where every
/// direction has a stress and a velocity of its own.
struct Fan {
  double width = 0.0;
  double depth = 0.0;
  std::vector<double> angles;  // [rad] of the rays, from pi (base) to 2 pi (surface)
  std::vector<std::vector<double>> fractions;  // per ray, of its length: 0 < ... < 1, as many each
};

/// Rays evenly spread, with one in each lower corner of the box; the rings' fractions are
/// (k / rings)^grading. @throws std::invalid_argument for a box that does not hold the footing.
[[nodiscard]] Fan even_fan(double width, double depth, int rays, int rings, double grading);

/// Two triangles per cell between neighbouring rays and rings, one at the edge; sector by sector,
/// outwards. BoundaryEdge::boundary is a FanBoundary.
[[nodiscard]] Mesh fan_mesh(const Fan& fan);

}  // namespace limit::mesh

#pragma once

#include <stdexcept>
#include <vector>

#include "limit/ground/ground_outline.hpp"

namespace limit::ground {

/// How fine a mesh begins. The fans decide; what lies between them is graded and refined later.
struct GroundFineness {
  double rays_per_radian = 8.0;
  int rings = 4;
  double grading = 1.5;  // radii of the rings: (k / rings)^grading
  double longest = 1.0;  // [m] sides between the fans
};

/// Corners of the outline where stress and velocity take every direction at once: re-entrant ones,
/// ends of footings and of pressures, unless the next side is a mirror; and those where no single
/// stress has the tractions of both sides.
[[nodiscard]] std::vector<int> singular_points(const GroundScene& scene,
                                               const GroundOutline& outline);

/// No mesh begins with more between the fans, as two of them must be solved at once.
constexpr std::size_t most_first_triangles = 12000;

/// The ground is so narrow somewhere that its mesh would begin with more than that.
struct GroundTooFine : std::runtime_error {
  GroundTooFine() : std::runtime_error("ground mesh: too many triangles") {}
  std::size_t region = 0;       // of the scene, with the smallest triangle
  mesh::Point place{0.0, 0.0};  // where that is
};

/// A structured fan around every singular point and a graded mesh (constrained Delaunay, refined to
/// angles of 20 degrees) between them, conforming to regions and sides. Triangle::region is the
/// material of the scene, BoundaryEdge::boundary its side.
/// @throws GroundTooFine
[[nodiscard]] mesh::Mesh ground_mesh(const GroundScene& scene, const GroundOutline& outline,
                                     const GroundFineness& fineness);

}  // namespace limit::ground

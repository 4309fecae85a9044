#pragma once

#include <stdexcept>

#include "limit/ground/ground_fan.hpp"

namespace limit::ground {

/// Whether this program has what meshes ground (see the document on CGAL's terms).
extern const bool can_mesh_ground;

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
/// @throws GroundTooFine; std::logic_error unless `can_mesh_ground`.
[[nodiscard]] mesh::Mesh ground_mesh(const GroundScene& scene, const GroundOutline& outline,
                                     const GroundFineness& fineness);

}  // namespace limit::ground

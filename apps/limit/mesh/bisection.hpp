#pragma once

#include <vector>

#include "limit/mesh/mesh.hpp"

namespace limit::mesh {

/// Bisects the longest side of every marked triangle and of whatever neighbours that must follow
/// for the mesh to stay conforming (Rivara 1984: along the path of ever longer sides, which ends).
/// The new mesh covers the same body, every new triangle lies in an old one; angles do not
/// degenerate. Cost: linear in the triangles, but for a logarithm.
[[nodiscard]] Mesh bisected(const Mesh& mesh, const std::vector<bool>& marked);

/// Bisects the triangles of the largest indicators that make up `share` of their sum, and, so that
/// a mesh whose indicators are next to one point does not grow by a handful of triangles at a time,
/// goes on with what has become of them, an indicator being divided as its triangle is, until there
/// are `growth` times as many triangles. The mesh itself if no indicator is positive.
[[nodiscard]] Mesh refined(Mesh mesh, std::vector<double> indicators, double share, double growth);

/// Marks the triangles of the largest indicators that together make up `share` of their sum.
[[nodiscard]] std::vector<bool> largest(const std::vector<double>& indicators, double share);

}  // namespace limit::mesh

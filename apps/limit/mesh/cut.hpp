#pragma once

#include <vector>

#include "limit/mesh/mesh.hpp"

namespace limit::mesh {

/// The mesh with sides along the line x = position (axis 0) or y = position (axis 1), wherever it
/// crosses the body: nodes that are almost on the line are moved onto it, along the axis, and the
/// triangles it still crosses are cut in two or three. The outline stays where it is, and so do the
/// nodes on `earlier` lines across the same axis.
[[nodiscard]] Mesh cut(const Mesh& mesh, int axis, double position,
                       const std::vector<double>& earlier = {});

}  // namespace limit::mesh

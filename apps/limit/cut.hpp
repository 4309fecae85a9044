#pragma once

#include "limit/mesh.hpp"

namespace limit {

/// The mesh with sides along the line x = position (axis 0) or y = position (axis 1), wherever it
/// crosses the body: nodes that are almost on the line are moved onto it, along the axis, and the
/// triangles it still crosses are cut in two or three. The outline must not be moved by that: where
/// it is crossed, it must run along the axis.
[[nodiscard]] Mesh cut(const Mesh& mesh, int axis, double position);

}  // namespace limit

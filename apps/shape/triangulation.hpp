#pragma once

#include <array>
#include <span>
#include <vector>

#include "shape/point.hpp"

namespace shape {

/// Delaunay's triangles of points, counterclockwise; of points on one circle, some. Triangles so
/// flat that they are a line but for rounding are left out: none are left of points on one line.
/// Where two points are next to one place, but for rounding, one of them counts.
[[nodiscard]] std::vector<std::array<int, 3>> triangles_between(std::span<const Point> points);

}  // namespace shape

#pragma once

#include <optional>
#include <span>

#include "shape/point.hpp"

namespace shape {

/// How far one way turns to the left of another: the area that they span, negative to the right.
[[nodiscard]] inline double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Area of a polygon, negative if it goes around clockwise.
[[nodiscard]] double signed_area(const Ring& ring);

/// Distance of a place from the straight piece between two others.
[[nodiscard]] double distance(const Point& place, const Point& first, const Point& second);

/// Where two straight pieces, a - b and c - d, cross within both, if they do; ends do not count.
[[nodiscard]] std::optional<Point> crossing(const Point& a, const Point& b, const Point& c,
                                            const Point& d);

/// Whether a place is inside a polygon, or one with holes; either, on its outline.
[[nodiscard]] bool is_inside(const Ring& polygon, const Point& place);
[[nodiscard]] bool is_inside(std::span<const Ring> rings, const Point& place);

}  // namespace shape

#pragma once

#include <span>
#include <string>
#include <vector>

#include "shape/point.hpp"
#include "shape/ring.hpp"
#include "tables/diagnosis.hpp"

namespace shape {

/// A region of a scene: a simple polygon without its holes, which are simple polygons within it.
/// All go either way around.
struct NamedRegion {
  std::string name;
  Ring ring;                // [m]
  std::vector<Ring> holes;  // [m]
};

/// A side of a scene: a polyline on the outline of the regions together, either way.
struct NamedLine {
  std::string name;
  std::vector<Point> along;  // [m]
};

/// A straight piece between neighbouring points; the ground, or region `left`, is to its left.
struct OutlineSegment {
  int first = 0, second = 0;
  int left = 0;
  int right = -1;  // region; -1: on the outline
  int side = -1;   // of the scene, on the outline
};

/// Polygons as a conforming arrangement: no point lies within a segment.
struct Outline {
  std::vector<Point> points;
  std::vector<OutlineSegment> segments;
  using Loop = std::vector<int>;  // points
  /// Of each region the loop around it, counterclockwise, and those of its holes, clockwise.
  std::vector<std::vector<Loop>> regions;
  double size = 0.0;  // diagonal of the bounding box
  double area = 0.0;

  /// Places closer than this are one.
  [[nodiscard]] double tolerance() const { return 1e-9 * size; }
  [[nodiscard]] const Point& at(int point) const { return points[static_cast<std::size_t>(point)]; }
  /// The loops of a region as places.
  [[nodiscard]] std::vector<Ring> rings(std::size_t region) const;
};

/// Joins the regions, [[region]] of a scene, and finds the side, [[side]], of each part of the
/// outline. What is no ground is an error of the diagnosis: a size whose square is no number, or
/// too small for the digits of its place; polygons that cross or touch themselves, overlap, are
/// thinner than a millionth of the whole, or fall apart; holes outside their region; sides off the
/// outline; outline (of a hole, too) without a side.
[[nodiscard]] Outline join_regions(std::span<const NamedRegion> regions,
                                   std::span<const NamedLine> sides, tables::Diagnosis& diagnosis);

}  // namespace shape

#pragma once

#include <vector>

#include "limit/ground/ground_scene.hpp"

namespace limit::ground {

/// A straight piece between neighbouring points; the ground, or region `left`, is to its left.
struct GroundSegment {
  int first = 0, second = 0;
  int left = 0;
  int right = -1;  // region; -1: on the outline
  int side = -1;   // of the scene, on the outline
};

/// The ground's polygons as a conforming arrangement: no point lies within a segment.
struct GroundOutline {
  std::vector<mesh::Point> points;
  std::vector<GroundSegment> segments;
  std::vector<std::vector<int>> regions;  // points, counterclockwise
  double size = 0.0;                      // diagonal of the bounding box
  double area = 0.0;

  /// Places closer than this are one.
  [[nodiscard]] double tolerance() const { return 1e-9 * size; }
  [[nodiscard]] const mesh::Point& at(int point) const {
    return points[static_cast<std::size_t>(point)];
  }
};

/// Joins the regions and finds the side of each part of the outline. What is no ground is an error
/// of the diagnosis: a size whose square is no number, or too small for the digits of its place;
/// polygons that cross or touch themselves, overlap, are thinner than a millionth of the whole, or
/// fall apart; sides off the outline; outline (of a hole, too) without a side.
[[nodiscard]] GroundOutline ground_outline(const GroundScene& scene, tables::Diagnosis& diagnosis);

/// Distance of a place from the straight piece between two others.
[[nodiscard]] double distance(const mesh::Point& place, const mesh::Point& first,
                              const mesh::Point& second);

/// Whether a place is inside a polygon; either, on its outline.
[[nodiscard]] bool is_inside(const std::vector<mesh::Point>& polygon, const mesh::Point& place);

}  // namespace limit::ground

#include "limit/ground/ground_pressure.hpp"

#include <utility>

#include "limit/ground/ground_boundary.hpp"

namespace limit::ground {

std::vector<problem::PorePressure::Corner> GroundPressure::corners_in(
    const std::array<mesh::Point, 3>& triangle) const {
  std::vector<Corner> corners;
  for (const auto& piece : field_.within({triangle.begin(), triangle.end()})) {
    for (const mesh::Point& place : piece.ring) {
      corners.push_back({place, piece.value + piece.gradient.dot(place - piece.ring.front())});
    }
  }
  return corners;
}

void divide_at_kinks(const GroundScene& scene, const shape::PressureField& field,
                     GroundOutline& outline) {
  std::vector<GroundSegment> segments;
  for (const GroundSegment& whole : outline.segments) {
    GroundSegment rest = whole;
    const bool is_known =
        whole.right < 0 &&
        boundary_of(scene, scene.sides[static_cast<std::size_t>(whole.side)]).normal !=
            problem::Known::support;
    if (is_known) {
      for (const mesh::Point& kink :
           field.kinks(outline.at(whole.first), outline.at(whole.second))) {
        GroundSegment part = rest;
        part.second = rest.first = static_cast<int>(outline.points.size());
        outline.points.push_back(kink);
        segments.push_back(part);
      }
    }
    segments.push_back(rest);
  }
  outline.segments = std::move(segments);
}

}  // namespace limit::ground

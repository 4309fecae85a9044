#pragma once

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

/// A structured fan at a corner of the outline: rays from one of its sides to the other.
struct GroundFan {
  int centre = 0;                       // point of the outline
  std::vector<double> radii;            // of the rings, ascending; the last one is the fan's
  std::vector<mesh::Point> directions;  // of the rays, counterclockwise, unit length
  std::vector<int> regions;             // between neighbouring rays
  int side_before = 0;                  // side of the outline that enters the corner (last ray)
  int side_after = 0;                   // and of the one that leaves it (first ray)

  [[nodiscard]] mesh::Point at(const GroundOutline& outline, std::size_t ray,
                               std::size_t ring) const {
    return outline.at(centre) + radii[ring] * directions[ray];
  }
};

/// Corners of the outline where stress and velocity take every direction at once: re-entrant ones,
/// ends of footings and of pressures, unless the next side is a mirror; and those where no single
/// stress has the tractions of both sides.
[[nodiscard]] std::vector<int> singular_points(const GroundScene& scene,
                                               const GroundOutline& outline);

/// The fans of the singular points; they touch neither each other nor what does not meet there.
[[nodiscard]] std::vector<GroundFan> ground_fans(const GroundScene& scene,
                                                 const GroundOutline& outline,
                                                 const GroundFineness& fineness);

}  // namespace limit::ground

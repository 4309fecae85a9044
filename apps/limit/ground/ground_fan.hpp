#pragma once

#include <vector>

#include "limit/ground/ground_mesh.hpp"

namespace limit::ground {

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

/// The fans of the singular points; they touch neither each other nor what does not meet there.
[[nodiscard]] std::vector<GroundFan> ground_fans(const GroundScene& scene,
                                                 const GroundOutline& outline,
                                                 const GroundFineness& fineness);

}  // namespace limit::ground

#pragma once

#include <vector>

#include "limit/mesh/mesh.hpp"

namespace limit::problem {

/// A piece of a logarithmic spiral about a pole, radius exp(growth (angle - upper)) from its upper
/// angle down to its lower one. A body above it that turns counterclockwise parts from the ground
/// at every point at the friction angle whose tangent is the growth.
struct SpiralArc {
  double upper = 0.0, lower = 0.0;  // [rad] counterclockwise from +x
  double radius = 0.0;              // at the upper angle
  double growth = 0.0;              // >= 0
};

/// A mechanism: the ground between a pole and a curve around it turns as one block, the rest is at
/// rest. The arcs follow each other from the end where the curve leaves the ground downhill to the
/// other one; their angles decrease.
struct TurningBlock {
  mesh::Point pole{0.0, 0.0};
  bool clockwise = false;  // then the arcs are those of the mirror image, x of it being -x
  std::vector<SpiralArc> arcs;
};

}  // namespace limit::problem

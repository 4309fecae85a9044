#pragma once

#include <array>

#include "limit/problem/pore_pressure.hpp"
#include "limit/problem/problem.hpp"

namespace limit::programme {

/// What the weight of a triangle, and the force of water in it, amounts to at its corners and the
/// middles of its sides 01 12 20: the power of a velocity that is quadratic within it is the sum of
/// force times velocity there.
struct WeightForces {
  std::array<mesh::Point, 6> dead, live;  // [N/m]; per unit of the multiplier
};

/// Exact for a weight that is linear.
[[nodiscard]] WeightForces weight_forces(const problem::Problem& problem,
                                         const problem::MeshPressure& water, std::size_t triangle);

}  // namespace limit::programme

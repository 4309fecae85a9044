#pragma once

#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// What is known on a side; of its live loads only those that the scene seeks count.
[[nodiscard]] problem::Boundary boundary_of(const GroundScene& scene, const GroundSide& side);

}  // namespace limit::ground

#pragma once

#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// Notes what a pressure that a scene tells does where it may not be meant: where it presses most
/// on a free face, as standing water does; and, for where no bound is found, where it is most above
/// what the ground straight above and the water on that weigh. Of ground that is wet.
void say_pressure(const GroundScene& scene, const GroundOutline& outline, problem::Case& result);

}  // namespace limit::ground

#pragma once

#include "limit/ground/ground_scene.hpp"

namespace limit::ground {

/// Cuts the regions of a scene with water along its table and below the corners of that, so that
/// the pore pressure, hydrostatic below the table and none above, is linear in every part. Wet
/// parts have materials of their own, of the same name, saturated and under the force of the water,
/// less the gradient of its pressure. A table that is no such line over all of the ground is an
/// error.
void wet(GroundScene& scene, tables::Diagnosis& diagnosis);

}  // namespace limit::ground

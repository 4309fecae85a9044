#pragma once

#include "limit/ground/ground_scene.hpp"

namespace limit::ground {

/// Cuts the regions of a scene with water along its table and below the corners of that, so that
/// the pore pressure, hydrostatic below the table and none above, is linear in every part; where it
/// is r_u times the weight straight above, below all corners. Wet parts have materials of their
/// own, of the same name, under the force of the water, less the gradient of its pressure, and
/// where there is any by a table or as told saturated. A pressure that is told linearly or by a
/// table is cut along its lines likewise; one that is told in triangles is checked, and the regions
/// are left as they are (ground_pressure.hpp). A table that is no such line over all of the ground
/// is an error, and so is a weight above that jumps.
void wet(GroundScene& scene, tables::Diagnosis& diagnosis);

}  // namespace limit::ground

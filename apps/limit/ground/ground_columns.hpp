#pragma once

#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// Cuts wedges off soil that bears no tension at all, behind its upright free faces with level
/// ground on top, thin at the foot: soil that stands by itself there (Soil::stands), as columns do.
/// Nothing pushes an upright face outwards that cannot pull, so that a stress that is linear in
/// triangles is that of columns beside the face anyway; within the wedges it is so in all corners,
/// and beyond them, where the face leans back and bears their weight, it is free.
/// @return whether there are any
bool cut_columns(GroundScene& scene, const GroundOutline& outline);

}  // namespace limit::ground

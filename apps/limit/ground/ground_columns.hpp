#pragma once

#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// Cuts wedges off soil that bears no tension at all, behind its upright free faces with level
/// ground on top, thin at the foot: soil that stands by itself there (Soil::stands), as columns do.
/// Nothing pushes an upright face outwards that cannot pull, so that a stress that is linear in
/// triangles is that of columns beside the face anyway; within the wedges it is so in all corners,
/// and beyond them, where the face leans back and bears their weight, it is free.
/// Where an earthquake, water or a shear on top pushes such a face outwards nothing holds it, which
/// is an error of the diagnosis; what they push inwards is left as it is.
/// @return whether there are any
bool cut_columns(GroundScene& scene, const GroundOutline& outline, tables::Diagnosis& diagnosis);

}  // namespace limit::ground

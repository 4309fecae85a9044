#pragma once

#include "limit/ground/ground_types.hpp"
#include "tables/diagnosis.hpp"

namespace limit::ground {

/// Makes the soils of a scene of what its materials tell. A cohesion that changes and is not more
/// than zero wherever its material is is an error, likewise a friction angle, what samples do not
/// speak of, and a weight by a raster that is bilinear.
void tell_soils(GroundScene& scene, tables::Diagnosis& diagnosis);

/// Gives a soil a weight that is linear.
void take_weight(const tables::VaryingNumber& weight, problem::Soil& soil);

/// The same soil, its linear values told from another place.
void recentre(const mesh::Point& centre, problem::Soil& soil);

}  // namespace limit::ground

#pragma once

#include <cstddef>

#include "limit/ground/ground_types.hpp"
#include "tables/builder.hpp"
#include "tables/diagnosis.hpp"

namespace limit::ground {

/// Adds the keys of curved envelopes to those of a material.
void add_curve_keys(tables::TableBuilder<GroundScene, GroundMaterial>& table);

/// Judges the keys of a material against its model: those that it lacks, and those of other ones.
void check_curve(const GroundScene& scene, std::size_t material, tables::Diagnosis& diagnosis);

/// Gives the soil of a material with a curved envelope that envelope, and as cohesion and friction
/// angle those of a tangent typical of the ground: where the unconfined strength is, under half of
/// its weight.
void tell_curve(GroundScene& scene, std::size_t material);

}  // namespace limit::ground

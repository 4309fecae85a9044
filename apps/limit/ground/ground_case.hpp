#pragma once

#include "limit/ground/ground_scene.hpp"
#include "limit/problem/case.hpp"

namespace limit::ground {

/// The collapse problem of a ground, meshed for both bounds; its Davis-reduced twin if a soil
/// dilates by less than its friction angle. Errors of the scene as a whole go to the diagnosis, and
/// there is no case then.
[[nodiscard]] std::optional<problem::Cases> ground_case(const GroundScene& scene,
                                                        tables::Diagnosis& diagnosis);

}  // namespace limit::ground

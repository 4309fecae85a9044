#pragma once

#include "limit/ground_scene.hpp"
#include "limit/scene_case.hpp"

namespace limit {

/// The collapse problem of a ground, meshed for both bounds; its Davis-reduced twin if a soil
/// dilates by less than its friction angle. Errors of the scene as a whole go to the diagnosis, and
/// there is no case then.
[[nodiscard]] std::optional<SceneCase> ground_case(const GroundScene& scene,
                                                   wiring::Diagnosis& diagnosis);

}  // namespace limit

#pragma once

#include <optional>

#include "limit/problem/case.hpp"
#include "scene/scene.hpp"

namespace limit::footing {

/// A collapse problem, its Davis-reduced twin if a soil in it dilates by less than its friction
/// angle, and the scene of fpm-run it comes from, if it does.
struct SceneCase {
  problem::Case associated;
  std::optional<problem::Case> davis;
  std::optional<scene::Scene> scene;
};

/// The footing of a scene: half a body, mirrored at its left side, pressed down by a part of its
/// top from there on. Materials become soils by their regions, whose boundaries the meshes follow.
/// @param tension  whether the soil holds the footing down, which a scene does not say
/// @throws std::invalid_argument, naming the key, for a scene that is no such footing.
[[nodiscard]] SceneCase scene_case(const scene::Scene& scene, bool tension = true);

}  // namespace limit::footing

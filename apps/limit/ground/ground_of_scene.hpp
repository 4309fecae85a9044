#pragma once

#include <optional>
#include <string_view>

#include "limit/ground/ground_scene.hpp"

namespace scene {
struct Scene;
}

namespace limit::ground {

/// Whether TOML text is a scene of regions that fpm-run runs, too: it has a geometry.
[[nodiscard]] bool is_scene_of_both(std::string_view text);

/// The ground of such a scene; what of it is none is an error of the diagnosis.
[[nodiscard]] std::optional<GroundScene> ground_of_scene(const scene::Scene& scene,
                                                         tables::Diagnosis& diagnosis);

}  // namespace limit::ground

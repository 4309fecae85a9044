#pragma once

#include <optional>

#include "limit/problem/case.hpp"
#include "tables/diagnosis.hpp"

namespace scene {
struct Scene;
}

namespace limit::footing {

/// The footing of a scene of fpm-run: half a body, mirrored at its left side, pressed down by a
/// part of its top from there on. Materials become soils by their regions, whose boundaries the
/// meshes follow. What is no such footing goes to the diagnosis by its key, and there is no case
/// then.
/// @param tension  whether the soil holds the footing down, which a scene does not say
[[nodiscard]] std::optional<problem::Cases> scene_case(const scene::Scene& scene, bool tension,
                                                       tables::Diagnosis& diagnosis);

}  // namespace limit::footing

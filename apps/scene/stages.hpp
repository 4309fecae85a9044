#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/course.hpp"

namespace scene {

/// The scene of one stage, as if it were all there is: the body, the values and the supports that
/// it has then, its steps, and the course of its drive (Scene::course). Without stages the scene
/// itself.
/// @param whole  a completed and checked scene
[[nodiscard]] Scene scene_of_stage(const Scene& whole, std::size_t stage);

/// The scene before its first stage, with nothing changed yet.
[[nodiscard]] Scene scene_before_stages(const Scene& whole);

/// Nominal number of steps of all stages.
[[nodiscard]] std::int64_t planned_steps(const Scene& whole);

}  // namespace scene

#pragma once

#include "scene/choices.hpp"

namespace scene {

struct Scene;

/// Whether a load that acts from the start presses on a side of the box, or pulls at it.
[[nodiscard]] bool is_pressed_from_the_start(const Scene& scene, Side side);

/// Whether the drive moves its side from end to end.
[[nodiscard]] bool drives_whole_side(const Scene& scene);

}  // namespace scene

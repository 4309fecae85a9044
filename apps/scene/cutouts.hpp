#pragma once

#include "shape/body.hpp"

namespace scene {

struct Cutout;
struct Scene;

/// The ring that a cutout is the inside or the outside of: its outline, or its circle.
[[nodiscard]] shape::Ring ring_of(const Scene& scene, const Cutout& cutout);

/// The body of a checked plane scene.
[[nodiscard]] shape::Body body_of(const Scene& scene);

}  // namespace scene

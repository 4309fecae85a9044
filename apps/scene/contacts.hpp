#pragma once

namespace scene {

struct Scene;

/// Whether somewhere a face slides or opens by contact: where materials meet, at a support, or
/// under a plate.
[[nodiscard]] bool has_contact(const Scene& scene);

/// Whether there is one whose strength is divided when strength is: between materials of which one
/// is weakened; at supports and under plates, whatever lies there.
[[nodiscard]] bool has_weakened_contact(const Scene& scene);

}  // namespace scene

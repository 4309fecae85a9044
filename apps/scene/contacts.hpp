#pragma once

namespace scene {

struct Scene;

/// Whether somewhere a face slides or opens by contact: where materials meet, at a support, or
/// under a plate.
[[nodiscard]] bool has_contact(const Scene& scene);

}  // namespace scene

#pragma once

namespace scene {

struct Scene;

/// Whether the preconditioner is that of factors where the scene does not say: in the plane, next
/// to incompressibility, and of small elastic bodies that blocks and grid do badly.
[[nodiscard]] bool wants_factors(const Scene& scene);

}  // namespace scene

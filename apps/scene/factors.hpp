#pragma once

namespace scene {

struct Scene;

/// Whether the preconditioner is that of factors where the scene does not say: in the plane, next
/// to incompressibility, and of small elastic bodies that blocks and grid do badly.
/// @param poissons_ratio  the largest of its materials
[[nodiscard]] bool wants_factors(const Scene& scene, double poissons_ratio, bool is_elastic);

}  // namespace scene

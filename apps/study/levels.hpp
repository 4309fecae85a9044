#pragma once

#include <vector>

namespace scene {
struct Scene;
}

namespace study {

/// Spacings at which the body is still a whole number of cells each way, and so is whatever of the
/// scene's places is at its own spacing, from some cells across the least of these to an eighth of
/// the scene's; each finer than the one before by 1.5, as nearly as whole numbers allow.
[[nodiscard]] std::vector<double> spacings_on_offer(const scene::Scene& scene);

}  // namespace study

#pragma once

#include <string>
#include <vector>

#include "scene/choices.hpp"

namespace scene {
struct Scene;
}

namespace study {

/// Spacings at which the body is still a whole number of cells each way, and so is whatever of the
/// scene's places is at its own spacing, from some cells across the least of these to an eighth of
/// the scene's; each finer than the one before by 1.5, as nearly as whole numbers allow.
/// @throws UsageError if the particles are the elements of a mesh
[[nodiscard]] std::vector<double> spacings_on_offer(const scene::Scene& scene);

/// Sides of a body, as `left,bottom`, that are only where the ground that is looked at ends.
/// @throws UsageError unless each is a side of the scene's body that more ground may lie beyond: no
/// mirror, nor the side that is moved.
[[nodiscard]] std::vector<scene::Side> parse_far(const std::string& text,
                                                 const scene::Scene& scene);

/// Settings that take those sides so many times as far from the opposite ones, or a little farther:
/// places stay a whole number of cells at every spacing on offer. Materials that reach to a side go
/// with it.
[[nodiscard]] std::vector<std::string> widened(const scene::Scene& scene,
                                               const std::vector<scene::Side>& far, double times);

}  // namespace study

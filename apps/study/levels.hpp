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

/// Those of them at which a body of regions, its holes, and what is pressed on are some cells wide:
/// coarser ones are not on their way to a limit yet, though they may do for a draft. Where a budget
/// is what ends the ladder they go on beyond an eighth of the scene's.
[[nodiscard]] std::vector<double> spacings_of_a_ladder(const scene::Scene& scene, bool budget);

/// Settings that take a scene to a spacing: where particles are graded, all of them become as much
/// finer or coarser.
[[nodiscard]] std::vector<std::string> settings_of_spacing(const scene::Scene& scene,
                                                           double spacing);

/// Settings that take so many times as many steps, in each stage.
[[nodiscard]] std::vector<std::string> settings_of_steps(const scene::Scene& scene, double times);

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

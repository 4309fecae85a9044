#pragma once

#include <span>

#include "scene/layers.hpp"

namespace scene {

struct Scene;

/// Vertical stress [Pa] of geostatic ground at a place, effective where there is water: the
/// surcharge and the weight above, less what water bears of it, in slices of at most a spacing,
/// each of the material at its middle; in a body of regions layer by layer (layers.hpp).
[[nodiscard]] double geostatic_stress(const Scene& scene, std::span<const double> place);
/// The same at one of many places.
/// @param layers  `layers_of` the scene, if it has regions
[[nodiscard]] double geostatic_stress(const Scene& scene, std::span<const Layer> layers,
                                      std::span<const double> place);

}  // namespace scene

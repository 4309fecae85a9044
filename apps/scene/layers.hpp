#pragma once

#include <cstddef>
#include <vector>

namespace scene {

struct Material;
struct Scene;

/// What a body of regions is made of from one level down to the next.
struct Layer {
  double top = 0.0, bottom = 0.0;  // [m] levels y
  std::size_t material = 0;
};

/// The layers of a completed scene's regions, from the surface down, as they are before the first
/// stage: level ones, if `two_beside_one_another` finds none that are not. Of two regions at one
/// level it is the first.
[[nodiscard]] std::vector<Layer> layers_of(const Scene& scene);

/// The body's highest level [m] before the first stage.
[[nodiscard]] double highest_level(const Scene& scene);

/// Level of the ground's surface [m]: that of the initial stress, or else the body's highest.
[[nodiscard]] double surface_level(const Scene& scene);

/// Whether the geostatic stress of two materials is the same at one depth below the same ground.
[[nodiscard]] bool weigh_alike(const Scene& scene, const Material& one, const Material& other);

/// Two regions that are there before the first stage, share levels, and do not weigh alike.
struct Neighbours {
  std::size_t one = 0, other = 0;  // of the scene's regions
  double low = 0.0, high = 0.0;    // [m] the levels that they share
};
[[nodiscard]] std::vector<Neighbours> two_beside_one_another(const Scene& scene);

}  // namespace scene

#include "scene/cutouts.hpp"

#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace scene {

shape::Ring ring_of(const Scene& scene, const Cutout& cutout) {
  constexpr double sagitta_over_spacing = 1e-3;
  if (cutout.radius) {
    return shape::circle({cutout.centre[0], cutout.centre[1]}, *cutout.radius,
                         sagitta_over_spacing * scene.geometry.spacing);
  }
  shape::Ring ring;
  for (const PlanePoint& corner : cutout.outline) ring.emplace_back(corner.x(), corner.y());
  return ring;
}

shape::Body body_of(const Scene& scene) {
  std::vector<shape::Cut> cuts;
  for (const Cutout& cutout : scene.cutout) {
    cuts.push_back({ring_of(scene, cutout), cutout.outside});
  }
  const Geometry& geometry = scene.geometry;
  const shape::Point lower(geometry.min[0], geometry.min[1]);
  const shape::Point upper(geometry.max[0], geometry.max[1]);
  if (scene.region.empty()) return {lower, upper, cuts};
  return {outline_of(scene), lower, upper, cuts};
}

}  // namespace scene

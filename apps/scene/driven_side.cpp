#include "scene/driven_side.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "scene/box.hpp"
#include "scene/drives.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

// Whether a part of the outline lies on a side of the box.
bool lies_on(const Scene& scene, const OutlineSide& part, Side side) {
  const auto axis = static_cast<std::size_t>(axis_of(side));
  if (axis > 1) return false;
  const double position = side_position(scene.geometry, side), slack = same_place(scene.geometry);
  const auto is_on = [&](const PlanePoint& point) {
    return std::abs((axis == 0 ? point.x() : point.y()) - position) <= slack;
  };
  return std::ranges::adjacent_find(part.along, [&](const PlanePoint& a, const PlanePoint& b) {
           return is_on(a) && is_on(b);
         }) != part.along.end();
}

}  // namespace

bool is_pressed_from_the_start(const Scene& scene, Side side) {
  const auto across = static_cast<std::size_t>(axis_of(side));
  return std::ranges::any_of(scene.traction,
                             [&](const Traction& traction) {
                               return traction.side == side && across < traction.value.size() &&
                                      traction.value[across] != 0.0 &&
                                      !grows(scene, LoadKind::traction, traction.name);
                             }) ||
         std::ranges::any_of(scene.side, [&](const OutlineSide& part) {
           return part.kind == OutlineKind::loaded && part.pressure != 0.0 &&
                  lies_on(scene, part, side);
         });
}

bool drives_whole_side(const Scene& scene) {
  const Drive& drive = scene.drive;
  const double slack = same_place(scene.geometry);
  std::size_t k = 0;
  for (std::size_t i = 0; i < scene.geometry.min.size() && !drive.range_min.empty(); ++i) {
    if (static_cast<int>(i) == axis_of(drive.side)) continue;
    if (drive.range_min[k] > scene.geometry.min[i] + slack ||
        drive.range_max[k] < scene.geometry.max[i] - slack) {
      return false;
    }
    ++k;
  }
  return true;
}

}  // namespace scene

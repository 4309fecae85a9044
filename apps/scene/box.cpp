#include "scene/box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/scene.hpp"

namespace scene {

bool loads_plate(const Drive& drive) {
  return drive.kind == DriveKind::load && std::ranges::count(drive.scales, LoadKind::plate) > 0;
}

double plate_position(const Geometry& geometry, const Drive& drive) {
  return drive.level.value_or(side_position(geometry, drive.side));
}

bool is_mirror(const Scene& scene, Side side) {
  return std::ranges::any_of(scene.symmetry, [&](const Symmetry& symmetry) {
    return static_cast<int>(symmetry.axis) == axis_of(side) &&
           std::abs(symmetry.position - side_position(scene.geometry, side)) <=
               same_place(scene.geometry);
  });
}

double side_position(const Geometry& geometry, Side side) {
  const auto axis = static_cast<std::size_t>(axis_of(side));
  return is_upper(side) ? geometry.max[axis] : geometry.min[axis];
}

double coordinate_round_off(const Geometry& geometry) {
  double largest = 0.0;
  for (const Point& corner : {geometry.min, geometry.max}) {
    for (const double x : corner) largest = std::max(largest, std::abs(x));
  }
  return std::numeric_limits<double>::epsilon() * largest;
}

double same_place(const Geometry& geometry) {
  constexpr double of_spacing = 1e-9;
  constexpr double roundings = 8.0;  // on the way from what was typed to a difference
  return of_spacing * geometry.spacing + roundings * coordinate_round_off(geometry);
}

}  // namespace scene

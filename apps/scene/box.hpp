#pragma once

#include "scene/choices.hpp"

namespace scene {

struct Drive;
struct Geometry;
struct Scene;

/// Places less than this apart are one [m]: decimal input and the round-off of coordinates leave
/// them that far from where they are meant to be.
[[nodiscard]] double same_place(const Geometry& geometry);

/// Round-off of a difference of two coordinates of the body [m].
[[nodiscard]] double coordinate_round_off(const Geometry& geometry);

/// Whether a drive is a plate whose load grows.
[[nodiscard]] bool loads_plate(const Drive& drive);

/// Coordinate of a drive's plate across its side [m].
[[nodiscard]] double plate_position(const Geometry& geometry, const Drive& drive);

/// Whether there is a plane of symmetry at a side.
[[nodiscard]] bool is_mirror(const Scene& scene, Side side);

/// Index of the coordinate axis of a side's normal: 0 x, 1 y, 2 z.
[[nodiscard]] constexpr int axis_of(Side side) {
  return static_cast<int>(side) / 2;
}

/// Whether a side is at the upper end of its axis (right, top, back).
[[nodiscard]] constexpr bool is_upper(Side side) {
  return static_cast<int>(side) % 2 == 1;
}

/// Coordinate of a side of the box [m].
[[nodiscard]] double side_position(const Geometry& geometry, Side side);

}  // namespace scene

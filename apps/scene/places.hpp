#pragma once

#include <array>
#include <cstdint>

#include "scene/choices.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace scene {

/// Particles of the lattice by their indices along x, y, z: a box, first and last included. A shift
/// by jitter is not in it, but where it matters a box is wide enough for any.
struct LatticeBox {
  std::array<std::int64_t, 3> first{0, 0, 0};
  std::array<std::int64_t, 3> last{0, 0, 0};

  [[nodiscard]] bool empty() const;
  [[nodiscard]] bool meets(const LatticeBox& other) const;
};

/// The particles within a box of space.
[[nodiscard]] LatticeBox lattice_box(const Geometry& geometry, const Point& min, const Point& max);

/// The layer of particles next to a part of a side (empty: all of it).
[[nodiscard]] LatticeBox lattice_layer(const Geometry& geometry, Side side, const Point& range_min,
                                       const Point& range_max);

/// The particles that a support holds.
[[nodiscard]] LatticeBox lattice_box(const Geometry& geometry, const Support& support);

}  // namespace scene

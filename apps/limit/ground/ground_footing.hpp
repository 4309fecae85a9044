#pragma once

#include <cstddef>
#include <optional>

#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_scene.hpp"
#include "limit/problem/problem.hpp"

namespace limit::ground {

/// The scene's one footing: a straight base.
struct Base {
  std::size_t side = 0;
  mesh::Point first, second;  // its ends
  mesh::Point inward;         // unit normal
  mesh::Point along;          // unit tangent towards +x, or +y if it is upright
  double width = 0.0;
};

/// The footing's base; none if there is no footing, or, with a complaint, more than one or a base
/// that is not straight.
[[nodiscard]] std::optional<Base> find_base(const GroundScene& scene, const GroundOutline& outline,
                                            tables::Diagnosis& diagnosis);

/// Motions and loads of the footing, dead and live; the live one is that of a unit mean pressure.
[[nodiscard]] problem::Footing footing_of(const GroundScene& scene, const Base& base,
                                          tables::Diagnosis& diagnosis);

}  // namespace limit::ground

#pragma once

#include <array>

#include "limit/mesh/mesh.hpp"

namespace limit::problem {

/// A strength that changes from place to place in another way than a cohesion that is linear.
class Variation {
 public:
  struct Strength {
    double cohesion = 0.0;        // [Pa]
    double friction_angle = 0.0;  // [rad]
  };
  /// What is known of it in a triangle.
  struct Within {
    std::array<double, 3> cohesion{};       // [Pa] in the corners
    double below = 0.0, above = 0.0;        // [Pa] from what is linear between them, <= 0 and >= 0
    double least = 0.0, most = 0.0;         // [Pa] of the cohesion
    double gentlest = 0.0, steepest = 0.0;  // [rad] friction angles
  };

  Variation() = default;
  Variation(const Variation&) = delete;
  Variation& operator=(const Variation&) = delete;
  virtual ~Variation() = default;

  /// @param place  [m]
  [[nodiscard]] virtual Strength at(const mesh::Point& place) const = 0;
  /// Bounds that hold everywhere in a triangle, or, if its last two corners are one, along a side.
  [[nodiscard]] virtual Within within(const std::array<mesh::Point, 3>& corners) const = 0;
};

}  // namespace limit::problem

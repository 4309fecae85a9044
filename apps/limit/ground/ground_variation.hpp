#pragma once

#include "limit/problem/variation.hpp"
#include "tables/varying_number.hpp"

namespace limit::ground {

/// A number's bounds in a triangle, or along a side if its last two corners are one.
struct NumberWithin {
  std::array<double, 3> corner{};   // values
  double below = 0.0, above = 0.0;  // how far it comes off what is linear between them
  double least = 0.0, most = 0.0;
};

/// Exact, but for rounding, where it is linear, told by a table or by a raster; of the nearest
/// points all those count that might be nearest somewhere.
[[nodiscard]] NumberWithin number_within(const tables::VaryingNumber& number,
                                         const std::array<mesh::Point, 3>& corners);

/// A strength as a scene tells it.
class GroundVariation final : public problem::Variation {
 public:
  /// @param cohesion  [Pa]  @param friction_angle  [deg]
  GroundVariation(tables::VaryingNumber cohesion, tables::VaryingNumber friction_angle)
      : cohesion_(std::move(cohesion)), friction_angle_(std::move(friction_angle)) {}

  [[nodiscard]] Strength at(const mesh::Point& place) const override;
  [[nodiscard]] Within within(const std::array<mesh::Point, 3>& corners) const override;

 private:
  tables::VaryingNumber cohesion_, friction_angle_;
};

}  // namespace limit::ground

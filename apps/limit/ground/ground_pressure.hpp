#pragma once

#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_types.hpp"
#include "limit/problem/pore_pressure.hpp"
#include "shape/pressure_field.hpp"

namespace limit::ground {

/// A pore pressure as a scene tells it.
class GroundPressure final : public problem::PorePressure {
 public:
  explicit GroundPressure(const tables::VaryingNumber& told) : field_(told) {}

  [[nodiscard]] double at(const mesh::Point& place) const override { return field_.at(place); }
  [[nodiscard]] std::vector<Corner> corners_in(
      const std::array<mesh::Point, 3>& triangle) const override;
  [[nodiscard]] double largest() const override { return field_.largest(); }
  [[nodiscard]] const shape::PressureField& field() const { return field_; }

 private:
  shape::PressureField field_;
};

/// Puts points on the outline where the pressure along it is no longer linear, but on sides that
/// hold the ground across.
void divide_at_kinks(const GroundScene& scene, const shape::PressureField& field,
                     GroundOutline& outline);

}  // namespace limit::ground

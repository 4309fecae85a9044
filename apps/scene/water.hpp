#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scene/scene.hpp"
#include "shape/pressure_field.hpp"
#include "shape/water.hpp"

namespace scene {

/// The pore water of a completed scene: hydrostatic below its table, a share of the overburden, or
/// a pressure that is told from place to place. Its pressure is given, whatever the ground does.
class PoreWater {
 public:
  explicit PoreWater(const Scene& scene);

  /// [Pa] At a place, 0 where there is none.
  [[nodiscard]] double pressure_at(std::span<const double> place) const;

  /// What water does to a cell of ground.
  struct InCell {
    double wet = 0.0;                           // share of the cell that is saturated
    shape::Point force = shape::Point::Zero();  // [N/m3] mean of the pressure's fall
  };
  /// @param lower, upper  corners of the cell  @param centre  of the ground in it
  [[nodiscard]] InCell in_cell(const shape::Point& lower, const shape::Point& upper,
                               const shape::Point& centre) const;

 private:
  [[nodiscard]] InCell in_field(const shape::Point& lower, const shape::Point& upper) const;

  double unit_weight_ = 0.0;  // [N/m3]
  shape::Ring table_;         // from left to right; none: a share of the overburden
  double share_ = 0.0;        // r_u
  std::vector<shape::HeavyRing> ground_;
  std::optional<shape::PressureField> field_;
};

/// Whether there is pore water in the ground.
[[nodiscard]] bool has_water(const Scene& scene);

/// Whether a pressure that is told depends on the height alone.
[[nodiscard]] bool is_level(const tables::VaryingNumber& pore_pressure);

/// [kg/m3] Density of a completed scene's material at a place below the water table.
[[nodiscard]] double saturated_density(const Material& material, std::span<const double> place);

/// The regions of a completed scene with their unit weights under gravity at rest, as r_u counts
/// them.
[[nodiscard]] std::vector<shape::HeavyRing> heavy_regions(const Scene& scene);

}  // namespace scene

#include "scene/geostatic.hpp"

#include <algorithm>
#include <cmath>

#include "scene/box.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace scene {
namespace {

// The share of a slice in which there is a pressure, at one of its ends or both.
double wet_share(const tables::VaryingNumber& told, const Point& middle, double slice) {
  constexpr std::size_t up = 1;
  Point place = middle;
  const auto is_wet = [&](double share) {
    place[up] = middle[up] + (share - 0.5) * slice;
    return told.at_place(place) > 0.0;
  };
  const bool below = is_wet(0.0);
  if (below == is_wet(1.0)) return below ? 1.0 : 0.0;
  double low = 0.0, high = 1.0;
  constexpr double rounding = 1e-15;
  while (high - low > rounding) {
    const double share = 0.5 * (low + high);
    (is_wet(share) == below ? low : high) = share;
  }
  return below ? low : 1.0 - low;
}

}  // namespace

double geostatic_stress(const Scene& scene, std::span<const double> place) {
  constexpr std::size_t up = 1;
  const double gravity = -scene.gravity.acceleration[up];
  const double surface = scene.initial_stress.surface.value_or(scene.geometry.max[up]);
  const double depth = surface - place[up];
  const double spacing = scene.geometry.spacing;
  // As many at a whole number of spacings, whatever the round-off of the depth.
  const double slices =
      std::max(1.0, std::ceil((std::abs(depth) - same_place(scene.geometry)) / spacing));
  Point at(place.begin(), place.end());
  double vertical = -scene.initial_stress.surcharge;
  const double slice = depth / slices;
  const auto& table = scene.water.table;
  const auto& told = scene.water.pore_pressure;
  if (told) {
    at[up] = surface;
    vertical += std::max(0.0, told->at_place(place)) - std::max(0.0, told->at_place(at));
  }
  for (double k = 0.5; k < slices; k += 1.0) {
    at[up] = surface - depth * (k / slices);
    const Material& material = scene.material[material_at(scene, at)];
    const double density = material.density.at_place(at);
    vertical -= density * gravity * (depth / slices);
    if (told) {
      const double more = (saturated_density(material, at) - density) * gravity;
      if (more != 0.0) vertical -= wet_share(*told, at, std::abs(slice)) * more * slice;
    }
    if (table.empty() || slice == 0.0) continue;
    // It is level in ground whose stress is geostatic.
    const double below = (table.front().y() - at[up]) / std::abs(slice) + 0.5;
    const double more = (saturated_density(material, at) - density) * gravity;
    vertical += std::clamp(below, 0.0, 1.0) * (scene.water.unit_weight - more) * slice;
  }
  return vertical;
}

}  // namespace scene

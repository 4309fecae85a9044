#include "scene/geostatic.hpp"

#include <algorithm>
#include <cmath>

#include "scene/box.hpp"
#include "scene/derived.hpp"
#include "scene/layers.hpp"
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

constexpr std::size_t up = 1;

// Adds what a slice around `middle`, `thick` down, does to the stress below it, effective where
// there is water.
void add_slice(const Scene& scene, const Material& material, const Point& middle, double thick,
               double& vertical) {
  const double gravity = -scene.gravity.acceleration[up];
  const auto& table = scene.water.table;
  const auto& told = scene.water.pore_pressure;
  const double density = material.density.at_place(middle);
  vertical -= density * gravity * thick;
  if (thick == 0.0 || (!told && table.empty())) return;
  const double more = (saturated_density(material, middle) - density) * gravity;
  if (told && more != 0.0) vertical -= wet_share(*told, middle, std::abs(thick)) * more * thick;
  if (table.empty()) return;
  // It is level in ground whose stress is geostatic.
  const double below = (table.front().y() - middle[up]) / std::abs(thick) + 0.5;
  vertical += std::clamp(below, 0.0, 1.0) * (scene.water.unit_weight - more) * thick;
}

// As many slices of at most a spacing at a whole number of spacings, whatever the round-off.
double slices_in(const Scene& scene, double depth) {
  return std::max(
      1.0, std::ceil((std::abs(depth) - same_place(scene.geometry)) / scene.geometry.spacing));
}

// Adds the weight of the ground from one level down to another, above a place.
template <class MaterialAt>
void add_between(const Scene& scene, double from, double to, Point at,
                 MaterialAt&& material_at_place, double& vertical) {
  const double depth = from - to;
  const double slices = slices_in(scene, depth);
  for (double k = 0.5; k < slices; k += 1.0) {
    at[up] = from - depth * (k / slices);
    add_slice(scene, scene.material[material_at_place(at)], at, depth / slices, vertical);
  }
}

}  // namespace

double geostatic_stress(const Scene& scene, std::span<const double> place) {
  return geostatic_stress(scene, layers_of(scene), place);
}

double geostatic_stress(const Scene& scene, std::span<const Layer> layers,
                        std::span<const double> place) {
  const bool has_regions = !scene.region.empty() && !layers.empty();
  const double highest = has_regions ? layers.front().top : scene.geometry.max[up];
  const double surface = scene.initial_stress.surface.value_or(highest);
  Point at(place.begin(), place.end());
  double vertical = -scene.initial_stress.surcharge;
  const auto& told = scene.water.pore_pressure;
  if (told) {
    at[up] = surface;
    vertical += std::max(0.0, told->at_place(place)) - std::max(0.0, told->at_place(at));
  }
  if (scene.region.empty()) {
    const auto material = [&](const Point& here) { return material_at(scene, here); };
    add_between(scene, surface, place[up], at, material, vertical);
    return vertical;
  }
  for (const Layer& layer : layers) {
    const double from = std::min(layer.top, surface), to = std::max(layer.bottom, place[up]);
    if (from <= to) continue;
    const auto material = [&](const Point&) { return layer.material; };
    add_between(scene, from, to, at, material, vertical);
  }
  return vertical;
}

}  // namespace scene

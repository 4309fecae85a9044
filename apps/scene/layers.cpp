#include "scene/layers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/course.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace scene {
namespace {

constexpr double round_off = 1e-9;

bool is_there_at_first(const Scene& scene, const Region& region) {
  return region_is_there(scene, 0, region.name);
}

bool near(double a, double b) {
  return std::abs(a - b) <= round_off * std::max(std::abs(a), std::abs(b));
}

double slack_of(const Scene& scene) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Region& region : scene.region) {
    low = std::min(low, region.lowest);
    high = std::max(high, region.highest);
  }
  return round_off * (high - low);
}

}  // namespace

std::vector<Layer> layers_of(const Scene& scene) {
  std::vector<double> levels;
  for (const Region& region : scene.region) {
    if (!is_there_at_first(scene, region)) continue;
    levels.insert(levels.end(), {region.lowest, region.highest});
  }
  std::ranges::sort(levels, std::greater());
  const double slack = slack_of(scene);
  std::vector<Layer> layers;
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    if (levels[i] - levels[i + 1] <= slack) continue;
    const double middle = 0.5 * (levels[i] + levels[i + 1]);
    for (std::size_t r = 0; r < scene.region.size(); ++r) {
      const Region& region = scene.region[r];
      if (!is_there_at_first(scene, region) || region.lowest > middle || region.highest < middle) {
        continue;
      }
      const double top = layers.empty() ? levels[i] : layers.back().bottom;
      layers.push_back({top, levels[i + 1], material_of(scene, r)});
      break;
    }
  }
  // What is above the body is as its uppermost layer.
  if (!layers.empty()) layers.front().top = std::max(layers.front().top, surface_level(scene));
  return layers;
}

double surface_level(const Scene& scene) {
  return scene.initial_stress.surface.value_or(highest_level(scene));
}

double highest_level(const Scene& scene) {
  if (scene.region.empty()) return scene.geometry.max[1];
  double highest = -std::numeric_limits<double>::infinity();
  for (const Region& region : scene.region) {
    if (is_there_at_first(scene, region)) highest = std::max(highest, region.highest);
  }
  return highest;
}

bool weigh_alike(const Scene& scene, const Material& one, const Material& other) {
  const bool is_wet = !scene.water.table.empty() || scene.water.pore_pressure.has_value();
  // A saturated weight is told as one above the water is.
  const bool as_wet = !is_wet || (one.saturated_unit_weight == other.saturated_unit_weight &&
                                  one.unit_weight == other.unit_weight);
  return one.density == other.density && as_wet &&
         near(resolve_k0(scene, one), resolve_k0(scene, other));
}

std::vector<Neighbours> two_beside_one_another(const Scene& scene) {
  std::vector<Neighbours> found;
  const double slack = slack_of(scene);
  for (std::size_t r = 0; r < scene.region.size(); ++r) {
    for (std::size_t s = r + 1; s < scene.region.size(); ++s) {
      const Region &one = scene.region[r], &other = scene.region[s];
      if (!is_there_at_first(scene, one) || !is_there_at_first(scene, other)) continue;
      const double low = std::max(one.lowest, other.lowest);
      const double high = std::min(one.highest, other.highest);
      if (high - low <= slack) continue;
      if (weigh_alike(scene, scene.material[material_of(scene, r)],
                      scene.material[material_of(scene, s)])) {
        continue;
      }
      found.push_back({r, s, low, high});
    }
  }
  return found;
}

}  // namespace scene

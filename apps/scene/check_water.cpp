#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"
#include "scene/water.hpp"

namespace scene {
namespace {

void check_saturated(const Scene& scene, std::size_t m, tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[m];
  const std::string key = fmt::format("material.{}.saturated_unit_weight", m);
  if (!material.saturated_unit_weight || !diagnosis.good({key})) return;
  const double weight = material.saturated_unit_weight->value;
  if (material.unit_weight.value_or(0.0).value <= 0.0) {
    diagnosis.error(key, fmt::format("found {} without a unit_weight", weight),
                    "give the unit_weight above the water table, too");
  } else if (scene.water.table.empty() && !scene.water.pore_pressure) {
    diagnosis.warning(key, fmt::format("found {} without a water table", weight),
                      "it has no effect: only below water.table ground is saturated");
  }
}

// Ground lighter than water has no stress that is geostatic, and none of gravity.
void check_floats(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t m = 0; m < scene.material.size() && !scene.water.table.empty(); ++m) {
    const Material& material = scene.material[m];
    const double dry = material.unit_weight.value_or(0.0).value;
    const double weight = material.saturated_unit_weight.value_or(dry).value;
    if (weight <= 0.0 || weight >= scene.water.unit_weight) continue;
    diagnosis.warning(
        fmt::format("material.{}.{}", m,
                    material.saturated_unit_weight ? "saturated_unit_weight" : "unit_weight"),
        fmt::format("found {}, less than the water's {}", weight, scene.water.unit_weight),
        "it floats below the water table");
  }
}

// The box may be a part of a spacing wider than its regions.
shape::Ring corners_of_ground(const Scene& scene) {
  shape::Ring corners;
  for (const Region& region : scene.region) {
    for (const PlanePoint& place : region.outline) corners.emplace_back(place.x(), place.y());
  }
  if (!corners.empty()) return corners;
  const Point &low = scene.geometry.min, &high = scene.geometry.max;
  return {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}};
}

void check_table(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis)) return;
  const shape::Ring corners = corners_of_ground(scene);
  shape::Point low = corners.front(), high = low;
  for (const shape::Point& place : corners) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  shape::Ring table;
  for (const PlanePoint& place : scene.water.table) table.emplace_back(place.x(), place.y());
  if (!shape::is_water_table(table, low, high, diagnosis)) return;
  const auto lowest = std::ranges::min(table, {}, [](const auto& point) { return point.y(); });
  const auto highest = std::ranges::max(table, {}, [](const auto& point) { return point.y(); });
  if (scene.initial_stress.kind == InitialStressKind::geostatic && lowest.y() != highest.y() &&
      diagnosis.good({"initial_stress.kind"})) {
    diagnosis.error("water.table",
                    fmt::format("found levels from {} to {} with a geostatic initial stress",
                                lowest.y(), highest.y()),
                    "water that seeps leaves no geostatic stress: kind = \"gravity\", or a level "
                    "table");
  }
}

void check_share(const Scene& scene, tables::Diagnosis& diagnosis) {
  const char* const key = "water.r_u";
  const auto varying = std::ranges::find_if(
      scene.material, [](const Material& material) { return material.density.varies(); });
  if (varying != scene.material.end()) {
    diagnosis.error(key,
                    fmt::format("found {}, and the weight of {} changes from place to place",
                                *scene.water.r_u, varying->name),
                    "give a water table, or one weight");
    return;
  }
  if (scene.region.empty()) {
    diagnosis.error(key, fmt::format("found {} in a box", *scene.water.r_u),
                    "it belongs to a body of [[region]]s; in a box give a table");
  } else if (is_solid(scene)) {
    diagnosis.error(key, fmt::format("found {} with volumes of a mesh", *scene.water.r_u),
                    "the weight above is that of polygons: give a table");
  } else if (!scene.cutout.empty()) {
    diagnosis.error(key, fmt::format("found {} in ground with a cutout", *scene.water.r_u),
                    "there is no weight above it that was not borne by what is cut out: give a "
                    "table");
  } else {
    static_cast<void>(shape::has_overburden(heavy_regions(scene), key, diagnosis));
  }
}

void check_told(const Scene& scene, const tables::VaryingNumber& told,
                tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis)) return;
  const std::string key = "water.pore_pressure";
  // A scene that was printed has the default.
  if (scene.water.unit_weight != Water{}.unit_weight) {
    diagnosis.warning("water.unit_weight",
                      fmt::format("found {} beside pore_pressure", scene.water.unit_weight),
                      "it has no effect: that is of a table's water");
  }
  const shape::Ring corners = corners_of_ground(scene);
  const bool is_good = shape::is_pressure_of(told, corners, key, diagnosis);
  if (is_good && scene.initial_stress.kind == InitialStressKind::geostatic && !is_level(told) &&
      diagnosis.good({"initial_stress.kind"})) {
    diagnosis.error(key, "found a pressure that is not level with a geostatic initial stress",
                    "water that seeps aside leaves no geostatic stress: kind = \"gravity\", or a "
                    "pressure that changes along y alone, told by a gradient or a table");
  }
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    const std::string later = fmt::format("stage.{}.pore_pressure", s);
    if (!scene.stage[s].pore_pressure || !diagnosis.good({later})) continue;
    static_cast<void>(
        shape::is_pressure_of(*scene.stage[s].pore_pressure, corners, later, diagnosis));
  }
}

}  // namespace

void check_water(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"water", "water.table", "water.unit_weight", "water.r_u",
                       "water.pore_pressure", "material", "geometry.dimension",
                       "gravity.acceleration"})) {
    return;
  }
  for (std::size_t m = 0; m < scene.material.size(); ++m) check_saturated(scene, m, diagnosis);
  if (!has_water(scene)) return;
  const auto& told = scene.water.pore_pressure;
  const std::string key = told              ? "water.pore_pressure"
                          : scene.water.r_u ? "water.r_u"
                                            : "water.table";
  if (told && (scene.water.r_u || !scene.water.table.empty())) {
    diagnosis.error(key, fmt::format("found beside {}", scene.water.r_u ? "r_u" : "a table"),
                    "the pressure is what one of them says: leave the other out");
  } else if (scene.water.r_u && !scene.water.table.empty()) {
    diagnosis.error(key, fmt::format("found {}, and a table", *scene.water.r_u),
                    "the pressure is what one of them says: leave the other out");
  } else if (scene.gravity.acceleration.size() < 2 || scene.gravity.acceleration[1] >= 0.0) {
    diagnosis.error(key, "found in ground without weight along -y",
                    "give materials a unit_weight, or gravity.acceleration downwards");
  } else if (scene.gravity.acceleration.size() == 3 && scene.gravity.acceleration[2] != 0.0) {
    diagnosis.error(key, "found in ground whose weight acts along z as well",
                    "water is the same along z: gravity.acceleration = [0, -g, 0]");
  } else if (told) {
    check_told(scene, *told, diagnosis);
  } else if (scene.water.r_u) {
    check_share(scene, diagnosis);
  } else {
    check_table(scene, diagnosis);
    check_floats(scene, diagnosis);
  }
}

}  // namespace scene

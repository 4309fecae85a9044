#include "limit/ground/ground_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "limit/ground/ground_cut.hpp"
#include "limit/ground/ground_pressure.hpp"
#include "limit/ground/ground_soils.hpp"
#include "shape/pressure_field.hpp"
#include "shape/water.hpp"

namespace limit::ground {

namespace {

void wet_below_table(GroundScene& scene, const Extent& ground) {
  const auto& table = scene.water.table;
  double low = ground.low.y(), high = ground.high.y();
  for (const mesh::Point& point : table) {
    low = std::min(low, point.y());
    high = std::max(high, point.y());
  }
  const double bottom = low - (high - low), top = high + (high - low);
  std::vector<mesh::Point> dry = table;
  dry.insert(dry.end(), {{table.back().x(), top}, {table.front().x(), top}});
  std::vector<GroundRegion> regions;
  for (const GroundRegion& whole : scene.regions) {
    for (GroundPart& part : parts_within(whole, dry, ground)) {
      regions.push_back(std::move(part.region));
    }
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      const mesh::Point &from = table[i], &to = table[i + 1];
      GroundMaterial saturated = scene.materials[whole.material];
      problem::Soil& soil = saturated.soil;
      if (saturated.saturated_unit_weight) take_weight(*saturated.saturated_unit_weight, soil);
      const double slope = (to.y() - from.y()) / (to.x() - from.x());
      soil.seepage = scene.water.unit_weight * mesh::Point(-slope, 1.0);
      scene.materials.push_back(std::move(saturated));
      const std::vector<mesh::Point> below{from, {from.x(), bottom}, {to.x(), bottom}, to};
      for (GroundPart& part : parts_within(whole, below, ground)) {
        part.region.material = scene.materials.size() - 1;
        regions.push_back(std::move(part.region));
      }
    }
  }
  scene.regions = std::move(regions);
}

// Between uprights through all corners the weight above is linear in each part of a region.
void wet_by_overburden(GroundScene& scene, const Extent& ground, tables::Diagnosis& diagnosis) {
  std::vector<shape::HeavyRing> heavy;
  std::set<double> corners;
  for (const GroundRegion& region : scene.regions) {
    const double weight = scene.materials[region.material].soil.unit_weight;
    heavy.push_back({region.outline, weight});
    for (const mesh::Point& corner : region.outline) corners.insert(corner.x());
    for (const auto& hole : region.holes) {
      heavy.push_back({hole, -weight});
      for (const mesh::Point& corner : hole) corners.insert(corner.x());
    }
  }
  if (!shape::has_overburden(heavy, "water.r_u", diagnosis)) return;
  const mesh::Point size = ground.high - ground.low;
  const double bottom = ground.low.y() - size.y(), top = ground.high.y() + size.y();
  constexpr double rounding = 1e-9;
  std::vector<double> uprights{ground.low.x() - size.x()};
  for (const double x : corners) {
    const bool inside = x > ground.low.x() && x < ground.high.x();
    if (inside && x - uprights.back() > rounding * size.x()) uprights.push_back(x);
  }
  uprights.push_back(ground.high.x() + size.x());
  std::vector<GroundRegion> regions;
  for (const GroundRegion& whole : scene.regions) {
    for (std::size_t i = 0; i + 1 < uprights.size(); ++i) {
      const double left = uprights[i], right = uprights[i + 1];
      const std::vector<mesh::Point> between{
          {left, bottom}, {right, bottom}, {right, top}, {left, top}};
      for (GroundPart& part : parts_within(whole, between, ground)) {
        GroundMaterial loaded = scene.materials[whole.material];
        loaded.soil.seepage = -*scene.water.r_u * shape::overburden(heavy, part.centre).gradient;
        scene.materials.push_back(std::move(loaded));
        part.region.material = scene.materials.size() - 1;
        regions.push_back(std::move(part.region));
      }
    }
  }
  scene.regions = std::move(regions);
}

// A pressure that is linear everywhere, or between the lines of a table: a few parts.
void wet_as_told(GroundScene& scene, const Extent& ground) {
  const mesh::Point size = ground.high - ground.low;
  const mesh::Point low = ground.low - size, high = ground.high + size;
  const shape::PressureField field(*scene.water.pore_pressure);
  const auto pieces = field.within({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  std::vector<GroundRegion> regions;
  for (const GroundRegion& whole : scene.regions) {
    for (const auto& piece : pieces) {
      for (GroundPart& part : parts_within(whole, piece.ring, ground)) {
        GroundMaterial wet = scene.materials[whole.material];
        if (piece.wet && wet.saturated_unit_weight) {
          take_weight(*wet.saturated_unit_weight, wet.soil);
        }
        wet.soil.seepage = -piece.gradient;
        scene.materials.push_back(std::move(wet));
        part.region.material = scene.materials.size() - 1;
        regions.push_back(std::move(part.region));
      }
    }
  }
  scene.regions = std::move(regions);
}

// The weight of ground is balanced exactly, and a place may be wet or not within a triangle.
void check_saturated(const GroundScene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const GroundMaterial& material = scene.materials[m];
    if (!material.saturated_unit_weight || *material.saturated_unit_weight == material.unit_weight)
      continue;
    diagnosis.error(fmt::format("material.{}.saturated_unit_weight", m),
                    "given with a pressure that is told by points or a raster",
                    "there it is not known along a line where ground is saturated: give regions "
                    "that are wet a material of their own, whose unit_weight that is");
    return;
  }
}

void wet_in_field(GroundScene& scene, const Extent& ground, tables::Diagnosis& diagnosis) {
  const std::string key = "water.pore_pressure";
  if (scene.water.r_u || !scene.water.table.empty()) {
    diagnosis.error(key, fmt::format("found beside {}", scene.water.r_u ? "r_u" : "a table"),
                    "the pressure is what one of them says: leave the other out");
    return;
  }
  shape::Ring corners;
  for (const GroundRegion& region : scene.regions) {
    corners.insert(corners.end(), region.outline.begin(), region.outline.end());
  }
  if (!shape::is_pressure_of(*scene.water.pore_pressure, corners, key, diagnosis)) return;
  if (scene.water.is_in_triangles()) {
    check_saturated(scene, diagnosis);
    scene.water.in_triangles = std::make_shared<const GroundPressure>(*scene.water.pore_pressure);
  } else {
    wet_as_told(scene, ground);
  }
}

const GroundMaterial* first_of_uneven_weight(const GroundScene& scene) {
  for (const GroundMaterial& material : scene.materials) {
    if (material.soil.has_uneven_weight()) return &material;
  }
  return nullptr;
}

// Ground that floats mostly is a number in another unit.
void warn_of_light_ground(const GroundScene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const GroundMaterial& material = scene.materials[m];
    const bool is_first = std::none_of(
        scene.materials.begin(), scene.materials.begin() + static_cast<std::ptrdiff_t>(m),
        [&](const GroundMaterial& other) { return other.name == material.name; });
    const bool is_wet = material.saturated_unit_weight.has_value();
    const tables::VaryingNumber& weight =
        is_wet ? *material.saturated_unit_weight : material.unit_weight;
    const double water = scene.water.unit_weight;
    if (!is_first || weight.varies() || weight.value == 0.0 || weight.value >= water) continue;
    diagnosis.warning(
        fmt::format("material.{}.{}", m, is_wet ? "saturated_unit_weight" : "unit_weight"),
        fmt::format("found {:g}, less than that of water, {:g}", weight.value, water),
        "such ground floats where it is under water; are both in one unit, stress over length?");
  }
}

}  // namespace

void wet(GroundScene& scene, tables::Diagnosis& diagnosis) {
  if (!scene.water.is_there()) return;
  const Extent ground = extent_of(scene);
  if (scene.water.pore_pressure) {
    wet_in_field(scene, ground, diagnosis);
  } else if (scene.water.r_u && !scene.water.table.empty()) {
    diagnosis.error("water.r_u", fmt::format("found {:g}, and a table", *scene.water.r_u),
                    "the pressure is what one of them says: leave the other out");
  } else if (const auto still = std::ranges::find(scene.materials, false, &GroundMaterial::grows);
             scene.water.r_u && scene.load.sought == Sought::gravity &&
             still != scene.materials.end()) {
    diagnosis.error(
        "water.r_u",
        fmt::format("found {:g}, with gravity sought, and the weight of {} does not grow",
                    *scene.water.r_u, still->name),
        "a share of the weight above grows with all of it: let all materials grow, or "
        "give a table, whose water stays as it is");
  } else if (const GroundMaterial* uneven = first_of_uneven_weight(scene);
             scene.water.r_u && uneven != nullptr) {
    diagnosis.error("water.r_u",
                    fmt::format("found {:g}, and the weight of {} changes from place to place",
                                *scene.water.r_u, uneven->name),
                    "give a water table, or one weight");
  } else if (scene.water.r_u) {
    wet_by_overburden(scene, ground, diagnosis);
  } else if (shape::is_water_table(scene.water.table, ground.low, ground.high, diagnosis)) {
    warn_of_light_ground(scene, diagnosis);
    wet_below_table(scene, ground);
  }
}

}  // namespace limit::ground

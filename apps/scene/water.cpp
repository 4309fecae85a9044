#include "scene/water.hpp"

#include <algorithm>
#include <cmath>

#include "scene/ground.hpp"

namespace scene {
namespace {

// The integral of what of 0 ... height is below a line that goes from `first` to `second` over a
// width.
double area_below(double first, double second, double height, double width) {
  const auto primitive = [&](double z) {
    if (z <= 0.0) return 0.0;
    return z < height ? 0.5 * z * z : height * (z - 0.5 * height);
  };
  const double rise = second - first;
  // A level line, but for rounding.
  if (std::abs(rise) <= 1e-9 * height) {
    return width * std::clamp(0.5 * (first + second), 0.0, height);
  }
  return width * (primitive(second) - primitive(first)) / rise;
}

// Height of the line through two points at x, which is between them or not.
double line_at(const shape::Point& left, const shape::Point& right, double x) {
  return left.y() + (right.y() - left.y()) / (right.x() - left.x()) * (x - left.x());
}

}  // namespace

PoreWater::PoreWater(const Scene& scene) : unit_weight_(scene.water.unit_weight) {
  for (const PlanePoint& place : scene.water.table) table_.emplace_back(place.x(), place.y());
  if (scene.water.pore_pressure) field_.emplace(*scene.water.pore_pressure);
  if (!table_.empty() || !scene.water.r_u) return;
  share_ = *scene.water.r_u;
  ground_ = heavy_regions(scene);
}

double PoreWater::pressure_at(std::span<const double> place) const {
  if (field_) return field_->at({place[0], place[1]});
  if (table_.empty()) {
    return share_ > 0.0 ? share_ * shape::overburden(ground_, {place[0], place[1]}).value : 0.0;
  }
  std::size_t i = 0;
  while (i + 2 < table_.size() && place[0] >= table_[i + 1].x()) ++i;
  return unit_weight_ * std::max(0.0, line_at(table_[i], table_[i + 1], place[0]) - place[1]);
}

PoreWater::InCell PoreWater::in_cell(const shape::Point& lower, const shape::Point& upper,
                                     const shape::Point& centre) const {
  if (field_) return in_field(lower, upper);
  InCell cell;
  if (table_.empty()) {
    if (share_ > 0.0) cell.force = -share_ * shape::overburden(ground_, centre).gradient;
    return cell;
  }
  const double height = upper.y() - lower.y();
  const double area = height * (upper.x() - lower.x());
  for (std::size_t i = 0; i + 1 < table_.size(); ++i) {
    const shape::Point &left = table_[i], &right = table_[i + 1];
    // Beyond its ends the table goes on.
    const double from = i == 0 ? lower.x() : std::max(lower.x(), left.x());
    const double to = i + 2 == table_.size() ? upper.x() : std::min(upper.x(), right.x());
    if (to <= from) continue;
    const double share = area_below(line_at(left, right, from) - lower.y(),
                                    line_at(left, right, to) - lower.y(), height, to - from) /
                         area;
    const double slope = (right.y() - left.y()) / (right.x() - left.x());
    cell.wet += share;
    cell.force += share * unit_weight_ * shape::Point(-slope, 1.0);
  }
  return cell;
}

// The mean over what of the cell the pressure is told of.
PoreWater::InCell PoreWater::in_field(const shape::Point& lower, const shape::Point& upper) const {
  InCell cell;
  double area = 0.0;
  for (const auto& piece :
       field_->within({lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}})) {
    area += piece.area;
    if (!piece.wet) continue;
    cell.wet += piece.area;
    cell.force -= piece.area * piece.gradient;
  }
  if (area > 0.0) {
    cell.wet /= area;
    cell.force /= area;
  }
  return cell;
}

bool has_water(const Scene& scene) {
  return !scene.water.table.empty() || scene.water.r_u.value_or(0.0) > 0.0 ||
         scene.water.pore_pressure.has_value();
}

bool is_level(const tables::VaryingNumber& pore_pressure) {
  if (pore_pressure.is_linear()) return pore_pressure.gradient[0] == 0.0;
  return pore_pressure.samples->kind == tables::Samples::Kind::table &&
         pore_pressure.samples->axis == 1;
}

double saturated_density(const Material& material, std::span<const double> place) {
  const double density = material.density.at_place(place);
  if (!material.saturated_unit_weight || !material.unit_weight) return density;
  const double dry = material.unit_weight->at_place(place);
  return dry > 0.0 ? density * (material.saturated_unit_weight->at_place(place) / dry) : density;
}

std::vector<shape::HeavyRing> heavy_regions(const Scene& scene) {
  // Gravity at rest: an earthquake shakes the ground, not what its water bears.
  const double g = scene.gravity.acceleration.empty()
                       ? 0.0
                       : -scene.gravity.acceleration[1] / (1.0 - scene.load.kv);
  std::vector<shape::HeavyRing> ground;
  for (std::size_t r = 0; r < scene.region.size(); ++r) {
    if (!scene.region[r].present) continue;
    const double weight = scene.material[material_of(scene, r)].density.value * g;
    const auto add = [&](const std::vector<PlanePoint>& places, double unit_weight) {
      shape::HeavyRing& part = ground.emplace_back();
      for (const PlanePoint& place : places) part.ring.emplace_back(place.x(), place.y());
      part.unit_weight = unit_weight;
    };
    add(scene.region[r].outline, weight);
    for (const auto& hole : scene.region[r].holes) add(hole, -weight);
  }
  return ground;
}

}  // namespace scene

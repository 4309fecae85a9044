#include "limit/ground/ground_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <utility>

namespace limit::ground {

namespace {

using Place = boost::geometry::model::d2::point_xy<double>;
using Polygon = boost::geometry::model::polygon<Place, false, false>;

using Ring = Polygon::ring_type;

Ring ring_of(const std::vector<mesh::Point>& outline) {
  Ring ring;
  for (const mesh::Point& point : outline) ring.emplace_back(point.x(), point.y());
  return ring;
}

Polygon polygon_of(const std::vector<mesh::Point>& outline,
                   const std::vector<std::vector<mesh::Point>>& holes = {}) {
  Polygon polygon;
  polygon.outer() = ring_of(outline);
  for (const std::vector<mesh::Point>& hole : holes) polygon.inners().push_back(ring_of(hole));
  boost::geometry::correct(polygon);
  return polygon;
}

// Where the table meets an outline, both give the place, but for rounding.
std::vector<mesh::Point> outline_of(const Ring& ring, double one_place) {
  std::vector<mesh::Point> outline;
  for (const Place& place : ring) {
    const mesh::Point point(place.x(), place.y());
    if (outline.empty() || (point - outline.back()).norm() > one_place) outline.push_back(point);
  }
  while (outline.size() > 1 && (outline.front() - outline.back()).norm() <= one_place) {
    outline.pop_back();
  }
  return outline;
}

struct Extent {
  mesh::Point low{0.0, 0.0}, high{0.0, 0.0};
};

Extent extent_of(const GroundScene& scene) {
  Extent extent{scene.regions.front().outline.front(), scene.regions.front().outline.front()};
  for (const GroundRegion& region : scene.regions) {
    for (const mesh::Point& place : region.outline) {
      extent.low = extent.low.cwiseMin(place);
      extent.high = extent.high.cwiseMax(place);
    }
  }
  return extent;
}

bool covers(const std::vector<mesh::Point>& table, const Extent& ground,
            tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    if (table[i].x() < table[i + 1].x()) continue;
    diagnosis.error("water.table",
                    fmt::format("found x = {:g} after {:g}", table[i + 1].x(), table[i].x()),
                    "allowed are points from left to right, no two above each other");
    return false;
  }
  if (table.size() > 1 && table.front().x() <= ground.low.x() &&
      table.back().x() >= ground.high.x()) {
    return true;
  }
  diagnosis.error(
      "water.table",
      fmt::format("found a table from x = {:g} to {:g}", table.front().x(), table.back().x()),
      fmt::format("allowed is one over all of the ground, from {:g} or less to {:g} or more",
                  ground.low.x(), ground.high.x()));
  return false;
}

// No sliver, as is left where a region's outline and the table are one line.
bool is_something(const Polygon& part, const Extent& ground) {
  constexpr double nothing = 1e-9;
  return boost::geometry::area(part) > nothing * (ground.high - ground.low).squaredNorm();
}

}  // namespace

void wet(GroundScene& scene, tables::Diagnosis& diagnosis) {
  const auto& table = scene.water.table;
  if (table.empty()) return;
  const Extent ground = extent_of(scene);
  if (!covers(table, ground, diagnosis)) return;
  double low = ground.low.y(), high = ground.high.y();
  for (const mesh::Point& point : table) {
    low = std::min(low, point.y());
    high = std::max(high, point.y());
  }
  const double bottom = low - (high - low), top = high + (high - low);
  std::vector<mesh::Point> dry = table;
  dry.insert(dry.end(), {{table.back().x(), top}, {table.front().x(), top}});
  std::vector<GroundRegion> regions;
  const auto cut = [&](const GroundRegion& whole, const std::vector<mesh::Point>& with,
                       std::size_t material) {
    std::vector<Polygon> parts;
    boost::geometry::intersection(polygon_of(whole.outline, whole.holes), polygon_of(with), parts);
    for (const Polygon& part : parts) {
      if (!is_something(part, ground)) continue;
      GroundRegion& region = regions.emplace_back(whole);
      constexpr double rounding = 1e-9;
      const double one_place = rounding * (ground.high - ground.low).norm();
      region.outline = outline_of(part.outer(), one_place);
      region.holes.clear();
      for (const Ring& hole : part.inners()) region.holes.push_back(outline_of(hole, one_place));
      region.material = material;
    }
  };
  for (const GroundRegion& whole : scene.regions) {
    cut(whole, dry, whole.material);
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      const mesh::Point &from = table[i], &to = table[i + 1];
      GroundMaterial saturated = scene.materials[whole.material];
      problem::Soil& soil = saturated.soil;
      soil.unit_weight = saturated.saturated_unit_weight.value_or(soil.unit_weight);
      const double slope = (to.y() - from.y()) / (to.x() - from.x());
      soil.seepage = scene.water.unit_weight * mesh::Point(-slope, 1.0);
      scene.materials.push_back(std::move(saturated));
      cut(whole, {from, {from.x(), bottom}, {to.x(), bottom}, to}, scene.materials.size() - 1);
    }
  }
  scene.regions = std::move(regions);
}

}  // namespace limit::ground

#include "limit/ground/ground_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <set>
#include <utility>

#include "shape/water.hpp"

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

// No sliver, as is left where a region's outline and the table are one line.
bool is_something(const Polygon& part, const Extent& ground) {
  constexpr double nothing = 1e-9;
  return boost::geometry::area(part) > nothing * (ground.high - ground.low).squaredNorm();
}

// The part of a region that is within a polygon becomes regions of another material.
class Cutter {
 public:
  explicit Cutter(const Extent& ground) : ground_(ground) {}

  /// @param material_at  index of the material around a place of the part
  template <class MaterialAt>
  void cut(const GroundRegion& whole, const std::vector<mesh::Point>& with,
           MaterialAt&& material_at) {
    std::vector<Polygon> parts;
    boost::geometry::intersection(polygon_of(whole.outline, whole.holes), polygon_of(with), parts);
    for (const Polygon& part : parts) {
      if (!is_something(part, ground_)) continue;
      Place centre(0.0, 0.0);
      boost::geometry::centroid(part, centre);
      GroundRegion& region = regions.emplace_back(whole);
      constexpr double rounding = 1e-9;
      const double one_place = rounding * (ground_.high - ground_.low).norm();
      region.outline = outline_of(part.outer(), one_place);
      region.holes.clear();
      for (const Ring& hole : part.inners()) region.holes.push_back(outline_of(hole, one_place));
      region.material = material_at(mesh::Point(centre.x(), centre.y()));
    }
  }

  std::vector<GroundRegion> regions;

 private:
  const Extent& ground_;
};

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
  Cutter cutter(ground);
  for (const GroundRegion& whole : scene.regions) {
    cutter.cut(whole, dry, [&](const mesh::Point&) { return whole.material; });
    for (std::size_t i = 0; i + 1 < table.size(); ++i) {
      const mesh::Point &from = table[i], &to = table[i + 1];
      GroundMaterial saturated = scene.materials[whole.material];
      problem::Soil& soil = saturated.soil;
      soil.unit_weight = saturated.saturated_unit_weight.value_or(soil.unit_weight);
      const double slope = (to.y() - from.y()) / (to.x() - from.x());
      soil.seepage = scene.water.unit_weight * mesh::Point(-slope, 1.0);
      scene.materials.push_back(std::move(saturated));
      cutter.cut(whole, {from, {from.x(), bottom}, {to.x(), bottom}, to},
                 [&](const mesh::Point&) { return scene.materials.size() - 1; });
    }
  }
  scene.regions = std::move(cutter.regions);
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
  Cutter cutter(ground);
  for (const GroundRegion& whole : scene.regions) {
    for (std::size_t i = 0; i + 1 < uprights.size(); ++i) {
      const double left = uprights[i], right = uprights[i + 1];
      cutter.cut(whole, {{left, bottom}, {right, bottom}, {right, top}, {left, top}},
                 [&](const mesh::Point& centre) {
                   GroundMaterial loaded = scene.materials[whole.material];
                   loaded.soil.seepage =
                       -*scene.water.r_u * shape::overburden(heavy, centre).gradient;
                   scene.materials.push_back(std::move(loaded));
                   return scene.materials.size() - 1;
                 });
    }
  }
  scene.regions = std::move(cutter.regions);
}

}  // namespace

void wet(GroundScene& scene, tables::Diagnosis& diagnosis) {
  if (!scene.water.is_there()) return;
  const Extent ground = extent_of(scene);
  if (scene.water.r_u && !scene.water.table.empty()) {
    diagnosis.error("water.r_u", fmt::format("found {:g}, and a table", *scene.water.r_u),
                    "the pressure is what one of them says: leave the other out");
  } else if (scene.water.r_u && scene.load.sought == Sought::gravity) {
    diagnosis.error("water.r_u", fmt::format("found {:g}, with gravity sought", *scene.water.r_u),
                    "the water's force stays while weights grow: give a table");
  } else if (scene.water.r_u) {
    wet_by_overburden(scene, ground, diagnosis);
  } else if (shape::is_water_table(scene.water.table, ground.low, ground.high, diagnosis)) {
    wet_below_table(scene, ground);
  }
}

}  // namespace limit::ground

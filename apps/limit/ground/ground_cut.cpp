#include "limit/ground/ground_cut.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "limit/ground/ground_soils.hpp"

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

// No sliver, as is left where a region's outline and the table are one line.
bool is_something(const Polygon& part, const Extent& ground) {
  constexpr double nothing = 1e-9;
  return boost::geometry::area(part) > nothing * (ground.high - ground.low).squaredNorm();
}

bool is_table_along(const tables::VaryingNumber& weight, std::size_t axis) {
  return weight.samples && weight.samples->kind == tables::Samples::Kind::table &&
         weight.samples->axis == axis;
}

// The coordinate along one axis of all lines of the tables of a material's weights.
std::vector<double> lines_of(const GroundMaterial& material, std::size_t axis) {
  std::vector<double> lines;
  const auto add = [&](const tables::VaryingNumber& weight) {
    if (!is_table_along(weight, axis)) return;
    const auto& told = weight.samples->coordinates;
    lines.insert(lines.end(), told.begin(), told.end());
  };
  add(material.unit_weight);
  if (material.saturated_unit_weight) add(*material.saturated_unit_weight);
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

// The line through a table's values at both ends of a strip, in which it has no others.
tables::VaryingNumber between(const tables::VaryingNumber& table, std::size_t axis, double low,
                              double high) {
  if (!is_table_along(table, axis)) return table;
  std::array<double, 2> first{}, second{}, gradient{};
  first[axis] = low;
  second[axis] = high;
  const double value = table.at_place(first);
  gradient[axis] = (table.at_place(second) - value) / (high - low);
  return {value, first, gradient};
}

void cut_along(GroundScene& scene, std::size_t axis) {
  const Extent ground = extent_of(scene);
  const mesh::Point margin = ground.high - ground.low;
  std::vector<GroundRegion> regions;
  for (GroundRegion& whole : scene.regions) {
    const std::vector<double> lines = lines_of(scene.materials[whole.material], axis);
    if (lines.empty()) regions.push_back(whole);
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
      mesh::Point low = ground.low - margin, high = ground.high + margin;
      low[static_cast<Eigen::Index>(axis)] = lines[i];
      high[static_cast<Eigen::Index>(axis)] = lines[i + 1];
      const std::vector<mesh::Point> strip{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
      for (GroundPart& part : parts_within(whole, strip, ground)) {
        GroundMaterial material = scene.materials[whole.material];
        material.unit_weight = between(material.unit_weight, axis, lines[i], lines[i + 1]);
        if (material.saturated_unit_weight) {
          *material.saturated_unit_weight =
              between(*material.saturated_unit_weight, axis, lines[i], lines[i + 1]);
        }
        recentre(part.centre, material.soil);
        if (!material.unit_weight.samples) take_weight(material.unit_weight, material.soil);
        scene.materials.push_back(std::move(material));
        part.region.material = scene.materials.size() - 1;
        regions.push_back(std::move(part.region));
      }
    }
  }
  scene.regions = std::move(regions);
}

}  // namespace

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

namespace {

std::vector<GroundPart> parts_of(const GroundRegion& region, const std::vector<Polygon>& pieces,
                                 const Extent& ground) {
  std::vector<GroundPart> parts;
  for (const Polygon& piece : pieces) {
    if (!is_something(piece, ground)) continue;
    Place centre(0.0, 0.0);
    boost::geometry::centroid(piece, centre);
    GroundPart& part = parts.emplace_back(GroundPart{region, {centre.x(), centre.y()}});
    constexpr double rounding = 1e-9;
    const double one_place = rounding * (ground.high - ground.low).norm();
    part.region.outline = outline_of(piece.outer(), one_place);
    part.region.holes.clear();
    for (const Ring& hole : piece.inners()) {
      part.region.holes.push_back(outline_of(hole, one_place));
    }
  }
  return parts;
}

}  // namespace

std::vector<GroundPart> parts_within(const GroundRegion& region,
                                     const std::vector<mesh::Point>& polygon,
                                     const Extent& ground) {
  std::vector<Polygon> pieces;
  boost::geometry::intersection(polygon_of(region.outline, region.holes), polygon_of(polygon),
                                pieces);
  return parts_of(region, pieces, ground);
}

std::vector<GroundPart> parts_beyond(const GroundRegion& region,
                                     const std::vector<mesh::Point>& polygon,
                                     const Extent& ground) {
  std::vector<Polygon> pieces;
  boost::geometry::difference(polygon_of(region.outline, region.holes), polygon_of(polygon),
                              pieces);
  return parts_of(region, pieces, ground);
}

void cut_along_tables(GroundScene& scene) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) cut_along(scene, axis);
}

namespace {

bool has_pieces(const tables::VaryingNumber& weight) {
  return weight.samples && weight.samples->jumps();
}

// The part of a convex polygon that is no nearer to another place than to one.
std::vector<mesh::Point> part_nearer(const std::vector<mesh::Point>& polygon,
                                     const mesh::Point& one, const mesh::Point& other) {
  const mesh::Point way = other - one, middle = (one + other) / 2.0;
  std::vector<mesh::Point> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const mesh::Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double here = way.dot(middle - a), there = way.dot(middle - b);
    if (here >= 0.0) part.push_back(a);
    if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
      part.push_back(a + here / (here - there) * (b - a));
    }
  }
  return part;
}

// Of each point the polygon, within a box, of what is nearer to it than to all others.
std::vector<std::vector<mesh::Point>> nearest_places(const tables::Samples& points,
                                                     const mesh::Point& low,
                                                     const mesh::Point& high) {
  const auto place = [&](std::size_t i) {
    const auto at = points.place(i);
    return mesh::Point(at[0], at[1]);
  };
  std::vector<std::size_t> others(points.values.size());
  std::vector<std::vector<mesh::Point>> cells;
  for (std::size_t i = 0; i < points.values.size(); ++i) {
    const mesh::Point here = place(i);
    std::iota(others.begin(), others.end(), std::size_t{0});
    const auto distance = [&](std::size_t j) { return (place(j) - here).squaredNorm(); };
    std::ranges::sort(others, {}, distance);
    std::vector<mesh::Point> cell{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    for (const std::size_t j : others) {
      if (j == i || cell.empty()) continue;
      double reach = 0.0;
      for (const mesh::Point& corner : cell) reach = std::max(reach, (corner - here).norm());
      if (std::sqrt(distance(j)) > 2.0 * reach) break;
      cell = part_nearer(cell, here, place(j));
    }
    cells.push_back(std::move(cell));
  }
  return cells;
}

// Of each cell of a raster the rectangle, within a box; nothing where there is none.
std::vector<std::vector<mesh::Point>> rectangles(const tables::Samples& raster,
                                                 const mesh::Point& low, const mesh::Point& high) {
  std::vector<std::vector<mesh::Point>> cells(raster.values.size());
  for (std::size_t i = 0; i < raster.values.size(); ++i) {
    const auto x = raster.ends_of_cell(0, i % raster.columns);
    const auto y = raster.ends_of_cell(1, i / raster.columns);
    const mesh::Point from = mesh::Point(x[0], y[0]).cwiseMax(low);
    const mesh::Point to = mesh::Point(x[1], y[1]).cwiseMin(high);
    if (from.x() >= to.x() || from.y() >= to.y()) continue;
    cells[i] = {from, {to.x(), from.y()}, to, {from.x(), to.y()}};
  }
  return cells;
}

// Cuts the regions whose weight, or that which `of` finds, is of samples that jump.
template <class Of>
void cut_between_samples(GroundScene& scene, Of&& of) {
  const Extent ground = extent_of(scene);
  const mesh::Point margin = ground.high - ground.low;
  std::vector<GroundRegion> regions;
  for (GroundRegion& whole : scene.regions) {
    const tables::VaryingNumber* told = of(scene.materials[whole.material]);
    if (told == nullptr || !has_pieces(*told)) {
      regions.push_back(whole);
      continue;
    }
    const tables::Samples samples = *told->samples;
    const mesh::Point low = ground.low - margin, high = ground.high + margin;
    const auto cells = samples.kind == tables::Samples::Kind::raster
                           ? rectangles(samples, low, high)
                           : nearest_places(samples, low, high);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i].empty()) continue;
      for (GroundPart& part : parts_within(whole, cells[i], ground)) {
        GroundMaterial material = scene.materials[whole.material];
        *of(material) = tables::VaryingNumber(samples.values[i]);
        recentre(part.centre, material.soil);
        if (!material.unit_weight.samples) take_weight(material.unit_weight, material.soil);
        scene.materials.push_back(std::move(material));
        part.region.material = scene.materials.size() - 1;
        regions.push_back(std::move(part.region));
      }
    }
  }
  scene.regions = std::move(regions);
}

}  // namespace

void cut_between_samples(GroundScene& scene) {
  cut_between_samples(scene, [](auto& material) { return &material.unit_weight; });
  cut_between_samples(scene, [](auto& material) {
    return material.saturated_unit_weight ? &*material.saturated_unit_weight : nullptr;
  });
}

}  // namespace limit::ground

#include "scene/ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "scene/box.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

std::vector<shape::Point> points_of(const std::vector<PlanePoint>& places) {
  std::vector<shape::Point> points;
  for (const PlanePoint& place : places) points.emplace_back(place.x(), place.y());
  return points;
}

}  // namespace

shape::Outline join_regions(const Scene& scene, tables::Diagnosis& diagnosis) {
  std::vector<shape::NamedRegion> regions;
  for (std::size_t r = 0; r < scene.region.size(); ++r) {
    const Region& region = scene.region[r];
    shape::NamedRegion& named = regions.emplace_back();
    named.name = region.name.empty() ? fmt::format("region {}", r) : region.name;
    named.ring = points_of(region.outline);
    for (const auto& hole : region.holes) named.holes.push_back(points_of(hole));
  }
  std::vector<shape::NamedLine> sides;
  for (const OutlineSide& side : scene.side) sides.push_back({side.name, points_of(side.along)});
  return shape::join_regions(regions, sides, diagnosis);
}

shape::Outline outline_of(const Scene& scene) {
  tables::Diagnosis ignored("");
  return join_regions(scene, ignored);
}

std::optional<std::size_t> footing_of(const Scene& scene) {
  const auto found = std::ranges::find(scene.side, OutlineKind::footing, &OutlineSide::kind);
  if (found == scene.side.end()) return std::nullopt;
  return static_cast<std::size_t>(found - scene.side.begin());
}

bool holds(OutlineKind kind) {
  return kind == OutlineKind::fixed || kind == OutlineKind::roller || kind == OutlineKind::symmetry;
}

std::size_t material_of(const Scene& scene, std::size_t region) {
  const auto has_its_name = [&](const Material& material) {
    return material.name == scene.region[region].material;
  };
  return static_cast<std::size_t>(std::ranges::find_if(scene.material, has_its_name) -
                                  scene.material.begin());
}

namespace {

// 0 within it.
double distance_to(const std::vector<shape::Ring>& rings, const shape::Point& place) {
  if (shape::is_inside(rings, place)) return 0.0;
  double distance = std::numeric_limits<double>::infinity();
  for (const shape::Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size() && distance > 0.0; ++k) {
      distance = std::min(distance, shape::distance(place, ring[k], ring[(k + 1) % ring.size()]));
    }
  }
  return distance;
}

}  // namespace

std::size_t material_of_region_at(const Scene& scene, const shape::Outline& outline,
                                  std::span<const double> place) {
  const shape::Point here(place[0], place[1]);
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t r = 0; r < outline.regions.size(); ++r) {
    const double distance = distance_to(outline.rings(r), here);
    if (distance >= least) continue;
    least = distance;
    nearest = r;
  }
  return material_of(scene, nearest);
}

std::vector<std::size_t> materials_of_regions_at(const Scene& scene, const shape::Outline& outline,
                                                 std::span<const double> place, double slack) {
  std::vector<std::size_t> materials;
  const shape::Point here(place[0], place[1]);
  for (std::size_t r = 0; r < outline.regions.size(); ++r) {
    if (distance_to(outline.rings(r), here) <= slack) materials.push_back(material_of(scene, r));
  }
  return materials;
}

std::vector<shape::Point> singular_corners(const Scene& scene) {
  std::vector<shape::Point> corners;
  if (scene.region.empty()) return corners;
  const shape::Outline outline = outline_of(scene);
  // Less is a step of a polygon that stands for a curve.
  constexpr double turn = 0.17;  // sine of 10 degrees
  const auto way = [&](const shape::OutlineSegment& segment) -> shape::Point {
    return (outline.at(segment.second) - outline.at(segment.first)).normalized();
  };
  for (const shape::OutlineSegment& before : outline.segments) {
    for (const shape::OutlineSegment& after : outline.segments) {
      if (before.right >= 0 || after.right >= 0 || before.second != after.first) continue;
      const shape::Point in = way(before), out = way(after);
      const double sine = shape::cross(in, out);
      const OutlineSide& one = scene.side[static_cast<std::size_t>(before.side)];
      const OutlineSide& other = scene.side[static_cast<std::size_t>(after.side)];
      const bool both_free = !holds(one.kind) && !holds(other.kind);
      const bool loads_differ = one.pressure != other.pressure || one.shear != other.shear ||
                                one.live_pressure != other.live_pressure ||
                                one.live_shear != other.live_shear;
      if (sine < -turn || (both_free && loads_differ)) corners.push_back(outline.at(after.first));
    }
  }
  return corners;
}

bool is_held(const Scene& scene, Side face) {
  return is_mirror(scene, face) || std::ranges::any_of(scene.support, [&](const Support& support) {
           return support.side == face;
         });
}

}  // namespace scene

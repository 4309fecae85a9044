#include "scene/grading.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"

namespace scene {

namespace {

double shortest_extent(const Geometry& geometry) {
  double shortest = geometry.max[0] - geometry.min[0];
  for (std::size_t i = 1; i < geometry.min.size(); ++i) {
    shortest = std::min(shortest, geometry.max[i] - geometry.min[i]);
  }
  return shortest;
}

/// A part of a side, at `position` across it, as a box without thickness.
FinePlace part_of_side(const Scene& scene, Side side, double position, const Point& range_min,
                       const Point& range_max) {
  FinePlace place{scene.geometry.min, scene.geometry.max, scene.geometry.spacing, 0.0};
  const auto normal = static_cast<std::size_t>(axis_of(side));
  place.min[normal] = place.max[normal] = position;
  for (std::size_t i = 0, k = 0; i < place.min.size() && !range_min.empty(); ++i) {
    if (i == normal) continue;
    place.min[i] = range_min[k];
    place.max[i] = range_max[k++];
  }
  return place;
}

/// The edges of a part of a side that do not lie on other sides.
void add_ends(const Scene& scene, Side side, double position, const Point& range_min,
              const Point& range_max, double radius, std::vector<FinePlace>& places) {
  if (range_min.empty()) return;
  const double slack = same_place(scene.geometry);
  FinePlace part = part_of_side(scene, side, position, range_min, range_max);
  part.radius = radius;
  for (std::size_t i = 0; i < part.min.size(); ++i) {
    if (static_cast<int>(i) == axis_of(side)) continue;
    for (const double end : {part.min[i], part.max[i]}) {
      if (end < scene.geometry.min[i] + slack || end > scene.geometry.max[i] - slack) continue;
      FinePlace edge = part;
      edge.min[i] = edge.max[i] = end;
      places.push_back(edge);
    }
  }
}

double distance(const FinePlace& place, std::span<const double> min, std::span<const double> max) {
  double square = 0.0;
  for (std::size_t i = 0; i < min.size(); ++i) {
    const double apart = std::max({0.0, min[i] - place.max[i], place.min[i] - max[i]});
    square += apart * apart;
  }
  return std::sqrt(square);
}

/// The widest spacing [m] at which three cells fit across a region that a box of space is in, as a
/// body of its own needs; without limit outside the region.
double fitting_spacing(const Material& material, const Geometry& geometry, double slack,
                       std::span<const double> min, std::span<const double> max) {
  constexpr double fewest = 3.0;
  constexpr double no_limit = std::numeric_limits<double>::infinity();
  double widest = no_limit;
  for (std::size_t i = 0; i < material.region_min.size(); ++i) {
    const double lower = std::max(material.region_min[i], geometry.min[i]);
    const double upper = std::min(material.region_max[i], geometry.max[i]);
    if (upper <= min[i] + slack || lower >= max[i] - slack) return no_limit;
    widest = std::min(widest, (upper - lower) / fewest);
  }
  return std::max(geometry.spacing, widest);
}

/// Whether the faces of a region cut a box of space.
bool cuts(const Point& region_min, const Point& region_max, double slack,
          std::span<const double> min, std::span<const double> max) {
  if (region_min.empty()) return false;
  bool inside = true;
  for (std::size_t i = 0; i < min.size(); ++i) {
    if (region_max[i] <= min[i] + slack || region_min[i] >= max[i] - slack) return false;
    inside = inside && region_min[i] <= min[i] + slack && region_max[i] >= max[i] - slack;
  }
  return !inside;
}

}  // namespace

std::vector<FinePlace> fine_places(const Scene& scene) {
  std::vector<FinePlace> places;
  // Of all stages, whose particles are the same.
  for (const Drive* drive : all_drives(scene)) {
    if (drive->kind != DriveKind::displacement) continue;
    const bool moves = scene.approximation.kinematics == KinematicsKind::finite_strain;
    add_ends(scene, drive->side, plate_position(scene.geometry, *drive), drive->range_min,
             drive->range_max, moves ? drive->target : 0.0, places);
  }
  for (const Traction& traction : scene.traction) {
    add_ends(scene, traction.side, side_position(scene.geometry, traction.side), traction.range_min,
             traction.range_max, 0.0, places);
  }
  const auto corners = is_solid(scene) ? std::vector<shape::Point>() : singular_corners(scene);
  for (const shape::Point& corner : corners) {
    FinePlace place{{corner.x(), corner.y()}, {corner.x(), corner.y()}, scene.geometry.spacing};
    if (is_extruded(scene)) {  // an edge from end to end
      place.min.push_back(scene.geometry.min[2]);
      place.max.push_back(scene.geometry.max[2]);
    }
    places.push_back(place);
  }
  for (const Refine& refine : scene.refine) {
    FinePlace place;
    if (refine.side) {
      place = part_of_side(scene, *refine.side, side_position(scene.geometry, *refine.side),
                           refine.range_min, refine.range_max);
    } else if (!refine.at.empty()) {
      place.min = place.max = refine.at;
    } else {
      place.min = refine.region_min;
      place.max = refine.region_max;
    }
    place.spacing = refine.spacing.value_or(scene.geometry.spacing);
    place.radius = refine.radius;
    places.push_back(place);
  }
  return places;
}

double resolve_grading_length(const Scene& scene) {
  if (scene.grading.length) return *scene.grading.length;
  for (const Drive* drive : all_drives(scene)) {
    if (drive->reference_length) return *drive->reference_length;
  }
  return shortest_extent(scene.geometry);
}

// Collapse is decided next to the fine places, whatever the spacing is elsewhere; what an elastic
// body gives way by is a sum over all of it. With spacings of sqrt(dx r) halving dx halves the
// error and doubles the particles. Measured in the plane alone.
double resolve_growth(const Scene& scene) {
  if (scene.grading.growth) return *scene.grading.growth;
  constexpr double most = 0.125;
  constexpr double exponent_of_rule = 0.5;
  const bool has_rule = scene.geometry.dimension == 2 && scene.grading.exponent == exponent_of_rule;
  if (!has_rule || std::ranges::any_of(scene.material, yields)) return most;
  return std::min(most, std::sqrt(scene.geometry.spacing / resolve_grading_length(scene)));
}

double resolve_coarsest(const Scene& scene) {
  constexpr double across = 8.0;
  return scene.grading.coarsest.value_or(
      std::max(scene.geometry.spacing, shortest_extent(scene.geometry) / across));
}

double wanted_spacing(const Scene& scene, const std::vector<FinePlace>& places,
                      std::span<const double> min, std::span<const double> max, double to_hollows) {
  const double slack = same_place(scene.geometry);
  for (const Material& material : scene.material) {
    if (cuts(material.region_min, material.region_max, slack, min, max)) {
      return scene.geometry.spacing;
    }
  }
  for (const Support& support : scene.support) {
    if (cuts(support.region_min, support.region_max, slack, min, max)) {
      return scene.geometry.spacing;
    }
  }
  const double length = resolve_grading_length(scene), growth = resolve_growth(scene);
  double wanted = resolve_coarsest(scene);
  for (const Material& material : scene.material) {
    wanted = std::min(wanted, fitting_spacing(material, scene.geometry, slack, min, max));
  }
  const auto grown = [&](double r) {
    return growth * length * std::pow(r / length, scene.grading.exponent);
  };
  if (std::isfinite(to_hollows)) {
    wanted = std::min(wanted, std::max(scene.geometry.spacing, grown(to_hollows)));
  }
  for (const FinePlace& place : places) {
    const double r = distance(place, min, max);
    wanted = std::min(wanted, std::max(place.spacing, r < place.radius ? 0.0 : grown(r)));
  }
  return wanted;
}

}  // namespace scene

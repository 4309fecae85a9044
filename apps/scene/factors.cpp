#include "scene/factors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/contacts.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace scene {

namespace {

double cells_of(const Geometry& geometry) {
  double cells = 1.0;
  for (std::size_t i = 0; i < std::min(geometry.min.size(), geometry.max.size()); ++i) {
    cells *= (geometry.max[i] - geometry.min[i]) / geometry.spacing;
  }
  return cells;
}

// Of a ring, either way around, corners that jut out or in.
bool has_sharp_corner(const std::vector<PlanePoint>& ring) {
  constexpr double sharp = 40.0 * std::numbers::pi / 180.0;
  const std::size_t size = ring.size();
  for (std::size_t k = 0; k < size; ++k) {
    const PlanePoint &at = ring[k], &before = ring[(k + size - 1) % size],
                     &after = ring[(k + 1) % size];
    const double ax = before.x() - at.x(), ay = before.y() - at.y();
    const double bx = after.x() - at.x(), by = after.y() - at.y();
    const double angle = std::atan2(std::abs(ax * by - ay * bx), ax * bx + ay * by);
    if (angle > 0.0 && angle < sharp) return true;
  }
  return false;
}

bool is_held_aslant(const OutlineSide& side) {
  if (!holds(side.kind)) return false;
  for (std::size_t k = 0; k + 1 < side.along.size(); ++k) {
    const PlanePoint &a = side.along[k], &b = side.along[k + 1];
    if (a.x() != b.x() && a.y() != b.y()) return true;
  }
  return false;
}

}  // namespace

bool wants_factors(const Scene& scene, double poissons_ratio, bool is_elastic) {
  if (scene.geometry.dimension != 2) return false;
  // Sixty evaluations and more at 0.49, where 0.3 takes twenty.
  if (poissons_ratio > 0.49) return true;
  if (!is_elastic) return false;
  const double cells = cells_of(scene.geometry);
  // Where blocks and grid may not get there at all, and where they take hundreds of evaluations,
  // which cost less than the factors of more particles do.
  constexpr double most = 20'000.0, most_for_speed = 5'000.0;
  const auto is_sharp = [](const Region& region) { return has_sharp_corner(region.outline); };
  const bool is_cut = !scene.region.empty() || !scene.cutout.empty();
  if (std::ranges::any_of(scene.region, is_sharp) || (is_cut && has_contact(scene))) {
    return cells <= most;
  }
  return (poissons_ratio > 0.45 || std::ranges::any_of(scene.side, is_held_aslant)) &&
         cells <= most_for_speed;
}

}  // namespace scene

#include "limit/ground/ground_skins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace limit::ground {

namespace {

// Of a straight piece of the outline from the horizontal, 0 .. 90 degrees.
double inclination_of(const GroundOutline& outline, const GroundSegment& segment) {
  const mesh::Point way = outline.at(segment.second) - outline.at(segment.first);
  return std::atan2(std::abs(way.y()), std::abs(way.x()));
}

bool presses(const GroundSide& side) {
  return side.kind == SideKind::loaded && (side.pressure != 0.0 || side.shear != 0.0);
}

}  // namespace

void say_skins(const GroundScene& scene, const GroundOutline& outline,
               const problem::Problem& soils, problem::Case& result) {
  double steepest = 0.0, gentlest = INFINITY;
  std::string weakest;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    if ((side.kind != SideKind::free && side.kind != SideKind::loaded) || presses(side)) continue;
    const std::size_t m = scene.regions[static_cast<std::size_t>(segment.left)].material;
    const problem::Soil& soil = soils.soils[m];
    const double face = inclination_of(outline, segment);
    constexpr double level = 1e-6;
    if (face > level) {
      steepest = std::max(steepest, face);
      gentlest = std::min(gentlest, face);
    }
    // The ground is to the left: what runs towards +x hangs over.
    if (outline.at(segment.second).x() > outline.at(segment.first).x()) gentlest = 0.0;
    if (!soil.is_loose()) continue;
    // The weight, aslant in an earthquake, along the skin and across it.
    const mesh::Point way = (outline.at(segment.second) - outline.at(segment.first)).normalized();
    const mesh::Point force = soils.live_force(soil, soil.centre);
    const double along = std::abs(way.dot(force));
    const double presses_on = way.x() * force.y() - way.y() * force.x();
    // What water lifts off the face has no strength at all.
    const double across = scene.water.is_there() ? std::max(0.0, presses_on) : std::abs(presses_on);
    if (along <= level * across) continue;
    const double slides = std::tan(soil.friction_angle) * across / along;
    if (slides >= result.known_upper.value_or(INFINITY)) continue;
    result.known_upper = slides;
    weakest =
        fmt::format("{} without cohesion at the side \"{}\"", scene.materials[m].name, side.name);
  }
  if (!result.known_upper) return;
  const bool is_shaken = soils.live_pull.x() != 0.0;
  // Whatever else there is, no strength is little enough to be divided any further.
  constexpr double next_to_nothing = 1e-9;
  if (*result.known_upper <= next_to_nothing) {
    result.known_upper = result.known_lower = 0.0;
    result.notes.push_back(fmt::format(
        "the skin of {} bears nothing: nothing presses it on the ground behind it", weakest));
    return;
  }
  result.notes.push_back(fmt::format(
      "a skin of {} slides parallel to it at tan(friction angle) / tan({}) = {:.7g}", weakest,
      is_shaken ? "angle of the shaken weight to its normal" : "inclination", *result.known_upper));
  const bool is_dry_sand =
      !is_shaken && !scene.water.is_there() && gentlest == steepest && steepest > 0.0 &&
      std::none_of(
          scene.sides.begin(), scene.sides.end(),
          [](const GroundSide& side) { return presses(side) || side.kind == SideKind::footing; }) &&
      std::all_of(soils.soils.begin(), soils.soils.end(), [&](const problem::Soil& soil) {
        return soil.cohesion == 0.0 && soil.friction_angle == soils.soils[0].friction_angle;
      });
  if (!is_dry_sand) return;
  result.known_lower = result.known_upper;
  result.notes.emplace_back(
      "which is exact for a face of one inclination in soil without cohesion throughout");
}

}  // namespace limit::ground

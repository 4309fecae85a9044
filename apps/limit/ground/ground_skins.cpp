#include "limit/ground/ground_skins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "limit/ground/ground_pressure.hpp"

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

bool is_bare(const GroundSide& side) {
  return side.kind == SideKind::free || (side.kind == SideKind::loaded && !presses(side) &&
                                         side.live_pressure == 0.0 && side.live_shear == 0.0);
}

// A part of a straight piece of the outline, the force [N/m3] of the water in skins of it, which is
// the same along it, and where the weight of such skins is least and most: it is linear.
struct Skin {
  mesh::Point water{0.0, 0.0};
  std::vector<mesh::Point> places;
};

// Those of a straight piece of the outline: one, or of each part of it along which a pressure that
// is told is linear.
std::vector<Skin> skins_of(const GroundScene& scene, const problem::Soil& soil,
                           const mesh::Point& first, const mesh::Point& second) {
  const mesh::Point way = second - first;
  const auto skin = [&](const mesh::Point& water, double from, double to) {
    if (!soil.has_uneven_weight()) return Skin{water, {first + (from + to) / 2.0 * way}};
    return Skin{water, {first + from * way, first + to * way}};
  };
  const auto& told = scene.water.in_triangles;
  if (!told) return {skin(soil.seepage + soil.live_seepage, 0.0, 1.0)};
  constexpr double thin = 1e-6, rounding = 1e-3;
  const mesh::Point inwards = thin * mesh::Point(-way.y(), way.x());
  std::vector<Skin> skins;
  for (const auto& piece :
       told->field().within({first, second, second + inwards, first + inwards})) {
    if (piece.area <= rounding * thin * way.squaredNorm()) continue;
    double from = 1.0, to = 0.0;
    for (const mesh::Point& corner : piece.ring) {
      const double share = std::clamp((corner - first).dot(way) / way.squaredNorm(), 0.0, 1.0);
      from = std::min(from, share);
      to = std::max(to, share);
    }
    skins.push_back(skin(-piece.gradient, from, to));
  }
  return skins;
}

const char* key_of_water(const GroundScene& scene) {
  if (scene.water.pore_pressure) return "water.pore_pressure";
  return scene.water.r_u ? "water.r_u" : "water.table";
}

// The skin of a side of the scene as a message names it.
std::string skin_words(const GroundScene& scene, std::size_t material, const GroundSide& side,
                       const mesh::Point& place) {
  return fmt::format("{}, which has no cohesion, off the side \"{}\" at ({:.6g}, {:.6g})",
                     scene.materials[material].name, side.name, place.x(), place.y());
}

// Where what acts on a side ends beside a bare one of the same ground without cohesion.
struct EndBesideBareSand {
  int loaded = 0, bare = 0;  // sides
  std::size_t material = 0;
  mesh::Point place{0.0, 0.0};
};

template <class Acts>
std::optional<EndBesideBareSand> end_beside_bare_sand(const GroundScene& scene,
                                                      const GroundOutline& outline,
                                                      const problem::Problem& problem,
                                                      const Acts& acts) {
  const auto side_of = [&](const GroundSegment& segment) -> const GroundSide& {
    return scene.sides[static_cast<std::size_t>(segment.side)];
  };
  for (const GroundSegment& loaded : outline.segments) {
    if (loaded.right >= 0 || !acts(side_of(loaded))) continue;
    const std::size_t m = scene.regions[static_cast<std::size_t>(loaded.left)].material;
    if (!problem.soils[m].is_loose()) continue;
    for (const GroundSegment& bare : outline.segments) {
      if (bare.right >= 0 || bare.left != loaded.left || !is_bare(side_of(bare))) continue;
      const bool ends = bare.first == loaded.second, begins = bare.second == loaded.first;
      if (!ends && !begins) continue;
      return EndBesideBareSand{loaded.side, bare.side, m,
                               outline.at(ends ? loaded.second : loaded.first)};
    }
  }
  return std::nullopt;
}

}  // namespace

void check_bare_faces(const GroundScene& scene, const GroundOutline& outline,
                      const problem::Problem& problem, tables::Diagnosis& diagnosis) {
  const bool seeks_strength = scene.load.sought == Sought::strength;
  // @return  whether it bears what acts on it at a place
  const auto check = [&](const GroundSegment& segment, const mesh::Point& water,
                         const mesh::Point& place) {
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    const std::size_t m = scene.regions[static_cast<std::size_t>(segment.left)].material;
    const problem::Soil& soil = problem.soils[m];
    const mesh::Point way = (outline.at(segment.second) - outline.at(segment.first)).normalized();
    const mesh::Point outwards(way.y(), -way.x());
    const mesh::Point weight =
        (soil.unit_weight_at(place) + (seeks_strength ? soil.live_unit_weight_at(place) : 0.0)) *
        problem.pull;
    const double lift = outwards.dot(water), press = -outwards.dot(weight + water);
    const double along = std::abs(way.dot(weight + water));
    const double rounding = 1e-9 * (weight.norm() + water.norm());
    const std::string skin = skin_words(scene, m, side, place);
    if (lift > 0.0 && press < -rounding) {
      diagnosis.error(key_of_water(scene),
                      fmt::format("water lifts {}, with {:.6g} {} and no more than {:.6g} on it",
                                  skin, lift, scene.units.unit_weight(), press + lift),
                      "such ground boils: allowed are less water, a cohesion, or a pressure on "
                      "the side, as of a filter");
      return false;
    }
    // How far a strength may be divided is what is sought then.
    if (seeks_strength || along <= std::tan(soil.friction_angle) * press + rounding) return true;
    diagnosis.error(fmt::format("side.{}.kind", segment.side),
                    fmt::format("what is given lets a skin slide of {}", skin),
                    "bare sand does not stand steeper than it has friction: allowed are a "
                    "gentler face, a cohesion, or a side that is held or loaded");
    return false;
  };
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    const std::size_t m = scene.regions[static_cast<std::size_t>(segment.left)].material;
    const problem::Soil& soil = problem.soils[m];
    if (!is_bare(side) || !soil.is_loose()) continue;
    for (const Skin& skin :
         skins_of(scene, soil, outline.at(segment.first), outline.at(segment.second))) {
      for (const mesh::Point& place : skin.places) {
        if (!check(segment, skin.water, place)) return;
      }
    }
  }
}

void check_ends_of_pressure(const GroundScene& scene, const GroundOutline& outline,
                            const problem::Problem& problem, tables::Diagnosis& diagnosis) {
  const auto end = end_beside_bare_sand(scene, outline, problem, presses);
  if (!end) return;
  const GroundSide& loaded = scene.sides[static_cast<std::size_t>(end->loaded)];
  const bool is_pressure = loaded.pressure != 0.0;
  diagnosis.error(
      fmt::format("side.{}.{}", end->loaded, is_pressure ? "pressure" : "shear"),
      fmt::format("found {:g}, which ends at ({:.6g}, {:.6g}) beside the bare side \"{}\" of {}, "
                  "which has no cohesion",
                  is_pressure ? loaded.pressure : loaded.shear, end->place.x(), end->place.y(),
                  scene.sides[static_cast<std::size_t>(end->bare)].name,
                  scene.materials[end->material].name),
      "where nothing presses on sand it bears nothing, and gives way under what is given: "
      "allowed are a cohesion, as of a thousandth of the pressure, or a pressure beside, too");
}

void say_ends_of_live_pressure(const GroundScene& scene, const GroundOutline& outline,
                               const problem::Problem& problem, problem::Case& result) {
  if (scene.load.sought != Sought::traction) return;
  const auto end = end_beside_bare_sand(scene, outline, problem, [](const GroundSide& side) {
    return side.kind == SideKind::loaded && (side.live_pressure != 0.0 || side.live_shear != 0.0);
  });
  if (!end) return;
  result.known_upper = 0.0;
  result.notes.push_back(fmt::format(
      "what grows on the side \"{}\" ends at ({:.6g}, {:.6g}) beside the bare side \"{}\" of {}, "
      "which has no cohesion: where nothing presses on sand it bears nothing, so that no multiple "
      "at all of it is borne, and the upper bound is 0; a cohesion, a pressure beside, too, or a "
      "rigid footing in its place has both bounds",
      scene.sides[static_cast<std::size_t>(end->loaded)].name, end->place.x(), end->place.y(),
      scene.sides[static_cast<std::size_t>(end->bare)].name, scene.materials[end->material].name));
}

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
    if (!soil.is_loose() && soil.tension > 0.0) continue;
    // The weight, aslant in an earthquake, along the skin and across it.
    const mesh::Point &first = outline.at(segment.first), &second = outline.at(segment.second);
    const mesh::Point way = (second - first).normalized();
    for (const Skin& skin : skins_of(scene, soil, first, second)) {
      for (const mesh::Point& place : skin.places) {
        const mesh::Point force = soil.live_unit_weight_at(place) * soils.live_pull + skin.water;
        const double along = std::abs(way.dot(force));
        const double presses_on = way.x() * force.y() - way.y() * force.x();
        // What water lifts off the face, or weight draws off one that hangs over, has no strength
        // at all.
        const double across = std::max(0.0, presses_on);
        const bool is_drawn_off = presses_on < -level * force.norm();
        if (!is_drawn_off && (!soil.is_loose() || along <= level * across)) continue;
        const double slides = is_drawn_off ? 0.0 : std::tan(soil.friction_angle) * across / along;
        if (slides >= result.known_upper.value_or(INFINITY)) continue;
        result.known_upper = slides;
        weakest = fmt::format("{} without {} at the side \"{}\"", scene.materials[m].name,
                              soil.is_loose() ? "cohesion" : "tension", side.name);
      }
    }
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

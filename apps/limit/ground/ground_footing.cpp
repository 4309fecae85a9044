#include "limit/ground/ground_footing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace limit::ground {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string side_key(std::size_t side, const char* key) {
  return fmt::format("side.{}.{}", side, key);
}

bool ends_at_roller(const GroundScene& scene, const Base& base) {
  return std::any_of(scene.sides.begin(), scene.sides.end(), [&](const GroundSide& side) {
    if (side.kind != SideKind::roller) return false;
    for (const mesh::Point& end : {side.along.front(), side.along.back()}) {
      if (end == base.first || end == base.second) return true;
    }
    return false;
  });
}

}  // namespace

std::optional<Base> find_base(const GroundScene& scene, const GroundOutline& outline,
                              tables::Diagnosis& diagnosis) {
  std::optional<Base> base;
  for (std::size_t s = 0; s < scene.sides.size(); ++s) {
    const GroundSide& side = scene.sides[s];
    if (side.kind != SideKind::footing) continue;
    if (base) {
      diagnosis.error(side_key(s, "kind"), "a second footing", "one footing at most");
      return std::nullopt;
    }
    base.emplace();
    base->side = s;
    base->first = side.along.front();
    base->second = side.along.back();
    base->width = (base->second - base->first).norm();
    base->along = (base->second - base->first) / base->width;
    for (const mesh::Point& place : side.along) {
      if (distance(place, base->first, base->second) <= outline.tolerance()) continue;
      diagnosis.error(side_key(s, "along"), "the footing's base is not straight",
                      "a footing has one straight base");
      return std::nullopt;
    }
    if (base->along.x() < 0.0 || (base->along.x() == 0.0 && base->along.y() < 0.0)) {
      base->along = -base->along;
    }
    for (const GroundSegment& segment : outline.segments) {
      if (segment.side != static_cast<int>(s)) continue;
      const mesh::Point way = (outline.at(segment.second) - outline.at(segment.first)).normalized();
      base->inward = mesh::Point(-way.y(), way.x());
    }
  }
  return base;
}

problem::Footing footing_of(const GroundScene& scene, const Base& base,
                            tables::Diagnosis& diagnosis) {
  const GroundLoad& load = scene.load;
  problem::Footing footing;
  footing.centre = (base.first + base.second) / 2.0;
  const mesh::Point force = base.width * (base.inward + std::tan(load.inclination) * base.along);
  const mesh::Point arm = load.eccentricity * base.along;
  const std::array<double, 3> unit{force.x(), force.y(), arm.x() * force.y() - arm.y() * force.x()};
  const bool guided = load.guided.value_or(ends_at_roller(scene, base));
  if (guided) {
    if (load.inclination != 0.0 || load.eccentricity != 0.0) {
      diagnosis.error(
          "load.guided", "a guided footing with an inclined or eccentric load",
          "such a load wants guided = false, and all of the ground, not a mirrored half");
    }
    const bool along_x = std::abs(base.inward.y()) < 1e-12;
    if (!along_x && std::abs(base.inward.x()) >= 1e-12) {
      diagnosis.error("load.guided", "the base of a guided footing is inclined",
                      "it runs along x or y");
    }
    footing.may_move = {along_x, !along_x, false};
  } else {
    footing.may_move = {true, true, true};
  }
  if (!scene.sides[base.side].tension && std::abs(load.eccentricity) >= base.width / 2.0) {
    diagnosis.error("load.eccentricity", fmt::format("found {:g}", load.eccentricity),
                    fmt::format("without tension under it, the footing bears loads less than half "
                                "its width ({:g}) from its middle",
                                base.width / 2.0));
  }
  if (scene.sides[base.side].base == BaseKind::smooth && load.inclination != 0.0) {
    diagnosis.error("load.inclination",
                    fmt::format("found {:g} degrees", load.inclination / degree),
                    "a smooth base bears no load along itself");
  }
  const double given = scene.sides[base.side].pressure;
  for (std::size_t i = 0; i < 3; ++i) {
    footing.dead_load[i] = given * unit[i];
    footing.live_load[i] = scene.load.sought == Sought::footing ? unit[i] : 0.0;
  }
  return footing;
}

}  // namespace limit::ground

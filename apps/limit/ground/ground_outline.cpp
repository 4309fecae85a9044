#include "limit/ground/ground_outline.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace limit::ground {

GroundOutline ground_outline(const GroundScene& scene, tables::Diagnosis& diagnosis) {
  std::vector<shape::NamedRegion> regions;
  for (const GroundRegion& region : scene.regions) {
    regions.push_back({region.name, region.outline, region.holes});
  }
  std::vector<shape::NamedLine> sides;
  for (const GroundSide& side : scene.sides) {
    const auto is_again = [&](const shape::NamedLine& other) { return other.name == side.name; };
    if (std::ranges::any_of(sides, is_again)) {
      diagnosis.error(fmt::format("side.{}.name", sides.size()),
                      fmt::format("found \"{}\" again", side.name), "names of sides are unique");
    }
    sides.push_back({side.name, side.along});
  }
  if (!diagnosis.errors().empty()) return {};
  return shape::join_regions(regions, sides, diagnosis);
}

}  // namespace limit::ground

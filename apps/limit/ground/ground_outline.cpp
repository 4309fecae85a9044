#include "limit/ground/ground_outline.hpp"

namespace limit::ground {

GroundOutline ground_outline(const GroundScene& scene, tables::Diagnosis& diagnosis) {
  std::vector<shape::NamedRegion> regions;
  for (const GroundRegion& region : scene.regions) {
    regions.push_back({region.name, region.outline, region.holes});
  }
  std::vector<shape::NamedLine> sides;
  for (const GroundSide& side : scene.sides) sides.push_back({side.name, side.along});
  return shape::join_regions(regions, sides, diagnosis);
}

}  // namespace limit::ground

#pragma once

#include <vector>

#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// The box around the ground.
struct Extent {
  mesh::Point low{0.0, 0.0}, high{0.0, 0.0};
};
[[nodiscard]] Extent extent_of(const GroundScene& scene);

/// What of a region is within a polygon; the material is still the region's.
struct GroundPart {
  GroundRegion region;
  mesh::Point centre{0.0, 0.0};  // of its area
};
[[nodiscard]] std::vector<GroundPart> parts_within(const GroundRegion& region,
                                                   const std::vector<mesh::Point>& polygon,
                                                   const Extent& ground);

/// What of it is not.
[[nodiscard]] std::vector<GroundPart> parts_beyond(const GroundRegion& region,
                                                   const std::vector<mesh::Point>& polygon,
                                                   const Extent& ground);

/// Cuts regions whose unit weight is told by a table along the lines of that, so that it is linear
/// in every part, which has a material of its own, of the same name.
void cut_along_tables(GroundScene& scene);

/// Likewise those whose unit weight is told by points, of which the nearest counts, or of one value
/// in each cell of a raster, into what is nearest to each.
void cut_between_samples(GroundScene& scene);

}  // namespace limit::ground

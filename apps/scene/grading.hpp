#pragma once

#include <limits>
#include <span>
#include <vector>

#include "scene/scene.hpp"

namespace scene {

/// A box, which may be a point or a line, around which particles are fine.
struct FinePlace {
  Point min, max;        // [m]
  double spacing = 0.0;  // [m]
  double radius = 0.0;   // [m] of what is as fine around it
};

/// The places a graded scene is finest at: the scene's own and the ends of plates and loads that
/// lie within a side, where stresses are singular. A plate's is as fine as far as it will be
/// driven.
[[nodiscard]] std::vector<FinePlace> fine_places(const Scene& scene);

/// The length L [m] of the rule by which the spacing grows: the scene's, else B of the drive, else
/// the shortest extent of the body.
[[nodiscard]] double resolve_grading_length(const Scene& scene);

/// A of that rule: the scene's, else 1/8, or less where nothing yields.
[[nodiscard]] double resolve_growth(const Scene& scene);

/// The widest spacing [m] allowed: the scene's, else an eighth of the shortest extent.
[[nodiscard]] double resolve_coarsest(const Scene& scene);

/// The spacing [m] wanted in a box of space: growth L (r / L)^exponent at a distance r from the
/// nearest fine place, but not less than the place's; the finest where the box is cut by a face of
/// a region, which is followed.
/// @param to_hollows  [m] distance from the nearest cutout, bore or the like, which is fine as well
[[nodiscard]] double wanted_spacing(const Scene& scene, const std::vector<FinePlace>& places,
                                    std::span<const double> min, std::span<const double> max,
                                    double to_hollows = std::numeric_limits<double>::infinity());

}  // namespace scene

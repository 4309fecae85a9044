#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Water that stands on a part of the body's surface that nothing holds, as the scene's pore
/// pressure has it there.
struct StandingWater {
  std::string on;                                   // the side "face"
  double pressure = 0.0;                            // [Pa] its largest
  Eigen::Vector2d at;                               // [m] where that is
  Eigen::Vector2d force = Eigen::Vector2d::Zero();  // [N/m] of all of it on the body
};

/// By sides, in the order of the surface; those that are dry, but for rounding, are left out.
[[nodiscard]] std::vector<StandingWater> standing_water(const scene::Scene& scene,
                                                        const Model<2>& model);

}  // namespace model

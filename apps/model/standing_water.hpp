#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Water that stands on a part of the body's surface that nothing holds, as the scene's pore
/// pressure has it there.
template <int Dim>
struct StandingWater {
  std::string on;                                     // the side "face"
  double pressure = 0.0;                              // [Pa] its largest
  fpm::Vector<Dim> at;                                // [m] where that is
  fpm::Vector<Dim> force = fpm::Vector<Dim>::Zero();  // [N/m or N] of all of it on the body
};

/// By sides, in the order of the surface; those that are dry, but for rounding, are left out.
template <int Dim>
[[nodiscard]] std::vector<StandingWater<Dim>> standing_water(const scene::Scene& scene,
                                                             const Model<Dim>& model);

}  // namespace model

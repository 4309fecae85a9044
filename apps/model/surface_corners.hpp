#pragma once

#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The corners [m] of each piece of the surface of a body whose particles are elements, for
/// pictures: its mesh is read once more. None of what is not found in it.
std::vector<std::vector<fpm::Vector<3>>> surface_corners(const scene::Scene& scene,
                                                         const Model<3>& model);

}  // namespace model

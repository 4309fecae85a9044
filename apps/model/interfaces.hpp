#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The faces at which bodies meet, and those at which they touch supports and the drive.
/// @param model  with particles, materials, bodies and initial stress
template <int Dim>
void add_interfaces(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

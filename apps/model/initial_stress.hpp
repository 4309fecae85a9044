#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The stress before the first step, in the model: geostatic, or none.
/// @param model  with particles, materials and constraints
template <int Dim>
void add_initial_stress(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

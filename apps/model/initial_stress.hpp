#pragma once

#include "constitutive/tensor.hpp"
#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// [Pa] Geostatic stress at a place in ground of one of the scene's materials.
template <int Dim>
constitutive::StressVector<Dim> geostatic_stress(const scene::Scene& scene,
                                                 const fpm::Vector<Dim>& place,
                                                 std::size_t material);

/// The stress before the first step, in the model: geostatic, or none.
/// @param model  with particles, materials and constraints
template <int Dim>
void add_initial_stress(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

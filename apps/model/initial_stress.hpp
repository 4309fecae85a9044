#pragma once

#include "constitutive/tensor.hpp"
#include "model/model.hpp"
#include "scene/choices.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// [Pa] Geostatic stress at a place in ground of one of the scene's materials.
template <int Dim>
constitutive::StressVector<Dim> geostatic_stress(const scene::Scene& scene,
                                                 const fpm::Vector<Dim>& place,
                                                 std::size_t material);

/// [Pa] Geostatic or uniform stress at a place in ground of one of the scene's materials; zero if
/// the scene's initial stress is of another kind.
template <int Dim>
constitutive::StressVector<Dim> initial_stress_at(const scene::Scene& scene,
                                                  const fpm::Vector<Dim>& place,
                                                  std::size_t material);

/// Whether a place on a side is where the wall that the drive moves is.
template <int Dim>
bool is_at_wall(const scene::Scene& scene, scene::Side side, const fpm::Vector<Dim>& place);

/// What the initial stress of particles presses with on a wall whose particles are moved
/// themselves, in the model: that stress at its face.
template <int Dim>
void take_wall_force(const scene::Scene& scene, Model<Dim>& model);

/// [N/m or N] All loads that do not grow, those that follow the boundary as it is at first.
template <int Dim>
Eigen::VectorXd constant_loads(const Model<Dim>& model);

/// The stress before the first step, in the model: geostatic, uniform, or none.
/// @param model  with particles, materials, constraints and loads
template <int Dim>
void add_initial_stress(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

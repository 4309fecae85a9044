#pragma once

#include <Eigen/Core>

#include "model/model.hpp"
#include "model/state.hpp"

namespace scene {
struct Scene;
}

namespace equilibrium {
template <int Dim>
class Equilibrium;
}

namespace stepping {

/// Gives the rows that have strained enough since their last search new neighbours, if the scene
/// asks for it, and has the equilibrium follow.
/// @return the rows rebuilt
template <int Dim>
Eigen::Index re_search(const scene::Scene& scene, const model::Model<Dim>& model,
                       model::State<Dim>& state, equilibrium::Equilibrium<Dim>& equilibrium);

}  // namespace stepping

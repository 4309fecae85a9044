#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/state.hpp"

namespace scene {
struct Scene;
}

namespace stepping {

/// Motions of the body as a rigid one that no support, mirror, penalty or drive resists: "a shift
/// along x", "a turn". Empty if it is held.
template <int Dim>
std::vector<std::string> free_rigid_motions(const model::Model<Dim>& model);

/// What in the scene is likely to keep a step from converging, each with its evidence and the keys
/// to look at: motions that nothing resists, nearly incompressible material, strains beyond what a
/// rate law of elasticity bears.
template <int Dim>
std::vector<std::string> likely_causes(const scene::Scene& scene, const model::Model<Dim>& model,
                                       const model::State<Dim>& state);

}  // namespace stepping

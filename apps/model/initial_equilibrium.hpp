#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Whether ground under a uniform initial stress is at rest: at every side supports, mirrors,
/// contacts and constant loads bear sigma n, faces between materials bear it, and no material is
/// beyond its strength. Silent for scenes of another initial stress.
/// @param model  of the scene before its first stage
/// @throws Refusal of the worst place
template <int Dim>
void check_uniform_stress(const scene::Scene& scene, const Model<Dim>& model);

}  // namespace model

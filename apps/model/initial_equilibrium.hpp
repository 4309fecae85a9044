#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Whether ground under a uniform or, of regions, a geostatic initial stress is at rest: at every
/// side supports, mirrors, contacts, walls and constant loads bear sigma n, faces between materials
/// bear it, and, of a uniform one, no material is beyond its strength. Silent for other scenes.
/// @param model  of the scene before its first stage
/// @throws Refusal of the worst place
template <int Dim>
void check_stress_at_rest(const scene::Scene& scene, const Model<Dim>& model);

}  // namespace model

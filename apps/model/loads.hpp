#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Adds gravity, tractions and penalty supports of a scene to a model whose particles, materials
/// and constraints are set.
template <int Dim>
void add_loads(const scene::Scene& scene, Model<Dim>& model);

/// [m^(Dim-1)] Boundary area vector of each particle, for the consistency correction.
template <int Dim>
fpm::Field<Dim> boundary_area_vectors(const scene::Scene& scene, const Model<Dim>& model);

}  // namespace model

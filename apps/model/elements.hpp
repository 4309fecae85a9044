#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Particles at the centroids of the elements of a scene's mesh, with their volumes; their
/// materials, bodies, surface and joints, and cells for a grid behind them.
/// @param model  with its box, spacing and options of rows
template <int Dim>
void place_elements(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

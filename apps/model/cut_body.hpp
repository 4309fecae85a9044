#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Cuts the cells and the particles of a plane body with cutouts or of regions: a particle is at
/// the centroid of what is left of its cell and stands for its area. What is left of a cell and too
/// small for a particle of its own, or of another region than most of it, goes to a cell beside it.
/// Fills `model.surface` with the pieces of the surface, each within one cell, and, of regions,
/// `model.joints` and `model.material`.
template <int Dim>
void cut_body(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

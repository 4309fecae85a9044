#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Graded prisms: the cells of an octree, cut by the outline and the regions of their section as
/// `cut_body` cuts a plane body, one slab of equal sections after the other. A particle stands for
/// what it has of all slabs that its cell goes through. Fills what `cut_body` does, in space.
/// @param model  with its box, spacing and the cells of the box
void cut_prisms(const scene::Scene& scene, Model<3>& model);

}  // namespace model

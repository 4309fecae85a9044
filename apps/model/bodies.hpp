#pragma once

#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Which body each particle belongs to, into the particles: one, unless an interface parts them.
/// @param model  with particles and materials
template <int Dim>
void part_into_bodies(const scene::Scene& scene, Model<Dim>& model);

/// Bodies of points on the faces of the box: those of the cells they lie on; empty for one body.
template <int Dim>
std::vector<fpm::Index> bodies_at(const Model<Dim>& model, const fpm::BoundaryPoints<Dim>& points);

}  // namespace model

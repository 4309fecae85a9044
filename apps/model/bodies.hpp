#pragma once

#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Which body each particle belongs to, into the particles: one, unless an interface parts them.
/// @param model  with particles and materials
/// @throws InterfaceRefused (given_interface.hpp)
template <int Dim>
void part_into_bodies(const scene::Scene& scene, Model<Dim>& model);

/// Particles whose cells points on the faces of the box lie on; empty where it does not matter, as
/// all are of one body and of one spacing.
template <int Dim>
std::vector<fpm::Index> particles_at(const Model<Dim>& model,
                                     const fpm::BoundaryPoints<Dim>& points);

}  // namespace model

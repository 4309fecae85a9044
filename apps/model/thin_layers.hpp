#pragma once

#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Says of which layers too thin for rows of their own the scene has made one body with their
/// neighbour, each pair of materials once: `model.thin_layers`.
/// @param apart  bodies of particles as they would be if all were thick enough
/// @param fewest  particles across a body that has rows of its own
/// @throws InterfaceRefused (given_interface.hpp) if the scene itself gives an interface between
/// the two
template <int Dim>
void note_thin_layers(const scene::Scene& scene, const std::vector<fpm::Index>& apart,
                      fpm::Index fewest, Model<Dim>& model);

}  // namespace model

#pragma once

#include <cstdint>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The cells of a checked scene's particles: those of a lattice, or of a tree.
template <int Dim>
fpm::Cells<Dim> cells_of(const scene::Scene& scene);

/// Number of particles of a checked scene.
std::int64_t particle_count(const scene::Scene& scene);

/// Builds the model of a checked scene.
/// @throws std::runtime_error if the particle set admits no valid neighbourhoods.
template <int Dim>
Model<Dim> build_model(const scene::Scene& scene);

/// The state before the first step: initial search, initial stress.
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

}  // namespace model

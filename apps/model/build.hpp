#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Builds the model of a checked scene.
/// @throws std::runtime_error if the particle set admits no valid neighbourhoods.
template <int Dim>
Model<Dim> build_model(const scene::Scene& scene);

/// The state before the first step: initial search, initial stress.
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

}  // namespace model

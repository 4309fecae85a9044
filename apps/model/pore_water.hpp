#pragma once

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// What pore water adds to a model with particles and materials: the mass of the water in saturated
/// ground, the pressure at each particle, and the force of its fall.
///
/// That force, less the gradient of the pressure times the volume, is lumped as weight is, so that
/// ground under water at rest is ground of its buoyant weight. It acts on the reference volume:
/// what water bears of grains does not change as the pores between them do.
template <int Dim>
void add_pore_water(const scene::Scene& scene, Model<Dim>& model);

}  // namespace model

#pragma once

#include <stdexcept>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace stepping {

/// Ground that does not stand under its own weight and dead loads.
struct DoesNotSettle : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The model of a scene; where its initial stress is that of gravity, with the stress that remains
/// when weight and dead loads have been switched on, step by step, in small strain and without
/// what the drive moves or lets grow, and, with K0, once the horizontal normal stresses are that
/// part of the vertical one as far as the ground bears it. What that displaced is forgotten.
/// @throws DoesNotSettle
template <int Dim>
model::Model<Dim> model_at_rest(const scene::Scene& scene);

}  // namespace stepping

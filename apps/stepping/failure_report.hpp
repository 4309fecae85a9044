#pragma once

#include <string>
#include <vector>

#include "files/vtkhdf.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "stepping/stepper.hpp"

namespace scene {
struct Scene;
}

namespace stepping {

/// Why the stepper gave up, in words: what ended it, what limits the last attempt, the particles
/// that hold most of its residual and how they fare, and the one setting to change.
/// @param state  the last converged one
template <int Dim>
std::string failure_report(const scene::Scene& scene, const model::Model<Dim>& model,
                           const model::State<Dim>& state, const StepResult& result);

/// What the last attempt left, beside the fields of the converged state: `residual`, the
/// unbalanced force at free unknowns (0 where it could not be evaluated), and `attempt`, the
/// displacement increment tried.
template <int Dim>
std::vector<files::PointField> failure_fields(const model::Model<Dim>& model,
                                              const StepResult& result);

}  // namespace stepping

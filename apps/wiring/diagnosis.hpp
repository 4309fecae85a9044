#pragma once

#include <string>
#include <vector>

#include "wiring/model.hpp"
#include "wiring/scene.hpp"
#include "wiring/state.hpp"
#include "wiring/stepper.hpp"
#include "wiring/vtkhdf.hpp"

namespace wiring {

/// Why the stepper gave up, in words: what ended it, what limits the last attempt, the particles
/// that hold most of its residual and how they fare, and the one setting to change.
/// @param state  the last converged one
template <int Dim>
std::string failure_report(const Scene& scene, const Model<Dim>& model, const State<Dim>& state,
                           const StepResult& result);

/// What the last attempt left, beside the fields of the converged state: `residual`, the
/// unbalanced force at free unknowns (0 where it could not be evaluated), and `attempt`, the
/// displacement increment tried.
template <int Dim>
std::vector<PointField> failure_fields(const Model<Dim>& model, const StepResult& result);

}  // namespace wiring

#pragma once

#include <string>

#include "equilibrium/preconditioner.hpp"
#include "jfnk/options.hpp"
#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace jfnk {
struct Report;
}

namespace equilibrium {
template <int Dim>
class Equilibrium;
}

namespace stepping {

/// The solver as the scene asks for it.
/// @param rounding  [N/m or N] of forces: no residual is asked to be less
jfnk::Options solver_options(const scene::Scene& scene, double rounding);

/// What rounding alone leaves of a residual, whatever the loads [N/m or N]. A body without loads,
/// or whose loads cancel, is in equilibrium within this.
template <int Dim>
double rounding_of_forces(const scene::Scene& scene, const model::Model<Dim>& model);

/// The preconditioner that the scene asks for, on the initial rows whatever was re-searched since:
/// a resumed run has the same one.
template <int Dim>
equilibrium::Preconditioner<Dim> preconditioner_for(
    const scene::Scene& scene, const model::Model<Dim>& model,
    const equilibrium::Equilibrium<Dim>& equilibrium);

/// The outcome of a solve that failed in the words of the scene; the solver's own name options that
/// no scene has.
std::string reason_of(const jfnk::Report& report, const scene::Scene& scene, int dimension);

}  // namespace stepping

#pragma once

#include <optional>

#include "equilibrium/equilibrium.hpp"

namespace stepping {

/// The load parameter without what the control bore in a step and what was out of balance
/// (share/doc/decisions/energy-corrected-load.md): at collapse the load of the step's own mechanism
/// that soil alone bears. One dead load at least must grow, and do work.
inline std::optional<double> corrected_load(double load, const equilibrium::StepForces& forces) {
  if (!(forces.growing_work > 0.0) || !(load > 0.0)) return std::nullopt;
  return load - (forces.hourglass_work + forces.unbalanced_work) / forces.growing_work;
}

}  // namespace stepping

#pragma once

#include "equilibrium/law_loops.hpp"

namespace equilibrium {

/// [J/m or J] What the pair control takes from the work of the loads in a step: the sum over pairs
/// of k kappa y . (e - e(n)), its forces at the end of the step on the way to it. 0 without pairs.
/// Departure: not in the paper (share/doc/decisions/energy-corrected-load.md).
/// @param data  its evaluation holds the extended increment; its state is that of the beginning
template <int Dim>
double hourglass_work(const LoopData<Dim>& data);

}  // namespace equilibrium

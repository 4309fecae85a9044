#pragma once

#include "limit/programme/cone_program.hpp"
#include "limit/solver/cone_solution.hpp"

namespace limit::solver {

/// Solves the program by a primal-dual interior-point method for second-order cones: Nesterov-Todd
/// directions (1998) with Mehrotra's (1992) predictor and corrector. It first centres until the
/// equations and the multipliers' ones hold to rounding, and stays on both from there: whatever the
/// iteration it ends at, its stresses are in equilibrium within yield and its multipliers obey the
/// flow rule. Ends when the duality gap is below `options.cone_gap` of the objective.
[[nodiscard]] ConeSolution solve_by_interior_point(const programme::ConeProgram& program,
                                                   const SolverOptions& options);

}  // namespace limit::solver

#pragma once

#include "limit/programme/cone_program.hpp"
#include "limit/solver/cone_solution.hpp"

namespace limit::solver {

/// Solves the program in the form that the options name. The solvers see it with columns scaled by
/// the cones and rows scaled to a largest entry of one (scaled_program.hpp). The best point reached
/// is returned whatever the status; it need not satisfy anything exactly.
[[nodiscard]] ConeSolution solve(const programme::ConeProgram& program,
                                 const SolverOptions& options);

}  // namespace limit::solver

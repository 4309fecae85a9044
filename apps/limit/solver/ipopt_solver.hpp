#pragma once

#include "limit/programme/cone_program.hpp"
#include "limit/solver/cone_solution.hpp"

namespace limit::solver {

/// Solves the program with Ipopt (Waechter & Biegler 2006), in any form but `cones`.
[[nodiscard]] ConeSolution solve_by_ipopt(const programme::ConeProgram& program,
                                          const SolverOptions& options);

}  // namespace limit::solver

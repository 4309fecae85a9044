#pragma once

#include "limit/cone_solver.hpp"

namespace limit {

/// Solves the program with Ipopt (Waechter & Biegler 2006), in any form but `cones`.
[[nodiscard]] ConeSolution solve_by_ipopt(const ConeProgram& program, const SolverOptions& options);

}  // namespace limit

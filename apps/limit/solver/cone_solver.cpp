#include "limit/solver/cone_solver.hpp"

#include "limit/solver/interior_point.hpp"
#include "limit/solver/ipopt_solver.hpp"

namespace limit::solver {

ConeSolution solve(const programme::ConeProgram& program, const SolverOptions& options) {
  return options.form == ConeForm::cones ? solve_by_interior_point(program, options)
                                         : solve_by_ipopt(program, options);
}

}  // namespace limit::solver

#include "limit/cone_solver.hpp"

#include "limit/interior_point.hpp"
#include "limit/ipopt_solver.hpp"

namespace limit {

ConeSolution solve(const ConeProgram& program, const SolverOptions& options) {
  return options.form == ConeForm::cones ? solve_by_interior_point(program, options)
                                         : solve_by_ipopt(program, options);
}

}  // namespace limit

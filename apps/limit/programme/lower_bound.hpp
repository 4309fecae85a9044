#pragma once

#include <Eigen/Core>
#include <vector>

#include "limit/problem/fields.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"
#include "limit/programme/parabolas.hpp"

namespace limit::programme {

/// The lower-bound theorem on linear stress triangles with statically admissible discontinuities
/// (Lyamin & Sloan 2002): maximise the multiplier over stress fields in equilibrium inside the
/// triangles, across their sides, at the boundaries and with the footing, nowhere beyond yield.
/// Where the footing may lift off, no corner under it is in tension.
/// The variables are 9 per triangle, 3 per such corner, the last one is the multiplier.
/// The strength is less by one or two parts in 1e6, so that the answer of a solver lies inside.
/// A curved envelope is replaced by parabolas within it, true where they touch it.
[[nodiscard]] ConeProgram lower_bound_program(const problem::Problem& problem,
                                              const Parabolas& parabolas = {});

/// The stress field in the variables of such a program.
[[nodiscard]] problem::StressField stress_field(const problem::Problem& problem,
                                                const Eigen::VectorXd& variables);

}  // namespace limit::programme

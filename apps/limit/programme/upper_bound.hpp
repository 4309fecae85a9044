#pragma once

#include <Eigen/Core>
#include <vector>

#include "limit/problem/fields.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"
#include "limit/programme/parabolas.hpp"

namespace limit::programme {

/// The upper-bound theorem on six-node triangles with straight sides and velocity jumps between
/// them (Makrodimopoulos & Martin 2007, 2008), as its dual: maximise the multiplier over stresses
/// at the corners and tractions along the sides that are nowhere beyond yield and whose power on
/// every velocity is that of the loads. The strain rate is linear in a triangle and the jump
/// quadratic along a side, so that a flow rule kept in the corners and by the jump's control points
/// (Bernstein) is kept everywhere. The velocities are the multipliers of the equations: 12 per
/// triangle, then the footing's motions that are free; then the openings, at each control point
/// where the footing may lift off.
/// A curved envelope is replaced by parabolas that are true where they touch it.
[[nodiscard]] ConeProgram upper_bound_program(const problem::Problem& problem,
                                              const Parabolas& parabolas = {});

/// The velocity field of such a program's multipliers, scaled to unit power of the live load.
[[nodiscard]] problem::VelocityField velocity_field(const problem::Problem& problem,
                                                    const Eigen::VectorXd& multipliers);

}  // namespace limit::programme

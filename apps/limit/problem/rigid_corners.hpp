#pragma once

#include "limit/problem/problem.hpp"

namespace limit::problem {

/// The problem of an upper bound without the tips of rigid corners that are too narrow for soil to
/// leave. A velocity that parts from a rough support points away from it by at least the friction
/// angle phi; between two of them that open to 2 phi or less (one and a frictionless one: phi) none
/// does so from both, and no triangles or velocity jumps in the corner help. Soil there can be
/// admissible only at rest, the programme has no strictly admissible velocity, and its dual no
/// bounded set of solutions: an interior-point method cannot find the centre. So the tip, of some
/// tenths of the triangles in the corner, is left to what is rigid beyond: a mechanism of the rest
/// is one of the whole, with the tip at rest. No rectangular box is changed for phi < 42.5 degrees.
[[nodiscard]] Problem with_rigid_corners_cut(Problem problem);

}  // namespace limit::problem

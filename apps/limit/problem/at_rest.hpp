#pragma once

#include <vector>

#include "limit/problem/problem.hpp"

namespace limit::problem {

/// The problem of an upper bound in which the soils chosen stay where they are, as rigid ground
/// does: a mechanism of what is left is one of the whole, whose velocity jumps where they meet are
/// in the softer soil. Their triangles are left out of the mesh; their nodes remain, unused.
/// @param rests  for each soil
[[nodiscard]] Problem with_soils_at_rest(Problem problem, const std::vector<bool>& rests);

}  // namespace limit::problem

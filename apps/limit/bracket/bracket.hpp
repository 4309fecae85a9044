#pragma once

#include <functional>

#include "limit/bracket/attempt.hpp"
#include "limit/bracket/means.hpp"
#include "limit/problem/case.hpp"

namespace limit::bracket {

/// Brackets the multiplier: solves and certifies a bound on each side, then refines in turn, where
/// the soil flows most, the side whose last refinement brought more for its work, until the gap is
/// reached or the budget spent. The best certified bound of each side is kept, so that no
/// refinement loosens the bracket. An attempt that fails is repeated with another form of the
/// cones, and so by another solver. Each attempt is given what is left of the budget.
/// @param lower, upper  the same problem in units of order one, on the meshes to begin with
/// @param watch  told of every attempt as it ends
[[nodiscard]] Bracket bracket(problem::Problem lower, problem::Problem upper,
                              const BracketOptions& options,
                              const std::function<void(const Attempt&)>& watch = {},
                              const Means& means = {});

/// Brackets a case in its units. The bracket's multiplier times `units.multiplier()` is the answer.
[[nodiscard]] Bracket bracket(const problem::Case& problem, const BracketOptions& options,
                              const std::function<void(const Attempt&)>& watch,
                              const Means& means = {});

}  // namespace limit::bracket

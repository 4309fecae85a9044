#pragma once

#include "limit/bracket/solution.hpp"

namespace limit::bracket {

/// Brackets what the case seeks: the multiplier of its live loads or the factor of its strength.
[[nodiscard]] Solution solution_of(const problem::Case& problem, const BracketOptions& options,
                                   const std::function<void(const Attempt&)>& watch,
                                   const Means& means = {});

}  // namespace limit::bracket

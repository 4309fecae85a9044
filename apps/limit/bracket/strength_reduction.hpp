#pragma once

#include "limit/bracket/solution.hpp"
#include "limit/bracket/weakened.hpp"

namespace limit::bracket {

/// The factor that may divide cohesion and tan(phi) of all soils before the live loads, at a
/// multiplier of one, make the body collapse: between the largest one at which a certified stress
/// field carries more than these loads, and the least one at which a certified mechanism fails
/// under less. As every stress field may be scaled down (nothing at all is within yield), both
/// decide for multiplier one exactly. Secants of the multipliers' logarithms find them; they prove
/// nothing. The bracket holds the two fields, their multipliers are close to one.
/// @throws std::invalid_argument unless the case has live loads only.
[[nodiscard]] Solution reduce_strength(const problem::Case& problem, const BracketOptions& options,
                                       const std::function<void(const Attempt&)>& watch,
                                       const Means& means = {});

}  // namespace limit::bracket

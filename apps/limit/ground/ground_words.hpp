#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limit/ground/ground_footing.hpp"
#include "limit/ground/ground_types.hpp"

namespace limit::ground {

/// What is assumed of a scene, for a report.
[[nodiscard]] std::vector<std::string> assumptions_of(const GroundScene& scene,
                                                      const problem::Problem& problem,
                                                      const std::optional<Base>& base);

/// Gives a case the data of its scene, what is bracketed and its unit.
void describe(const GroundScene& scene, problem::Case& result);

/// Notes that a dilation angle does not count where a friction angle changes.
void note_dilation(const GroundScene& scene, problem::Case& result);

}  // namespace limit::ground

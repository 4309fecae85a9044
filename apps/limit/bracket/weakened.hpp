#pragma once

#include <vector>

#include "limit/problem/problem.hpp"

namespace limit::bracket {

/// Cohesion and tan(phi) divided by a factor.
[[nodiscard]] problem::Soil weakened(const problem::Soil& soil, double factor);
[[nodiscard]] std::vector<problem::Soil> weakened(std::vector<problem::Soil> soils, double factor);

}  // namespace limit::bracket

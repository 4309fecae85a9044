#include "limit/bracket/solution.hpp"

#include <limits>

namespace limit::bracket {

double Solution::gap() const {
  if (lower && upper && *lower == *upper) return 0.0;  // of nothing as well
  if (!lower || !upper || !(*lower + *upper > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * (*upper - *lower) / (*upper + *lower);
}

}  // namespace limit::bracket

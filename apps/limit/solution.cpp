#include "limit/solution.hpp"

#include <limits>

#include "limit/strength_reduction.hpp"

namespace limit {

double Solution::gap() const {
  if (!lower || !upper || !(*lower + *upper > 0.0)) return std::numeric_limits<double>::infinity();
  return 2.0 * (*upper - *lower) / (*upper + *lower);
}

Solution solution_of(const Case& problem, const BracketOptions& options,
                     const std::function<void(const Attempt&)>& watch) {
  if (problem.seeks_strength) return reduce_strength(problem, options, watch);
  Solution solution;
  solution.bracket = bracket(problem, options, watch);
  const double unit = problem.units.multiplier();
  if (solution.bracket.lower) solution.lower = solution.bracket.lower_bound() * unit;
  if (solution.bracket.upper) solution.upper = solution.bracket.upper_bound() * unit;
  return solution;
}

}  // namespace limit

#include "limit/bracket/solve.hpp"

#include "limit/bracket/strength_reduction.hpp"

namespace limit::bracket {

Solution solution_of(const problem::Case& problem, const BracketOptions& options,
                     const std::function<void(const Attempt&)>& watch, const Means& means) {
  if (problem.seeks_strength) return reduce_strength(problem, options, watch, means);
  Solution solution;
  if (problem.known_upper) {
    // Known in closed form to be nothing, to which meshes would come down without an end.
    solution.upper = problem.known_upper;
    return solution;
  }
  solution.bracket = bracket(problem, options, watch, means);
  const double unit = problem.units.multiplier();
  if (solution.bracket.lower) solution.lower = solution.bracket.lower_bound() * unit;
  if (solution.bracket.upper) solution.upper = solution.bracket.upper_bound() * unit;
  return solution;
}

}  // namespace limit::bracket

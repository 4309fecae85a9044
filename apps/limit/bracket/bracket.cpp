#include "limit/bracket/bracket.hpp"

#include <algorithm>

#include "limit/bracket/side.hpp"

namespace limit::bracket {

Bracket bracket(problem::Problem lower, problem::Problem upper, const BracketOptions& options,
                const std::function<void(const Attempt&)>& watch, const Means& means) {
  const double began = means.seconds();
  const auto spent = [&] { return means.seconds() - began; };
  const auto remaining = [&] {
    BracketOptions rest = options;
    rest.max_seconds = options.max_seconds - spent();
    return rest;
  };
  Bracket result;
  Side below(std::move(lower), true, means), above(std::move(upper), false, means);
  // What fails on one mesh after the other is not for solvers.
  constexpr int most_failures = 4;
  below.attempt(result, remaining(), watch);
  if (spent() < options.max_seconds) above.attempt(result, remaining(), watch);
  while (result.gap() > options.gap && spent() < options.max_seconds) {
    std::vector<Side*> sides;
    for (Side* side : {&below, &above}) {
      if (!side->can_refine() || side->failures() >= most_failures) continue;
      if (side->triangles() < options.max_triangles) sides.push_back(side);
    }
    if (sides.empty()) break;
    Side& next = **std::max_element(sides.begin(), sides.end(),
                                    [](Side* a, Side* b) { return a->promise() < b->promise(); });
    // Where all flow is next to one point a mesh would else grow by a handful of triangles.
    constexpr double growth = 1.1;
    next.refine(growth);
    next.attempt(result, remaining(), watch);
  }
  result.reached = result.gap() <= options.gap;
  return result;
}

Bracket bracket(const problem::Case& problem, const BracketOptions& options,
                const std::function<void(const Attempt&)>& watch, const Means& means) {
  return bracket(in_units(problem.lower, problem.units), in_units(problem.upper, problem.units),
                 options, watch, means);
}

}  // namespace limit::bracket

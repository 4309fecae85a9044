// The budget is one for all solves of a bracket: a clock that only solvers move, and solvers that
// note what they are given.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "limit/bracket/bracket.hpp"
#include "limit/bracket/solve.hpp"
#include "limit/bracket/strength_reduction.hpp"
#include "limit/problem/case.hpp"

namespace {

using namespace limit;

struct Given {
  double at, seconds;  // when a solver was asked, and how long it was given
};

// Every solve takes so long by its clock.
struct Workshop {
  explicit Workshop(double per_solve, bool fails = false) {
    means.seconds = [this] { return now; };
    means.solve = [this, per_solve, fails](const programme::ConeProgram& program,
                                           const solver::SolverOptions& options) {
      given.push_back({now, options.max_seconds});
      now += per_solve;
      if (!fails) return solver::solve(program, {});
      solver::ConeSolution nothing;
      nothing.variables = program.start;
      nothing.multipliers = Eigen::VectorXd::Zero(program.equations.rows());
      return nothing;
    };
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  double now = 1e3;  // of a process that has done other things before
  std::vector<Given> given;
  bracket::Means means;
};

// Whatever is asked, is given the rest, but a second at least, which no solver is worth asking for
// less; and nothing is asked when nothing is left.
/// @param share  of the budget, more than which none is given
void expect_the_rest(const Workshop& workshop, double budget, double share = 1.0) {
  constexpr double least = 1.0;
  for (const Given& solve : workshop.given) {
    const double left = budget - (solve.at - workshop.given.front().at);
    EXPECT_GT(left, 0.0);
    EXPECT_EQ(solve.seconds, std::max(least, std::min(left, share * budget)));
  }
}

bracket::BracketOptions options(double budget) {
  bracket::BracketOptions options;
  options.gap = 1e-9;  // never reached
  options.max_seconds = budget;
  return options;
}

problem::Problem strip() {
  problem::Strip strip;
  strip.soil = {1.0, 20.0 * std::numbers::pi / 180.0, 0.0};
  const problem::Box box = problem::box_of(strip);
  return problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, 8, 4, 1.5)),
      problem::units_of(strip));
}

TEST(Budget, WhatIsLeftIsHandedFromSolveToSolve) {
  constexpr double budget = 44.0, per_solve = 8.0;
  Workshop workshop(per_solve);
  (void)bracket::bracket(strip(), strip(), options(budget), {}, workshop.means);
  EXPECT_EQ(workshop.given.size(), 6U);  // at 0, 8, .. 40 s
  expect_the_rest(workshop, budget);
}

// What is refined next is a matter of what was gained for how much work, not of who else keeps the
// machine busy.
TEST(Budget, WhatIsRefinedNextDoesNotDependOnTheClock) {
  std::vector<std::vector<std::pair<bool, int>>> ways;
  for (const double later : {0.1, 10.0}) {
    double now = 0.0, takes = 1.0;
    bracket::Means means;
    means.seconds = [&now] { return now; };
    means.solve = [&](const programme::ConeProgram& program, const solver::SolverOptions&) {
      now += takes;
      takes *= later;
      return solver::solve(program, {});
    };
    bracket::BracketOptions once = options(1e30);
    once.max_triangles = 300;
    const bracket::Bracket found = bracket::bracket(strip(), strip(), once, {}, means);
    std::vector<std::pair<bool, int>>& way = ways.emplace_back();
    for (const bracket::Attempt& attempt : found.attempts) {
      way.emplace_back(attempt.is_lower, attempt.triangles);
    }
  }
  EXPECT_GT(ways[0].size(), 5U);
  EXPECT_EQ(ways[0], ways[1]);
}

TEST(Budget, FallBacksShareItAndAreNotAskedWhenItIsSpent) {
  constexpr double budget = 10.0;
  for (const double per_solve : {0.5, 4.0, 8.0, 12.0}) {
    Workshop workshop(per_solve, true);
    bracket::BracketOptions once = options(budget);
    once.max_triangles = 1;
    (void)bracket::bracket(strip(), strip(), once, {}, workshop.means);
    EXPECT_EQ(workshop.given.size(), per_solve == 0.5   ? 6U  // four forms below, two above
                                     : per_solve == 4.0 ? 3U
                                     : per_solve == 8.0 ? 2U
                                                        : 1U);
    expect_the_rest(workshop, budget);
  }
}

// The strip under a pressure of one, which its strength can be divided by some three to carry.
problem::Case loaded_strip() {
  problem::Case result;
  result.lower = strip();
  result.lower.most_multiplier = 4.0;
  result.upper = result.lower;
  result.seeks_strength = true;
  return result;
}

TEST(Budget, OfAStrengthReductionIsHandedFromFactorToFactor) {
  constexpr double budget = 100.0, per_solve = 8.0;
  Workshop workshop(per_solve);
  const bracket::Solution found =
      bracket::solution_of(loaded_strip(), options(budget), {}, workshop.means);
  EXPECT_TRUE(found.lower && found.upper);
  EXPECT_EQ(workshop.given.size(), 13U);  // at 0, 8, .. 96 s
  constexpr double share = 0.3;  // one factor that leads nowhere must leave time for others
  expect_the_rest(workshop, budget, share);
}

// Solvers that end short of their optimum, as they do in soil of hardly any cohesion, but have come
// close by then: what is certified is gone on from.
TEST(StrengthReduction, GoesOnFromWhatWasCertifiedBeforeASolverFailed) {
  bracket::Means means;
  means.solve = [](const programme::ConeProgram& program, const solver::SolverOptions& options) {
    solver::ConeSolution solution = solver::solve(program, options);
    constexpr double without_end = 3.9;  // as far as multipliers are followed
    if (program.objective.dot(solution.variables) < without_end) {
      solution.status = solver::SolverStatus::failed;
    }
    return solution;
  };
  bracket::BracketOptions first = options(100.0);
  first.gap = 0.02;
  first.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(loaded_strip(), first, {}, means);
  ASSERT_TRUE(found.upper);
  // A first mesh is settled to half the gap in the factor, and the multiplier of such soil falls
  // with its second power or less.
  EXPECT_NEAR(found.bracket.upper_bound(), 1.0, first.gap);
  EXPECT_LE(found.bracket.upper_bound(), 1.0);
}

}  // namespace

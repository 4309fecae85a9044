// Soils side by side of very different strength, and solvers that fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>
#include <utility>

#include "limit/bracket/bracket.hpp"
#include "limit/problem/case.hpp"
#include "limit/programme/upper_bound.hpp"

namespace {

using namespace limit;

// A strip on clay of cohesion 1 with a layer of next to none at 0.6 to 0.9 half widths.
problem::Problem on_a_soft_layer(double cohesion) {
  problem::Strip strip;
  strip.soil = {1.0, 0.0, 0.0};
  const problem::Box box = problem::box_of(strip);
  problem::Problem problem =
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, 24, 8, 1.5));
  problem.soils.push_back({cohesion, 0.0, 0.0});
  for (mesh::Triangle& triangle : problem.mesh.triangles) {
    double depth = 0.0;
    for (const int node : triangle.nodes) {
      depth -= problem.mesh.nodes[static_cast<std::size_t>(node)].y() / 3.0;
    }
    if (depth > 0.6 && depth < 0.9) triangle.region = 1;
  }
  return problem;
}

// The strength of a soil is no measure of the pressure it is under: that of its neighbours' load.
TEST(Layers, OfAHundredthOfTheStrengthBesideThemNeedNoFallBack) {
  for (const double cohesion : {1e-2, 1e-3}) {
    bracket::BracketOptions options;
    options.gap = 1e-6;
    options.max_triangles = 1;
    const problem::Problem problem = on_a_soft_layer(cohesion);
    const bracket::Bracket found = bracket::bracket(problem, problem, options);
    ASSERT_TRUE(found.lower && found.upper) << cohesion;
    EXPECT_EQ(found.attempts.size(), 2U) << cohesion;
    for (const bracket::Attempt& attempt : found.attempts) {
      EXPECT_EQ(attempt.status, solver::SolverStatus::solved) << attempt.message << cohesion;
    }
    // Prandtl's load of the harder clay alone.
    EXPECT_LT(found.lower_bound(), 2.0 + std::numbers::pi);
    EXPECT_LE(found.lower_bound(), found.upper_bound());
  }
}

// Where soils meet the velocity jumps in the softer one, whichever triangle is named first: the
// harder one's strength there would be in the way of a mechanism that slides along it.
TEST(Layers, MeetInTheSofterOneWhicheverIsNamedFirst) {
  std::vector<double> found;
  for (const bool reversed : {false, true}) {
    problem::Problem problem = on_a_soft_layer(1e-2);
    if (reversed) std::reverse(problem.mesh.triangles.begin(), problem.mesh.triangles.end());
    const solver::ConeSolution solution =
        solver::solve(programme::upper_bound_program(problem), {});
    ASSERT_EQ(solution.status, solver::SolverStatus::solved);
    const problem::VelocityField field = programme::velocity_field(problem, solution.multipliers);
    const certificate::UpperCertificate certified =
        certificate::certify_upper(problem, field, field);
    ASSERT_TRUE(certified.holds);
    found.push_back(certified.multiplier);
  }
  constexpr double both = 2e-5;  // the solver's gaps
  EXPECT_NEAR(found[1] / found[0], 1.0, both);
}

// Sublayers of a clay whose strength grows with depth: adjacent ones touch in strength.
TEST(Layers, TenOfThemAreBoundedOnBothSidesAndNoSolveIsPaidForTwice) {
  problem::Strip strip;
  strip.soil = {1.0, 0.0, 0.0};
  const problem::Box box = problem::box_of(strip);
  problem::Problem problem =
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, 24, 10, 1.0));
  problem.soils.clear();
  for (int layer = 0; layer < 10; ++layer) problem.soils.push_back({1.0 + 0.2 * layer, 0.0, 0.0});
  for (mesh::Triangle& triangle : problem.mesh.triangles) {
    double depth = 0.0;
    for (const int node : triangle.nodes) {
      depth -= problem.mesh.nodes[static_cast<std::size_t>(node)].y() / 3.0;
    }
    triangle.region = std::clamp(static_cast<int>(10.0 * depth / box.depth), 0, 9);
  }
  const bracket::Bracket found = bracket::bracket(problem, problem, {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.reached);
  // More than the uppermost alone, less than the lowest.
  EXPECT_GT(found.lower_bound(), 2.0 + std::numbers::pi);
  EXPECT_LT(found.upper_bound(), 2.8 * (2.0 + std::numbers::pi));
  std::set<std::pair<bool, int>> tried;
  for (const bracket::Attempt& attempt : found.attempts) {
    EXPECT_EQ(attempt.status, solver::SolverStatus::solved) << attempt.message;
    EXPECT_TRUE(tried.emplace(attempt.is_lower, attempt.triangles).second);
  }
}

TEST(Layers, AFallBackThatHasFailedIsNotAskedOnTheNextMesh) {
  bracket::BracketOptions options;
  options.max_iterations = 9;  // certified bounds, but too few iterations for any solver
  const problem::Problem problem = on_a_soft_layer(0.5);
  const bracket::Bracket found = bracket::bracket(problem, problem, options);
  ASSERT_GT(found.attempts.back().triangles, found.attempts.front().triangles);
  for (const bool is_lower : {true, false}) {
    for (const solver::ConeForm form :
         {solver::ConeForm::inequality, solver::ConeForm::quadratic, solver::ConeForm::barrier}) {
      EXPECT_LE(std::count_if(found.attempts.begin(), found.attempts.end(),
                              [&](const bracket::Attempt& attempt) {
                                return attempt.is_lower == is_lower && attempt.form == form;
                              }),
                1);
    }
    EXPECT_LE(std::count_if(found.attempts.begin(), found.attempts.end(),
                            [&](const bracket::Attempt& attempt) {
                              return attempt.is_lower == is_lower &&
                                     attempt.form == solver::ConeForm::cones;
                            }),
              4);
  }
}

}  // namespace

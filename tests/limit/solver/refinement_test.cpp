// Iterative refinement with solves of given quality.
#include "limit/solver/refinement.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using limit::solver::NewtonSolution;
using limit::solver::refined;

Eigen::VectorXd one(double value) {
  return Eigen::VectorXd::Constant(1, value);
}

// x = first and y = second are asked for; the k-th solve leaves these shares of what is asked.
struct Scripted {
  std::vector<double> x, y;
  int solves = 0;

  NewtonSolution solution(double first, double second) {
    const auto solve = [&](const Eigen::VectorXd& rest, const Eigen::VectorXd& other) {
      const auto at = static_cast<std::size_t>(solves++);
      const double after_x = at < x.size() ? x[at] : 1.0, after_y = at < y.size() ? y[at] : 1.0;
      return NewtonSolution{(1.0 - after_x) * rest, (1.0 - after_y) * other};
    };
    const auto left = [&](const NewtonSolution& at) {
      return NewtonSolution{one(first) - at.x, one(second) - at.y};
    };
    return refined(one(first), one(second), solve, left);
  }
};

TEST(Refinement, GoesOnUntilNothingIsLeft) {
  Scripted script{{1e-3, 1e-3, 1e-3, 1e-3, 1e-3}, {1e-3, 1e-3, 1e-3, 1e-3, 1e-3}};
  const NewtonSolution found = script.solution(1.0, 2.0);
  EXPECT_LE(script.solves, 5);  // 1e-12 is enough
  EXPECT_NEAR(found.x[0], 1.0, 1e-12);
  EXPECT_NEAR(found.y[0], 2.0, 2e-12);
}

// The third solve halves what is left of the one and makes the other ten times worse.
TEST(Refinement, KeepsTheIterateThatSatisfiesTheEquationsBest) {
  Scripted script{{0.1, 0.1, 0.1}, {0.1, 0.1, 10.0}};
  const NewtonSolution found = script.solution(1.0, 1.0);
  EXPECT_EQ(script.solves, 4);
  EXPECT_NEAR(1.0 - found.y[0], 0.01, 1e-15);
  EXPECT_NEAR(1.0 - found.x[0], 0.01, 1e-15);
}

TEST(Refinement, EndsWhereItMakesAllWorse) {
  Scripted script{{0.5, 3.0, 3.0}, {0.5, 3.0, 3.0}};
  const NewtonSolution found = script.solution(1.0, 1.0);
  EXPECT_EQ(script.solves, 2);
  EXPECT_NEAR(found.x[0], 0.5, 1e-15);
  EXPECT_NEAR(found.y[0], 0.5, 1e-15);
}

}  // namespace

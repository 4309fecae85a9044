// Iterative refinement with solves of given quality.
#include "limit/solver/refinement.hpp"

#include <gtest/gtest.h>

namespace {

using limit::solver::NewtonSolution;
using limit::solver::refined;

// x = first and y = second are asked for, of as many unknowns each as there are shares; a solve
// leaves of each what these shares say.
struct Rough {
  Eigen::VectorXd x, y, stiffness;
  int solves = 0;

  Rough(Eigen::VectorXd left_of_x, Eigen::VectorXd left_of_y)
      : x(std::move(left_of_x)),
        y(std::move(left_of_y)),
        stiffness(Eigen::VectorXd::Ones(x.size())) {}

  NewtonSolution solution(const Eigen::VectorXd& first, const Eigen::VectorXd& second) {
    const auto solve = [&](const Eigen::VectorXd& rest, const Eigen::VectorXd& other) {
      ++solves;
      const Eigen::VectorXd wanted = rest.cwiseQuotient(stiffness);
      return NewtonSolution{wanted - x.cwiseProduct(wanted), other - y.cwiseProduct(other)};
    };
    const auto left = [&](const NewtonSolution& at) {
      // Curvature makes errors of what rounding leaves of x.
      return NewtonSolution{stiffness.cwiseProduct(noise + first - at.x), second - at.y};
    };
    return refined(stiffness.cwiseProduct(first), second, solve, left, stiffness);
  }
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(x.size());
};

Eigen::VectorXd ones(Eigen::Index size) {
  return Eigen::VectorXd::Ones(size);
}

TEST(Refinement, GoesOnUntilNothingIsLeft) {
  Rough rough(1e-3 * ones(3), 1e-3 * ones(2));
  const NewtonSolution found = rough.solution(ones(3), 2.0 * ones(2));
  EXPECT_LE(rough.solves, 5);  // 1e-12 is enough
  EXPECT_LT((found.x - ones(3)).norm(), 1e-11);
  EXPECT_LT((found.y - 2.0 * ones(2)).norm(), 1e-11);
}

// Equations that nearly depend on each other, of which a solve takes next to nothing away: plain
// corrections would want 60 solves for a share of 0.6, and 2700 for one of 0.99. As many directions
// as there are different shares want as many corrections, and one more for rounding.
TEST(Refinement, TakesAwayWhatASolveLeavesInAFewDirections) {
  Eigen::VectorXd shares = Eigen::VectorXd::Constant(50, 1e-9);
  shares[7] = 0.99;
  shares[30] = 0.6;
  Rough rough(Eigen::VectorXd::Constant(50, 1e-9), shares);
  const NewtonSolution found = rough.solution(ones(50), ones(50));
  EXPECT_LE(rough.solves, 5);
  EXPECT_LT((found.y - ones(50)).lpNorm<Eigen::Infinity>(), 1e-11);
}

// What is left of the first equations, times the curvature, is much, and no error to speak of: the
// second ones are mended all the same.
TEST(Refinement, IsNotLedAstrayByRoundingTimesCurvature) {
  Rough rough(1e-3 * ones(2), 0.3 * ones(2));
  rough.stiffness << 1e10, 1e9;
  rough.noise << 1e-14, -1e-14;
  const NewtonSolution found = rough.solution(ones(2), ones(2));
  EXPECT_LT((found.y - ones(2)).norm(), 1e-11);
}

TEST(Refinement, EndsWhereASolveIsOfNoUse) {
  Rough rough(ones(1), ones(1));  // leaves all of it
  const NewtonSolution found = rough.solution(ones(1), ones(1));
  EXPECT_LE(rough.solves, 3);
  EXPECT_TRUE(found.y.allFinite());
}

}  // namespace

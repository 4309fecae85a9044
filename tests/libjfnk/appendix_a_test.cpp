#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::appendix_a;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Vector;

TEST(AppendixA, CountsOfALinearScalarAreThoseByHand) {
  // F = 2u - 4 from 0. Start: 1. Step 1: one column, one trial; ||F|| is met, but ||du||/||u|| = 1
  // is not. Step 2: one column, one trial of length 1e-8, and both tolerances of Eq. 23 are met.
  Vector u = Vector::Zero(1);
  const Report report =
      solve([](const Vector& v, Vector& r) { r[0] = 2.0 * v[0] - 4.0; }, u, appendix_a(1e-4, 1e-4));
  ASSERT_TRUE(report.converged());
  EXPECT_EQ(report.counts.start, 1);
  EXPECT_EQ(report.counts.newton_trials, 2);
  EXPECT_EQ(report.counts.line_search, 0);
  EXPECT_EQ(report.counts.difference_actions, 2);
  EXPECT_EQ(report.counts.total(), 5);
}

TEST(AppendixA, SaysSoWhenOnlyTheStepIsTooLong) {
  // As above, cut off after the first step: ||F|| is met, ||du||/||u|| = 1 is not.
  Options options = appendix_a(1e-4, 1e-4);
  options.max_evaluations = 3;
  Vector u = Vector::Zero(1);
  const Report report =
      solve([](const Vector& v, Vector& r) { r[0] = 2.0 * v[0] - 4.0; }, u, options);
  EXPECT_EQ(report.status, jfnk::Status::evaluation_limit);
  EXPECT_LE(report.residual_norm, report.tolerance);
  EXPECT_NE(report.reason.find("the last step is longer than tolerances.step allows"),
            std::string::npos)
      << report.reason;
}

/// Table A1 for one unknown, written down independently; returns every point evaluated.
template <class F>
std::vector<double> table_a1(F f, double d, double eps_f, double eps_u, double noise) {
  std::vector<double> points;
  auto evaluate = [&](double at) {
    points.push_back(at);
    return f(at);
  };
  double force = evaluate(d);
  const double first = std::abs(force);
  double change = std::abs(d) + 1.0;
  while (std::abs(force) > eps_f * first || change > eps_u * std::abs(d)) {
    const double z = force > 0.0 ? -1.0 : 1.0;  // r0 / ||r0|| with r0 = -F
    const double tau = (1.0 + 1.0) * noise * (d != 0.0 ? std::abs(d) : 1.0);
    const double slope = (evaluate(d + tau * z) - force) / tau;  // J z
    const double step = -force / slope * z;
    double beta = 1.0;
    double trial = evaluate(d + beta * step);
    while (std::abs(trial) > std::abs(force)) {
      beta *= 0.8;
      trial = evaluate(d + beta * step);
    }
    d += beta * step;
    change = std::abs(beta * step);
    force = trial;
  }
  return points;
}

TEST(AppendixA, EvaluatesThePointsOfTableA1) {
  const auto f = [](double x) { return std::atan(x - 1.0) + 0.01 * (x - 1.0); };
  const Options options = appendix_a(1e-9, 1e-9);
  const std::vector<double> expected = table_a1(f, 3.5, 1e-9, 1e-9, options.jacobian.noise);
  std::vector<double> points;
  Vector u = Vector::Constant(1, 3.5);
  const Report report = solve(
      [&](const Vector& v, Vector& r) {
        points.push_back(v[0]);
        r[0] = f(v[0]);
      },
      u, options);
  ASSERT_TRUE(report.converged());
  EXPECT_GT(report.counts.line_search, 0);
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Both differ by rounding only, which the slope magnifies to eps_machine / noise = 1.5e-8.
    EXPECT_NEAR(points[i], expected[i], 1e-6) << i;
  }
}

TEST(AppendixA, ForcingIsOneHundredthAndStopsAtMMax) {
  const jfnk_test::Bratu bratu(16, 6.0);
  const Options options = appendix_a(1e-6, 1e-6, 20);
  Vector u = Vector::Zero(bratu.size());
  const Report report = solve(bratu, u, options);
  ASSERT_TRUE(report.converged()) << report.reason;
  for (std::size_t i = 1; i < report.history.size(); ++i) {
    const auto& line = report.history[i];
    EXPECT_EQ(line.forcing, 0.01);
    EXPECT_TRUE(line.linear_residual <= 0.01 || line.krylov_iterations == 20);
    EXPECT_LE(line.krylov_iterations, 20);
    EXPECT_LE(line.residual_norm, report.history[i - 1].residual_norm);
  }
  EXPECT_LE(report.residual_norm, 1e-6 * report.initial_residual_norm);
  EXPECT_LE(report.history.back().step_norm, 1e-6 * u.norm());
}

TEST(AppendixA, IgnoresTheResidualsOwnJacobian) {
  jfnk_test::BratuWithJacobian bratu(8, 2.0);
  Vector u = Vector::Zero(bratu.size());
  const Report report = solve(bratu, u, appendix_a());
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.counts.user_actions, 0);
  EXPECT_GT(report.counts.difference_actions, 0);
}

TEST(AppendixA, MMaxIsBetween20And1000) {
  EXPECT_THROW((void)appendix_a(1e-6, 1e-6, 19), std::invalid_argument);
  EXPECT_THROW((void)appendix_a(1e-6, 1e-6, 1001), std::invalid_argument);
  EXPECT_TRUE(jfnk::validate(appendix_a(1e-6, 1e-6, 1000)).empty());
}

}  // namespace

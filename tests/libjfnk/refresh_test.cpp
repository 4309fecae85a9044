#include <gtest/gtest.h>

#include <Eigen/LU>

#include "jfnk/jfnk.hpp"

namespace {

using jfnk::Options;
using jfnk::PreconditionerSetup;
using jfnk::Report;
using jfnk::Vector;

/// A chain with reactions in u^3: far from the root they rule the Jacobian, at it they do not.
struct Reaction {
  void operator()(const Vector& u, Vector& r) const {
    const Eigen::Index n = u.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = 2.0 * u[i] - (i > 0 ? u[i - 1] : 0.0) - (i + 1 < n ? u[i + 1] : 0.0) - 0.01 +
             rate(i) * u[i] * u[i] * u[i];
    }
  }
  static double rate(Eigen::Index i) { return 1.0 + static_cast<double>(i % 3); }
};

/// The factors of its Jacobian where they were set up last: exact there, the worse the further off.
struct Factors {
  void setup(const Vector& u) {
    const Eigen::Index n = u.size();
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      J(i, i) = 2.0 + 3.0 * Reaction::rate(i) * u[i] * u[i];
      if (i > 0) J(i, i - 1) = J(i - 1, i) = -1.0;
    }
    factors.compute(J);
  }
  void apply(const Vector& r, Vector& z) const { z = factors.solve(r); }
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
};

Report solve_from(double start, PreconditionerSetup when, double setup_cost,
                  jfnk::Method method = jfnk::Method::hybrid) {
  Options options;
  options.method = method;
  options.tolerances.relative = 1e-10;
  options.preconditioner_setup = when;
  options.setup_cost = setup_cost;
  options.learning.enabled = false;
  Vector u = Vector::Constant(60, start);
  const Report report = jfnk::solve(Reaction{}, u, options, Factors{});
  EXPECT_TRUE(report.converged()) << report.reason;
  return report;
}

double cost(const Report& report, double setup_cost) {
  return report.counts.total() + setup_cost * report.counts.preconditioner_setups;
}

TEST(Refresh, PaysForItselfWhereThePreconditionerDecays) {
  constexpr double setup_cost = 10.0;
  for (const double start : {1.0, 10.0}) {
    const Report never = solve_from(start, PreconditionerSetup::at_start, setup_cost);
    const Report chosen = solve_from(start, PreconditionerSetup::when_it_pays, setup_cost);
    EXPECT_EQ(never.counts.preconditioner_setups, 1);
    EXPECT_GT(chosen.counts.preconditioner_setups, 1);
    EXPECT_LT(cost(chosen, setup_cost), cost(never, setup_cost));
  }
}

TEST(Refresh, OfNewtonStepsCostsNoMoreThanNeverOrAlways) {
  for (const double start : {1.0, 10.0}) {
    for (const double setup_cost : {1.0, 3.0, 10.0}) {
      const auto solve = [&](PreconditionerSetup when) {
        return cost(solve_from(start, when, setup_cost, jfnk::Method::newton_krylov), setup_cost);
      };
      const double chosen = solve(PreconditionerSetup::when_it_pays);
      EXPECT_LT(chosen, solve(PreconditionerSetup::at_start)) << start << ", " << setup_cost;
      EXPECT_LT(chosen, solve(PreconditionerSetup::every_newton_step))
          << start << ", " << setup_cost;
    }
  }
}

TEST(Refresh, IsLeftAloneWhereASetupCostsMoreThanTheSolve) {
  for (const double start : {0.01, 1.0, 10.0, 100.0}) {
    const Report chosen = solve_from(start, PreconditionerSetup::when_it_pays, 1e4);
    const Report never = solve_from(start, PreconditionerSetup::at_start, 1e4);
    EXPECT_EQ(chosen.counts.preconditioner_setups, 1);
    EXPECT_EQ(chosen.counts.total(), never.counts.total());
  }
}

TEST(Refresh, ACheapSetupIsMadeNoLessOften) {
  for (const double start : {0.01, 1.0, 10.0, 100.0}) {
    EXPECT_GE(
        solve_from(start, PreconditionerSetup::when_it_pays, 1.0).counts.preconditioner_setups,
        solve_from(start, PreconditionerSetup::when_it_pays, 1e4).counts.preconditioner_setups);
  }
}

}  // namespace

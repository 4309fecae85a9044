#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Method;
using jfnk::Options;
using jfnk::Phase;
using jfnk::Report;
using jfnk::solve;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;
using jfnk_test::CholeskyPreconditioner;
using jfnk_test::PlasticTruss;

/// Totals of a truss of 30 x 30 cells pushed beyond its collapse in 20 steps.
struct Push {
  int failures = 0;
  int evaluations = 0;
  int rescues = 0;
  int yielded = 0;
};

Push push_truss(Options options) {
  constexpr double yield = 1e-3;
  PlasticTruss truss(30, 30, yield);
  const CholeskyPreconditioner P(truss.elastic_stiffness());
  options.tolerances.relative = 1e-3;
  options.jacobian.length_scale = yield;
  options.max_evaluations = 3000;
  options.max_iterations = 3000;
  Solver solver(options);
  Push total;
  Vector u = Vector::Zero(truss.size());
  Vector increment = u;
  for (int step = 1; step <= 20; ++step) {
    truss.push(step * 0.005);
    const Vector before = u;
    u += increment;
    const Report& report = solver.solve(truss, u, P);
    if (!report.converged()) ++total.failures;
    total.evaluations += report.counts.total();
    total.rescues += report.newton_iterations;
    total.yielded = truss.accept(u);
    increment = u - before;
  }
  return total;
}

TEST(Hybrid, RescuesPlasticStepsThatMultisecantAloneCannotSolve) {
  Options alone = jfnk::plasticity();
  alone.method = Method::multisecant;
  const Push multisecant = push_truss(alone);
  const Push hybrid = push_truss(jfnk::plasticity());
  EXPECT_GT(multisecant.failures, 0);
  EXPECT_EQ(hybrid.failures, 0);
  EXPECT_GT(hybrid.rescues, 0);
  EXPECT_GT(hybrid.yielded, 400);  // the steps are plastic: 480 of 3540 bars yield in the last
}

TEST(Hybrid, NeedsFewerEvaluationsThanNewtonOnPlasticity) {
  Options newton = jfnk::plasticity();
  newton.method = Method::newton_krylov;
  const Push alone = push_truss(newton);
  const Push hybrid = push_truss(jfnk::plasticity());
  EXPECT_EQ(alone.failures, 0);
  EXPECT_LT(hybrid.evaluations, alone.evaluations);
}

TEST(Hybrid, FollowsItsScheduleAndThenGivesUp) {
  // No root; the multisecant phases lose patience, Newton creeps to the minimum at 0.
  const auto F = [](const Vector& u, Vector& r) { r = u.array().square() + 1.0; };
  Options options = jfnk::plasticity();
  Vector u = Vector::LinSpaced(4, 0.5, 2.0);
  const Report report = solve(F, u, options);
  EXPECT_FALSE(report.converged());
  int in_a_row = 0;
  for (const auto& line : report.history) {
    in_a_row = line.phase == Phase::newton ? in_a_row + 1 : 0;
    EXPECT_LE(in_a_row, options.hybrid.newton_steps + options.hybrid.final_newton_steps);
  }
  double lowest = report.history.front().residual_norm;
  for (const auto& line : report.history) lowest = std::min(lowest, line.residual_norm);
  EXPECT_EQ(report.residual_norm, lowest);
}

/// Of steps so long that exp(u) overflows even after all cuts.
struct Misleading {
  void apply(const Vector& r, Vector& z) const { z = 1e6 * r; }
};

TEST(Hybrid, TriesARoundWithoutAPreconditionerByWhichNothingFell) {
  const jfnk_test::Bratu bratu(8, 4.0);
  Vector u = Vector::Zero(64);
  Options options;
  options.learning.enabled = false;
  const Report report = solve(bratu, u, options, Misleading{});
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_EQ(report.newton_iterations, 0);
  EXPECT_EQ(report.counts.difference_actions, 1);  // the mixing of the round without it
}

TEST(Multisecant, BroydensUpdatesSpareEvaluationsOnPlasticity) {
  PlasticTruss truss(12, 12, 1e-3, 0.05);
  truss.push(0.02);
  const CholeskyPreconditioner P(truss.elastic_stiffness());
  Options options;
  options.learning.enabled = false;  // of the stiffness given alone
  Vector u = Vector::Zero(truss.size());
  const Report both = solve(truss, u, options, P);
  options.multisecant.broyden = false;
  u.setZero();
  const Report alone = solve(truss, u, options, P);
  ASSERT_TRUE(both.converged());
  ASSERT_TRUE(alone.converged());
  EXPECT_LT(both.counts.total(), alone.counts.total());
}

TEST(Multisecant, PreconditionsEachPointOnce) {
  const jfnk_test::Bratu bratu(16, 6.0);
  const CholeskyPreconditioner P(jfnk_test::laplacian(16));
  Options options;
  options.method = Method::multisecant;
  for (const bool broyden : {false, true}) {
    for (const bool in_its_norm : {false, true}) {
      options.multisecant.broyden = broyden;
      options.multisecant.preconditioned_norm = in_its_norm;
      Vector u = Vector::Zero(256);
      const Report report = solve(bratu, u, options, P);
      ASSERT_TRUE(report.converged());
      EXPECT_GE(report.multisecant_iterations, 4);
      // But the last, where all is done.
      EXPECT_EQ(report.counts.preconditioner, report.multisecant_iterations);
    }
  }
}

TEST(Multisecant, PairsInSinglePrecisionAreGoodForTheFirstDigits) {
  // Without a preconditioner the pairs are so dependent that a step gains three or four digits at
  // most: to 1e-6 it is one evaluation more (25 for 24), to 1e-10 ten.
  const jfnk_test::Bratu bratu(12, 5.0);
  int evaluations[2];
  for (const bool single_precision : {false, true}) {
    Options options;
    options.method = Method::multisecant;
    options.learning.enabled = false;
    options.tolerances.relative = 1e-6;
    options.multisecant.single_precision = single_precision;
    Vector u = Vector::Zero(bratu.size());
    const Report report = solve(bratu, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    evaluations[single_precision ? 1 : 0] = report.counts.total();
  }
  EXPECT_LE(evaluations[1], evaluations[0] + 2);
}

TEST(Multisecant, AnotherPreconditionerLeavesNothingOfTheOneBefore) {
  // So poor a preconditioner that no step is Broyden's: with his updates kept, and the images of P
  // with them, it is the same iteration as without, though P is tripled at each setup.
  struct Growing {
    double scale = 0.01;
    int setups = 0;
    void setup(const Vector&) {
      scale *= 3.0;
      ++setups;
    }
    void apply(const Vector& r, Vector& z) const { z = scale * r; }
  };
  constexpr int n = 20;
  constexpr double rounding = 1e-9;  // of the condition of the pairs, squared, and a little
  std::vector<Vector> points[2];
  for (const std::size_t broyden : {0U, 1U}) {
    Options options;
    options.method = Method::multisecant;
    options.multisecant.broyden = broyden == 1U;
    options.multisecant.max_condition = 100.0;
    options.setup_cost = 1.0;
    options.max_evaluations = 12;
    options.tolerances.relative = 1e-13;
    const auto F = [&](const Vector& u, Vector& r) {
      points[broyden].push_back(u);
      for (int i = 0; i < n; ++i) {
        r[i] = (1.0 + 0.1 * i) * u[i] + 0.1 * u[i] * u[i] + 0.3 * u[(i + 1) % n] - 1.0;
      }
    };
    Growing P;
    Vector u = Vector::Zero(n);
    std::ignore = solve(F, u, options, P);
    EXPECT_GE(P.setups, 2);
  }
  ASSERT_EQ(points[0].size(), points[1].size());
  for (std::size_t i = 0; i < points[0].size(); ++i) {
    EXPECT_LE((points[0][i] - points[1][i]).norm(), rounding * points[0].back().norm()) << i;
  }
}

// With full memory type-II Anderson is GMRES on a linear problem (Walker & Ni 2011), one
// evaluation ahead; n + 1 iterations reach the root.
TEST(Multisecant, SolvesALinearProblemInAtMostNPlusOneIterations) {
  constexpr int n = 12;
  const auto F = [](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      r[i] = (1.0 + 0.1 * i) * u[i] + 0.3 * u[(i + 1) % n] - 1.0;
    }
  };
  Options options;
  options.method = Method::multisecant;
  options.multisecant.scale_mixing = false;
  options.tolerances.relative = 1e-10;
  Vector u = Vector::Zero(n);
  const Report report = solve(F, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_LE(report.multisecant_iterations, n + 1);
  EXPECT_EQ(report.counts.total(), 1 + report.multisecant_iterations);
}

TEST(Multisecant, FirstStepIsThePlainPreconditionedOne) {
  const jfnk_test::Bratu bratu(8, 4.0);
  const CholeskyPreconditioner P(jfnk_test::laplacian(8));
  std::vector<Vector> points;
  const auto F = [&](const Vector& u, Vector& r) {
    points.push_back(u);
    bratu(u, r);
  };
  Options options;
  options.method = Method::multisecant;
  Vector u = Vector::Constant(64, 0.1);
  ASSERT_TRUE(solve(F, u, options, P).converged());
  Vector r(64);
  Vector z(64);
  bratu(points[0], r);
  P.apply(r, z);
  EXPECT_LE((points[1] - (points[0] - z)).norm(), 1e-15 * points[0].norm());
}

TEST(Multisecant, BeatsThePlainPreconditionedIteration) {
  const jfnk_test::Bratu bratu(16, 6.0);
  const CholeskyPreconditioner P(jfnk_test::laplacian(16));
  Options options;
  options.method = Method::multisecant;
  options.tolerances.relative = 1e-8;
  Vector u = Vector::Zero(256);
  const Report with = solve(bratu, u, options, P);
  ASSERT_TRUE(with.converged());
  Vector plain = Vector::Zero(256);
  Vector r(256);
  Vector z(256);
  int evaluations = 0;
  do {
    bratu(plain, r);
    ++evaluations;
    P.apply(r, z);
    plain -= z;
  } while (r.norm() > 1e-8 * with.initial_residual_norm && evaluations < 1000);
  EXPECT_LT(2 * with.counts.total(), evaluations);
}

TEST(Multisecant, LeavesAPointFarAboveTheBest) {
  // Plain steps overshoot by 1e3; the pair of the rejected point still turns the next step.
  const auto F = [](const Vector& u, Vector& r) {
    r = 1000.0 * u + (u.array().cube() - 1.0).matrix();
  };
  Options options;
  options.method = Method::multisecant;
  options.multisecant.scale_mixing = false;
  options.tolerances.relative = 1e-9;
  Vector u = Vector::Zero(3);
  const Report report = solve(F, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.history[1].residual_norm, 30.0 * report.history[0].residual_norm);
  EXPECT_EQ(report.history[1].best_residual_norm, report.history[0].residual_norm);
}

TEST(Multisecant, LosesPatienceAfterTheEvaluationsStated) {
  // |F| cannot fall below 1, which is where it starts.
  const auto F = [](const Vector& u, Vector& r) { r[0] = 1.0 + std::abs(std::sin(u[0])); };
  Options options;
  options.method = Method::multisecant;
  options.multisecant.patience = 7;
  Vector u = Vector::Zero(1);
  const Report report = solve(F, u, options);
  EXPECT_EQ(report.status, Status::multisecant_stalled);
  EXPECT_EQ(report.counts.total(), 1 + 7);
  EXPECT_EQ(u[0], 0.0);
}

TEST(Multisecant, EndsAtItsIterationLimit) {
  const jfnk_test::Bratu bratu(8, 4.0);
  const CholeskyPreconditioner P(jfnk_test::laplacian(8));
  Options options;
  options.method = Method::multisecant;
  options.max_iterations = 2;
  options.tolerances.relative = 1e-12;
  Vector u = Vector::Zero(64);
  const Report report = solve(bratu, u, options, P);
  EXPECT_EQ(report.status, Status::max_iterations);
  EXPECT_EQ(report.multisecant_iterations, 2);
  EXPECT_LT(report.residual_norm, report.initial_residual_norm);
}

TEST(Hybrid, KeepsARoundWithoutThePreconditionerThatCameFar) {
  // Moré, Garbow & Hillstrom's trigonometric function of eight unknowns with the Jacobian at the
  // start as a preconditioner: undone, the round is repeated from further off, at 320 to 364
  // evaluations in all.
  constexpr int bearable = 200;
  const auto F = [](const Vector& u, Vector& r) {
    const double sum = u.array().cos().sum();
    for (int i = 0; i < u.size(); ++i) {
      r[i] = 8.0 - sum + (i + 1) * (1.0 - std::cos(u[i])) - std::sin(u[i]);
    }
  };
  for (const double seed : {11.0, 58.0, 64.0}) {
    Vector u(8);
    for (int i = 0; i < 8; ++i) u[i] = (1.0 + 0.02 * std::sin(seed * (i + 1.0))) / 8.0;
    jfnk::ColouredJacobian jacobian(F, jfnk::banded_sparsity(8, 7, 7));
    jacobian.setup(u);
    const auto P = [&](const Vector& r, Vector& z) { jacobian.apply(r, z); };
    Options options;
    options.learning.enabled = false;
    const Report report = jfnk::solve(F, u, options, P);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_LE(report.counts.total(), bearable);
  }
}

TEST(Hybrid, LeastSquaresInTheNormOfPFAreThoseOfTheResidualPF) {
  // Anderson's iteration on P F without a preconditioner, step by step.
  const jfnk_test::Bratu bratu(6, 5.0);
  const CholeskyPreconditioner P(jfnk_test::laplacian(6));
  const int n = 36;
  constexpr int steps = 8;
  constexpr double rounding = 1e-9;  // of the condition of the pairs, squared, and a little
  Options options;
  options.method = Method::multisecant;
  options.tolerances.relative = 1e-13;
  options.max_evaluations = steps + 1;
  options.multisecant.broyden = false;
  options.multisecant.scale_mixing = false;
  std::vector<Vector> one;
  std::vector<Vector> other;
  const Vector start = Vector::LinSpaced(n, 0.0, 3.0);
  const auto image = [&](const Vector& u, Vector& r) {
    other.push_back(u);
    Vector f(n);
    bratu(u, f);
    P.apply(f, r);
  };
  Vector u = start;
  std::ignore = jfnk::solve(image, u, options);
  options.multisecant.preconditioned_norm = true;
  const auto F = [&](const Vector& v, Vector& r) {
    one.push_back(v);
    bratu(v, r);
  };
  u = start;
  const Report report = jfnk::solve(F, u, options, P);
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_LT((one[i] - other[i]).norm(), rounding * start.norm()) << i;
  }
  // One at each point.
  EXPECT_EQ(report.counts.preconditioner, steps + 1);
  // The default is another iteration.
  options.multisecant.preconditioned_norm = false;
  one.clear();
  u = start;
  std::ignore = jfnk::solve(F, u, options, P);
  EXPECT_GT((one.back() - other.back()).norm(), 1e3 * rounding * start.norm());
}

TEST(Hybrid, LeastSquaresInTheNormOfPFSurviveNewPreconditioners) {
  const jfnk_test::Bratu bratu(12, 6.5);
  for (const bool broyden : {false, true}) {
    Options options;
    options.multisecant.preconditioned_norm = true;
    options.multisecant.broyden = broyden;
    options.tolerances.relative = 1e-10;
    options.setup_cost = 0.0;
    jfnk::ColouredJacobian jacobian(bratu, jfnk_test::laplacian(12));
    Vector u = Vector::Zero(144);
    const Report report = jfnk::solve(bratu, u, options, jacobian);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_GT(report.counts.preconditioner_setups, 1);
  }
}

}  // namespace

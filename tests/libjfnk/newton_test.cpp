#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Forcing;
using jfnk::Options;
using jfnk::Phase;
using jfnk::Report;
using jfnk::solve;
using jfnk::Status;
using jfnk::Vector;

/// Order from three successive residuals: log(r2/r1) / log(r1/r0).
double observed_order(const Report& report, std::size_t last) {
  const auto& h = report.history;
  return std::log(h[last].residual_norm / h[last - 1].residual_norm) /
         std::log(h[last - 1].residual_norm / h[last - 2].residual_norm);
}

TEST(Newton, LinearProblemTakesOneStepOfTheAccuracyAsked) {
  const auto F = [](const Vector& u, Vector& r) {
    r = jfnk_test::laplacian(4) * u;
    r.array() -= 1.0;
  };
  Options options = jfnk::newton_krylov();
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 1e-7;
  Vector u = Vector::Zero(16);
  const Report report = solve(F, u, options);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.newton_iterations, 1);
  EXPECT_EQ(report.counts.newton_trials, 1);
  EXPECT_EQ(report.counts.line_search, 0);
}

TEST(Newton, ConvergesQuadraticallyWithAccurateDirections) {
  jfnk_test::BratuWithJacobian bratu(16, 6.0);
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(16));
  Options options = jfnk::newton_krylov();
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 1e-10;
  options.krylov.forcing.end_game = 0.0;
  options.tolerances.relative = 1e-12;
  Vector u = Vector::Zero(bratu.size());
  const Report report = solve(bratu, u, options, P);
  ASSERT_TRUE(report.converged());
  ASSERT_GE(report.history.size(), 4u);
  // The third step starts from about 1e-3 and ends above round-off, where the order shows.
  EXPECT_NEAR(observed_order(report, 3), 2.0, 0.25);
}

TEST(Newton, ConstantForcingConvergesLinearlyAtItsRate) {
  jfnk_test::BratuWithJacobian bratu(16, 6.0);
  Options options = jfnk::newton_krylov();
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 0.1;
  options.tolerances.relative = 1e-8;
  Vector u = Vector::Zero(bratu.size());
  const Report report = solve(bratu, u, options);
  ASSERT_TRUE(report.converged());
  for (const auto& line : report.history) {
    if (line.phase != Phase::newton) continue;
    EXPECT_LE(line.linear_residual, line.forcing);
    EXPECT_GE(line.forcing, 0.1);
  }
  EXPECT_GE(report.newton_iterations, 7);
}

TEST(Newton, EisenstatWalkerSavesActionsAgainstTightForcing) {
  jfnk_test::BratuWithJacobian bratu(24, 6.0);
  Options tight = jfnk::newton_krylov();
  tight.krylov.forcing.rule = Forcing::Rule::constant;
  tight.krylov.forcing.initial = 1e-6;
  tight.krylov.forcing.end_game = 0.0;
  Vector u = Vector::Zero(bratu.size());
  const Report exact = solve(bratu, u, tight);
  u.setZero();
  const Report inexact = solve(bratu, u, jfnk::newton_krylov());
  ASSERT_TRUE(exact.converged());
  ASSERT_TRUE(inexact.converged());
  EXPECT_LT(inexact.counts.total(), exact.counts.total());
}

TEST(Newton, LaplacianMakesKrylovIterationsIndependentOfTheMesh) {
  int coarse = 0;
  for (const int m : {16, 32, 64}) {
    const jfnk_test::Bratu bratu(m, 6.0);
    const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(m));
    Vector u = Vector::Zero(bratu.size());
    const Report report = solve(bratu, u, jfnk::newton_krylov(), P);
    ASSERT_TRUE(report.converged());
    if (m == 16) coarse = report.krylov_iterations;
    EXPECT_LE(report.krylov_iterations, coarse + 2) << m;
  }
}

TEST(Newton, DifferencesAndExactActionsFindTheSameBratuSolution) {
  jfnk_test::BratuWithJacobian exact(20, 6.0);
  const jfnk_test::Bratu differences(20, 6.0);
  Options options = jfnk::newton_krylov();
  options.tolerances.relative = 1e-10;
  Vector a = Vector::Zero(exact.size());
  Vector b = a;
  ASSERT_TRUE(solve(exact, a, options).converged());
  ASSERT_TRUE(solve(differences, b, options).converged());
  // ||J^{-1}|| <= 1 / (smallest eigenvalue of the scaled Laplacian, 2 pi^2 h^2, less lambda e^u).
  EXPECT_LE((a - b).norm(), 1e-6 * a.norm());
}

// Sum over the midpoint weights: a = 1 + c a^2 / 4 holds for the discrete H exactly.
TEST(Newton, HEquationHasItsKnownMean) {
  for (const double c : {0.5, 0.9, 0.999}) {
    const jfnk_test::HEquation F(100, c);
    Options options = jfnk::newton_krylov();
    options.tolerances.relative = 1e-11;
    Vector u = Vector::Ones(F.size());
    const Report report = solve(F, u, options);
    ASSERT_TRUE(report.converged()) << report.reason;
    EXPECT_NEAR(u.mean(), 2.0 / c * (1.0 - std::sqrt(1.0 - c)), 1e-7) << c;
  }
}

TEST(Newton, HEquationConvergesToItsDoubleRoot) {
  const jfnk_test::HEquation F(100, 1.0);
  Vector u = Vector::Ones(F.size());
  Options options = jfnk::newton_krylov();
  options.tolerances.relative = 1e-8;
  const Report report = solve(F, u, options);
  ASSERT_TRUE(report.converged()) << report.reason;
  // At a double root ||F|| ~ error^2: 1e-8 of ||F0|| of order 10 leaves 1e-3.
  EXPECT_NEAR(u.mean(), 2.0, 1e-3);
}

TEST(Newton, SolvesRosenbrockFromTheStandardStart) {
  for (const int n : {2, 100}) {
    Vector u(n);
    for (int i = 0; i < n; i += 2) {
      u[i] = -1.2;
      u[i + 1] = 1.0;
    }
    Options options = jfnk::newton_krylov();
    options.tolerances.relative = 1e-8;
    const Report report = solve(jfnk_test::Rosenbrock{}, u, options);
    ASSERT_TRUE(report.converged()) << report.reason;
    EXPECT_LE((u.array() - 1.0).matrix().norm(), 1e-5 * std::sqrt(n));
  }
}

TEST(Newton, SolvesPowellSingularDespiteTheRankDeficientRoot) {
  Vector u(4);
  u << 3, -1, 0, 1;
  const Report report = solve(jfnk_test::PowellSingular{}, u);
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_LE(u.norm(), 0.1);  // ||F|| ~ ||u||^2 near the root: 1e-6 * 15 leaves 4e-3 and a factor
}

// Directions of forcing 0.3 zigzag in the valley u0 u1 = 1e-4; accurate ones follow it.
TEST(Newton, SolvesPowellBadlyScaledWithTightForcing) {
  const auto F = [](const Vector& u, Vector& r) {
    r[0] = 1e4 * u[0] * u[1] - 1.0;
    r[1] = std::exp(-u[0]) + std::exp(-u[1]) - 1.0001;
  };
  Vector u(2);
  u << 0, 1;
  Options options = jfnk::newton_krylov();
  options.tolerances.relative = 1e-10;
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 1e-6;
  const Report report = solve(F, u, options);
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_NEAR(u[0] * 1e5, 1.098159, 1e-4);  // More, Garbow & Hillstrom 1981, no. 3
  EXPECT_NEAR(u[1], 9.106146, 1e-4);
}

TEST(Newton, SolvesBroydenTridiagonal) {
  const auto F = [](const Vector& u, Vector& r) {
    const Eigen::Index n = u.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = (3.0 - 2.0 * u[i]) * u[i] + 1.0;
      if (i > 0) r[i] -= u[i - 1];
      if (i + 1 < n) r[i] -= 2.0 * u[i + 1];
    }
  };
  Vector u = Vector::Constant(200, -1.0);
  Options options = jfnk::newton_krylov();
  options.tolerances.relative = 1e-9;
  const Report report = solve(F, u, options);
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_NEAR(u[100], -std::sqrt(0.5), 1e-6);  // away from the ends (3 - 2u)u + 1 = 3u
}

TEST(Newton, ExactRootAtTheStartCostsOneEvaluation) {
  Vector u = Vector::Ones(6);
  const Report report = solve(jfnk_test::Rosenbrock{}, u);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.counts.total(), 1);
  EXPECT_EQ(report.residual_norm, 0.0);
  EXPECT_EQ(report.newton_iterations, 0);
}

TEST(Newton, ConstantResidualEndsWithoutADirection) {
  Vector u = Vector::Zero(3);
  const Report report = solve([](const Vector&, Vector& r) { r.setOnes(); }, u);
  EXPECT_EQ(report.status, Status::krylov_stalled);
  EXPECT_EQ(u.norm(), 0.0);
}

TEST(Newton, InconsistentSystemIsNeverASuccess) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array().square() + 1.0; };
  for (const auto method :
       {jfnk::Method::newton_krylov, jfnk::Method::multisecant, jfnk::Method::hybrid}) {
    Options options = jfnk::newton_krylov();
    options.method = method;
    options.max_evaluations = 2000;
    Vector u = Vector::Constant(5, 1.7);
    const Report report = solve(F, u, options);
    EXPECT_FALSE(report.converged());
    EXPECT_GE(report.residual_norm, std::sqrt(5.0));
  }
}

TEST(Newton, PowerOfTwoUnitsOfTheResidualChangeNoBit) {
  const jfnk_test::Bratu bratu(10, 5.0);
  Vector reference = Vector::Zero(bratu.size());
  const Report plain = solve(bratu, reference);
  for (const int exponent : {-200, 200}) {
    const auto F = [&](const Vector& u, Vector& r) {
      bratu(u, r);
      r *= std::ldexp(1.0, exponent);
    };
    Vector u = Vector::Zero(bratu.size());
    const Report report = solve(F, u);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_EQ(report.counts.total(), plain.counts.total());
    EXPECT_TRUE((u.array() == reference.array()).all());
  }
}

TEST(Newton, SolvesInUnitsWhoseSquaresOverflow) {
  const jfnk_test::Bratu bratu(10, 5.0);
  for (const double unit : {1e-250, 1e250}) {
    const auto F = [&](const Vector& u, Vector& r) {
      bratu(u, r);
      r *= unit;
    };
    Vector u = Vector::Zero(bratu.size());
    EXPECT_TRUE(solve(F, u).converged());
    Vector r(bratu.size());
    bratu(u, r);
    const double start = 5.0 / (11.0 * 11.0) * 10.0;  // ||F(0)||
    EXPECT_LE(r.norm(), 1e-6 * start * (1.0 + 1e-9));
  }
}

TEST(Newton, SolvesOneUnknownAndAHundredThousand) {
  for (const int n : {1, 100000}) {
    Vector u = Vector::Zero(n);
    const Report report =
        solve([](const Vector& v, Vector& r) { r = v.array() + v.array().cube() - 2.0; }, u);
    ASSERT_TRUE(report.converged());
    EXPECT_NEAR(u[n - 1], 1.0, 1e-5);
  }
}

}  // namespace

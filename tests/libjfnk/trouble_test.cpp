#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Globalisation;
using jfnk::Method;
using jfnk::Options;
using jfnk::Phase;
using jfnk::Report;
using jfnk::solve;
using jfnk::Status;
using jfnk::Vector;
using jfnk_test::all_methods;

bool was_in(const Report& report, Phase phase) {
  for (const auto& line : report.history) {
    if (line.phase == phase) return true;
  }
  return false;
}

double scatter(double u) {
  auto z = std::bit_cast<std::uint64_t>(u);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return 2.0 * static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53 - 1.0;
}

TEST(Noise, IsMeasuredOnTroubleAndOvercome) {
  constexpr double level = 1e-6;
  const auto F = [](const Vector& u, Vector& r) {
    const Eigen::Index n = u.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = (3.0 - 2.0 * u[i]) * u[i] + 1.0 + level * scatter(u[i]);
      if (i > 0) r[i] -= u[i - 1];
      if (i + 1 < n) r[i] -= 2.0 * u[i + 1];
    }
  };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Options options;
    options.method = method;
    options.tolerances.relative = 1e-4;
    Vector u = Vector::Constant(50, -1.0);
    const Report report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_GT(report.counts.noise, 0);
    const double expected = level / std::sqrt(3.0) * std::sqrt(50.0);
    EXPECT_GT(report.measured_noise, expected / 4.0);
    EXPECT_LT(report.measured_noise, expected * 4.0);
  }
}

TEST(Noise, IsNotSoughtWhereNothingIsWrong) {
  const jfnk_test::Bratu bratu(12, 6.0);
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Vector u = Vector::Zero(bratu.size());
    EXPECT_EQ(solve(bratu, u, options).counts.noise, 0);
  }
}

// The discrete path: ||b - A x|| and ||x|| along it are those of the formula, from 0 to the
// solution.
TEST(Dogleg, PathHasTheLengthAskedAndTheResidualStated) {
  const jfnk_test::Sparse A = jfnk_test::laplacian(6);
  const Vector b = Vector::LinSpaced(36, -1.0, 2.0);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  jfnk::GmresOptions options;
  options.relative_tolerance = 1e-2;
  jfnk::Gmres gmres;
  Vector x = Vector::Zero(36);
  (void)gmres.solve(jfnk::OperatorRef(op), b, x, options);
  ASSERT_TRUE(gmres.can_shorten());
  EXPECT_NEAR(gmres.length(), x.norm(), 1e-12 * x.norm());
  double last = b.norm();
  for (const double part : {1e-3, 0.1, 0.3, 0.6, 0.9, 1.0}) {
    Vector shorter(36);
    const double residual = gmres.shorten(part * gmres.length(), {}, shorter);
    EXPECT_NEAR(shorter.norm(), part * x.norm(), 1e-10 * x.norm());
    EXPECT_NEAR((b - A * shorter).norm(), residual, 1e-10 * b.norm());
    EXPECT_LT(residual, last);
    last = residual;
  }
}

TEST(Dogleg, HandsOutTheSpaceAsOrthogonalFactors) {
  const jfnk_test::Sparse A = jfnk_test::laplacian(5);
  const Vector b = Vector::LinSpaced(25, -1.0, 2.0);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  const jfnk_test::CholeskyPreconditioner exact(jfnk_test::laplacian(5));
  struct Half {
    void apply(const Vector& r, Vector& z) const { z = 0.5 * r; }
  } half;
  for (const bool preconditioned : {false, true}) {
    const jfnk::PreconditionerRef P =
        preconditioned ? jfnk::PreconditionerRef(half) : jfnk::PreconditionerRef{};
    jfnk::GmresOptions options;
    options.max_iterations = 8;
    options.relative_tolerance = 1e-12;
    jfnk::Gmres gmres;
    Vector x = Vector::Zero(25);
    (void)gmres.solve(jfnk::OperatorRef(op), b, x, options, P);
    std::vector<Vector> qs;
    gmres.hand_out_space(P, [&](const Vector& z, const auto& up_to_q, const auto& r) {
      Vector last = Vector::Zero(static_cast<Eigen::Index>(up_to_q.size()));
      last[last.size() - 1] = 1.0;
      Vector q(25);
      up_to_q.combine({}, 0.0, last.data(), q);
      qs.push_back(q);
      Vector image = A * z;
      for (std::size_t j = 0; j < qs.size(); ++j) {
        image -= r[static_cast<Eigen::Index>(j)] * qs[j];
        EXPECT_NEAR(qs[j].dot(q), &qs[j] == &qs.back() ? 1.0 : 0.0, 1e-12);
      }
      EXPECT_LE(image.norm(), 1e-12);
      return true;
    });
    EXPECT_EQ(qs.size(), 8u);
  }
}

TEST(Globalisation, EveryRuleSolvesTheValley) {
  for (const auto rule : {Globalisation::Rule::backtracking, Globalisation::Rule::parabola,
                          Globalisation::Rule::dogleg}) {
    for (const int window : {1, 5}) {
      Options options = jfnk::newton_krylov();
      options.globalisation.rule = rule;
      options.globalisation.window = window;
      Vector u(2);
      u << -1.2, 1.0;
      const Report report = solve(jfnk_test::Rosenbrock{}, u, options);
      EXPECT_TRUE(report.converged()) << report.reason;
      EXPECT_NEAR(u[0], 1.0, 1e-4);
      if (window > 1) continue;
      for (std::size_t i = 1; i < report.history.size(); ++i) {
        EXPECT_LT(report.history[i].residual_norm, report.history[i - 1].residual_norm);
      }
    }
  }
}

// -Laplace(u) = 6 e^u with a preconditioner that points the wrong way: it is dropped.
TEST(Rescue, GoesOnWithoutAPreconditionerThatMisleads) {
  struct Misleading {
    void apply(const Vector& r, Vector& z) const {
      z = r.reverse();
      z[0] = 1e8 * r[0];
    }
  };
  const jfnk_test::Bratu bratu(8, 5.0);
  Vector u = Vector::Zero(64);
  Options options;
  options.krylov.max_iterations = 10;
  const Report report = solve(bratu, u, options, Misleading{});
  EXPECT_TRUE(report.converged()) << report.reason;
}

// Full Newton steps of atan diverge from 3; the flow du/dt = -F does not.
TEST(Rescue, PseudoTransientStepsReachARootWhereNewtonHasNoStep) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array().atan(); };
  Options options = jfnk::newton_krylov();
  options.globalisation.max_cuts = 0;
  options.stagnation.restart = false;
  options.pseudo_transient.enabled = false;
  Vector u = Vector::Constant(3, 3.0);
  EXPECT_EQ(solve(F, u, options).status, Status::line_search_failed);
  options.pseudo_transient.enabled = true;
  u.setConstant(3.0);
  const Report report = solve(F, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_TRUE(was_in(report, Phase::pseudo_transient));
  EXPECT_GT(report.counts.pseudo_transient, 0);
  EXPECT_LE(u.cwiseAbs().maxCoeff(), 1e-5);
}

}  // namespace

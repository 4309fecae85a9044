// What a solve that cannot succeed says of it: the ending, the advice, and what it costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Method;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Status;
using jfnk::Trouble;
using jfnk::Vector;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool says(const Report& report, const char* words) {
  return report.reason.find(words) != std::string::npos;
}

Options by(Method method) {
  Options options;
  options.method = method;
  return options;
}

double scatter(double u) {
  auto z = std::bit_cast<std::uint64_t>(u);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return 2.0 * static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53 - 1.0;
}

// Evaluations that a hopeless solve may take: those down to the floor, and two dozen to see that.
constexpr int soon = 100;

TEST(Endings, AToleranceBelowTheRoundingOfFAsksForAnAbsoluteOne) {
  const jfnk_test::Bratu bratu(12, 6.0);
  Options options;
  options.tolerances.relative = 1e-17;
  Vector u = Vector::Zero(bratu.size());
  Report report = solve(bratu, u, options);
  EXPECT_EQ(report.status, Status::noise_floor) << report.reason;
  EXPECT_TRUE(says(report, "give tolerances.absolute")) << report.reason;
  EXPECT_LT(report.counts.total(), soon);
  EXPECT_LT(report.residual_norm, 1e-14);
  // What is advised works.
  options.tolerances.absolute = 2.0 * std::max(report.measured_noise, report.residual_norm);
  u.setZero();
  report = solve(bratu, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
}

TEST(Endings, AToleranceBelowTheNoiseOfFAsksForAnAbsoluteOne) {
  // Not 1e-7: there the products drown, and a Krylov space is spent before that is seen.
  for (const double level : {1e-4, 1e-5, 1e-8, 1e-10}) {
    const auto F = [&](const Vector& u, Vector& r) {
      const Eigen::Index n = u.size();
      for (Eigen::Index i = 0; i < n; ++i) {
        r[i] = (3.0 - 2.0 * u[i]) * u[i] + 1.0 + level * scatter(u[i]);
        if (i > 0) r[i] -= u[i - 1];
        if (i + 1 < n) r[i] -= 2.0 * u[i + 1];
      }
    };
    Options options;
    options.tolerances.relative = 1e-3 * level;
    Vector u = Vector::Constant(50, -1.0);
    const Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::noise_floor) << report.reason;
    EXPECT_TRUE(says(report, "give tolerances.absolute")) << report.reason;
    EXPECT_LT(report.counts.total(), soon);
    const double expected = level / std::sqrt(3.0) * std::sqrt(50.0);
    EXPECT_LT(report.residual_norm, 4.0 * expected);
  }
}

// Far from u, F is large, and so is its rounding: that is not the noise of F at u.
TEST(Endings, TheRoundingOfLargerValuesIsNotTakenForNoise) {
  const auto F = [](const Vector& u, Vector& r) { r = 1e30 * (u.array().square() - 2e-60); };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Vector u = Vector::Constant(5, 1e-30);
    const Report report = solve(F, u, by(method));
    EXPECT_NE(report.status, Status::noise_floor) << report.reason;
  }
}

TEST(Endings, ALinearSolveThatHitItsCapAsksForMoreProducts) {
  // J shifts: GMRES lowers nothing before its n-th product.
  constexpr int n = 300;
  const auto F = [](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) r[i] = u[(i + 1) % n];
    r[0] -= 1.0;
  };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Options options = by(method);
    options.learning.enabled = false;
    Vector u = Vector::Zero(n);
    Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::krylov_stalled) << report.reason;
    EXPECT_EQ(report.trouble, Trouble::krylov_capped);
    EXPECT_TRUE(says(report, "krylov.max_iterations: raise it")) << report.reason;
    options.krylov.max_iterations = n;
    options.krylov.restart = n;
    u.setZero();
    report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
  }
}

TEST(Endings, AMinimumThatIsNoRootIsCalledOne) {
  const auto square = [](const Vector& u, Vector& r) { r = u.array().square() + 1.0; };
  const auto cosh = [](const Vector& u, Vector& r) { r = u.array().cosh(); };
  const auto kink = [](const Vector& u, Vector& r) { r = u.array().abs() + 1.0; };
  const auto check = [&](auto&& F, double start, const Options& options) {
    Vector u = Vector::Constant(2, start);
    const Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::local_minimum) << start << ": " << report.reason;
    EXPECT_TRUE(says(report, "start from another point")) << report.reason;
    EXPECT_FALSE(says(report, "Jacobian action")) << report.reason;
  };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    for (const double start : {0.3, 3.0, 100.0}) check(square, start, by(method));
    check(cosh, 1.0, by(method));
    check(kink, 1.0, by(method));
    const jfnk_test::Bratu beyond_the_fold(10, 8.0);
    Vector u = Vector::Zero(beyond_the_fold.size());
    const Report report = solve(beyond_the_fold, u, by(method));
    EXPECT_EQ(report.status, Status::local_minimum) << report.reason;
  }
}

TEST(Endings, AWrongJacobianActionIsBlamed) {
  struct Wrong {
    Vector at;
    void operator()(const Vector& u, Vector& r) const { r = u.array().cube() - 2.0; }
    void linearise(const Vector& u) { at = u; }
    void apply_jacobian(const Vector& v, Vector& Jv) const {
      Jv = -3.0 * at.array().square() * v.array();
    }
  } F;
  Vector u = Vector::Constant(4, 1.0);
  const Report report = solve(F, u, by(Method::newton_krylov));
  EXPECT_EQ(report.status, Status::line_search_failed) << report.reason;
  EXPECT_EQ(report.trouble, Trouble::broken_promise);
  EXPECT_TRUE(says(report, "check the Jacobian action")) << report.reason;
}

TEST(Endings, TheEndOfTheDomainIsNamedAndNotCrawledTo) {
  const auto F = [](const Vector& u, Vector& r) { r[0] = u[0] > 0.0 ? u[0] + 1.0 : nan; };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Options options = by(method);
    options.max_iterations = 500;
    Vector u = Vector::Ones(1);
    const Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::line_search_failed) << report.reason;
    EXPECT_EQ(report.trouble, Trouble::domain_edge);
    EXPECT_TRUE(says(report, "the end of its domain")) << report.reason;
    // Not by hundreds of steps that change nothing.
    int idle = 0;
    for (std::size_t i = 1; i < report.history.size(); ++i) {
      const double before = report.history[i - 1].residual_norm;
      if (std::abs(report.history[i].residual_norm - before) < 1e-12 * before) ++idle;
    }
    EXPECT_LE(idle, 8);
  }
}

TEST(Endings, StepsShorterThanTheRoundingOfUEndAlsoWithoutStagnationRules) {
  const jfnk_test::Bratu bratu(12, 6.0);
  Options options = jfnk::appendix_a(1e-17, 1e-17);
  options.max_iterations = 500;
  Vector u = Vector::Zero(bratu.size());
  const Report report = solve(bratu, u, options);
  EXPECT_FALSE(report.converged());
  EXPECT_LT(report.newton_iterations, 20) << report.reason;
}

TEST(Endings, AConstantFIsFoundOutAtOnce) {
  const auto F = [](const Vector&, Vector& r) { r.setConstant(3.0); };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    for (const int n : {1, 50}) {
      Vector u = Vector::Ones(n);
      const Report report = solve(F, u, by(method));
      EXPECT_EQ(report.status, Status::krylov_stalled);
      EXPECT_EQ(report.trouble, Trouble::flat);
      EXPECT_TRUE(says(report, "does not change with u")) << report.reason;
      EXPECT_LT(report.counts.total(), 30);
    }
  }
}

TEST(Endings, UnknownsFarApartAreAHintAtScales) {
  constexpr int n = 20;
  Vector size(n);
  for (int i = 0; i < n; ++i) size[i] = std::pow(10.0, -8.0 + 16.0 * i / (n - 1));
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double x = u[i] / size[i];
      r[i] = x * x * x - (i > 0 ? u[i - 1] / size[i - 1] : 1.0);
    }
  };
  Options options;
  Vector u = 1.5 * size;
  Report report = solve(F, u, options);
  ASSERT_FALSE(report.converged());
  EXPECT_TRUE(says(report, "12 decades apart: give u_scale")) << report.reason;
  options.u_scale = size;
  u = 1.5 * size;
  report = solve(F, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
}

TEST(Endings, UnknownsFarFromOneAreAHintAtScales) {
  const double size = 1e-12;
  const auto F = [size](const Vector& u, Vector& r) {
    r = (u.array() / size).square() - 2.0;
    r.tail(3) -= 0.1 / size * u.head(3);
  };
  Options options = by(Method::newton_krylov);
  Vector u = Vector::Constant(4, size);
  const Report report = solve(F, u, options);
  ASSERT_FALSE(report.converged());
  EXPECT_TRUE(says(report, "of the first u are of 1e-12: give u_scale")) << report.reason;
  options.u_scale = Vector::Constant(4, size);
  u = Vector::Constant(4, size);
  EXPECT_TRUE(solve(F, u, options).converged());
}

// Over the length of a difference, 1.5e-8, floats do not change.
TEST(Endings, ASinglePrecisionResidualIsKnownForOne) {
  const auto F = [](const Vector& u, Vector& r) {
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const auto x = static_cast<float>(u[i]);
      const float before = i > 0 ? static_cast<float>(u[i - 1]) : 0.0F;
      r[i] = static_cast<double>(x * x * x - 2.0F + 0.3F * before);
    }
  };
  for (const Method method : {Method::hybrid, Method::newton_krylov}) {
    Options options = by(method);
    options.tolerances.relative = 1e-5;  // ten times the rounding of one value
    Vector u = Vector::Ones(50);
    const Report coarse = solve(F, u, options);
    EXPECT_TRUE(coarse.converged()) << coarse.reason;
    options.tolerances.relative = 1e-8;
    u = Vector::Ones(50);
    const Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::noise_floor) << report.reason;
    // The rounding unit of floats, 6e-8, of values up to 2.
    EXPECT_LT(report.residual_norm, std::sqrt(50.0) * 1e-6);
    EXPECT_LT(report.counts.total(), 100);
  }
}

// The helical valley, begun on the cut of its angle: to ask for no less than the jump would make
// a root of the first point.
TEST(Endings, AJumpAsLargeAsTheResidualIsNoNoiseToStopAt) {
  const auto F = [](const Vector& u, Vector& r) {
    constexpr double turn = 6.283185307179586;
    r[0] = 10.0 * (u[2] - 10.0 * std::atan2(u[1], u[0]) / turn);
    r[1] = 10.0 * (std::hypot(u[0], u[1]) - 1.0);
    r[2] = u[2];
  };
  for (const Method method : {Method::hybrid, Method::newton_krylov}) {
    Vector u(3);
    u << -1.0, 0.0, 0.0;
    const Report report = solve(F, u, by(method));
    ASSERT_FALSE(report.converged());
    EXPECT_TRUE(says(report, "F jumps near u")) << report.reason;
    EXPECT_FALSE(says(report, "give tolerances.absolute")) << report.reason;
  }
}

struct Rootless {
  const char* name;
  Vector start;
  std::function<void(const Vector&, Vector&)> F;
  double lowest;  // ||F|| at its minimum, divided by sqrt(n)
};

/// Smooth systems without a root: alone, side by side, coupled, turned.
std::vector<Rootless> rootless() {
  const auto above = [](double floor) {
    return [floor](const Vector& u, Vector& r) { r = u.array().square() + floor; };
  };
  // f1 = a^2 + 1/2 and f2 = b - a of turned unknowns, turned again; sqrt(2) is of the mean over n.
  const auto turned = [](const Vector& u, Vector& r) {
    const double c = std::cos(0.5);
    const double s = std::sin(0.5);
    const double a = c * u[0] + s * u[1];
    const double b = c * u[1] - s * u[0];
    const double f1 = a * a + 0.5;
    const double f2 = b - a;
    r[0] = c * f1 - s * f2;
    r[1] = s * f1 + c * f2;
  };
  const auto sum_of_squares = [](const Vector& u, Vector& r) {
    r[0] = u.squaredNorm() + 1.0;
    for (int i = 1; i < u.size(); ++i) r[i] = u[i] - 0.5 * u[i - 1];
  };
  const auto pair = [](double x, double y) { return Vector(Eigen::Vector2d(x, y)); };
  return {{"scalar", Vector::Constant(1, 1.3), above(1.0), 1.0},
          {"scalar from afar", Vector::Constant(1, 100.0), above(1.0), 1.0},
          {"scalar, low", Vector::Constant(1, 3.0), above(1e-2), 1e-2},
          {"five alike", Vector::Constant(5, 1.3), above(1.0), 1.0},
          {"turned parabola", pair(2.0, 1.0), turned, 0.5 / std::sqrt(2.0)},
          {"sum of squares", pair(0.5, 3.0), sum_of_squares, 1.0 / std::sqrt(2.0)}};
}

TEST(Endings, AStationaryPointThatIsNoRootIsTheEnd) {
  // What the search for it needs is what is seen in the history; the end is then known after the
  // patience of a multisecant round (20), the table of noise (8), three Newton steps of n products
  // and a trial, and one more with all of its cuts (20) in vain. Another search from the start,
  // which took as many again as the first, is not made.
  constexpr int patience = 20 + 8 + 20;
  constexpr int steps = 3;
  constexpr double near = 1.01;
  for (const Rootless& problem : rootless()) {
    for (const Options& options : {jfnk::hybrid(), jfnk::newton_krylov()}) {
      Vector u = problem.start;
      const Report report = jfnk::solve(problem.F, u, options);
      const double lowest = problem.lowest * std::sqrt(static_cast<double>(u.size()));
      EXPECT_EQ(report.status, Status::local_minimum) << problem.name << ": " << report.reason;
      EXPECT_EQ(report.trouble, Trouble::minimum) << problem.name;
      EXPECT_TRUE(says(report, "stationary point of ||F|| that is no root")) << report.reason;
      // Within 1e-4, the part of ||F|| that counts as nothing.
      EXPECT_NEAR(report.residual_norm, lowest, 1e-4 * lowest) << problem.name;
      const auto found = std::ranges::find_if(
          report.history, [&](const auto& line) { return line.residual_norm <= near * lowest; });
      ASSERT_NE(found, report.history.end()) << problem.name;
      const int to_be_sure = patience + steps * (static_cast<int>(u.size()) + 1);
      EXPECT_LE(report.counts.total(), found->evaluations + to_be_sure) << problem.name;
    }
  }
}

TEST(Endings, AFlowThatRunsAwayIsLeft) {
  // u' = -F(u) with F > 0 goes to minus infinity, where F grows, too.
  const auto F = [](const Vector& u, Vector& r) { r = u.array().square() + 1.0; };
  // From so near its minimum that this may be a maximum of ||F||, as far as the search can tell.
  Options options = jfnk::newton_krylov();
  options.stagnation.restart = false;
  Vector u = Vector::Constant(1, 0.2);
  const Report report = jfnk::solve(F, u, options);
  EXPECT_EQ(report.status, Status::local_minimum) << report.reason;
  // Each step multiplies ||F|| by 1.3 or more, up to a thousand: ln 1000 / ln 1.3 = 27.
  EXPECT_GT(report.pseudo_transient_steps, 0);
  EXPECT_LE(report.pseudo_transient_steps, 27);
}

}  // namespace

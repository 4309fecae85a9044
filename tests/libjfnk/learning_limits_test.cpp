#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "learning.hpp"
#include "problems.hpp"

// Where learning the Jacobian must not be tried or trusted, and what it must respect.
namespace {

using jfnk::Evaluation;
using jfnk::Options;
using jfnk::Report;
using jfnk::Vector;
using jfnk_test::Bratu;
using jfnk_test::solve_from;
using jfnk_test::Sparse;
using jfnk_test::without_learning;

TEST(Learning, RespectsScalesAndBounds) {
  const int m = 20;
  const Bratu bratu(m, 6.0);
  Vector rows(m * m);
  Vector columns(m * m);
  for (int i = 0; i < m * m; ++i) {
    rows[i] = std::pow(10.0, i % 9 - 4);
    columns[i] = std::pow(10.0, i % 7 - 3);
  }
  Vector outermost = Vector::Zero(m * m);
  const auto F = [&](const Vector& u, Vector& r) {
    outermost = outermost.cwiseMax(u);
    bratu(u.cwiseQuotient(columns), r);
    r.array() *= rows.array();
  };
  Options options;
  options.u_scale = columns;
  options.f_scale = rows;
  options.upper = 2.0 * columns;
  const Report report = solve_from(F, Vector::Zero(m * m), options);
  const Report unscaled = solve_from(bratu, Vector::Zero(m * m), Options{});
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LE(std::abs(report.counts.total() - unscaled.counts.total()), 3);
  EXPECT_TRUE((outermost.array() <= options.upper.array()).all());
}

TEST(Learning, IsNotTriedWhereItIsNotAskedFor) {
  const Bratu bratu(24, 6.0);
  const auto learning = [&](const Options& options) {
    return solve_from(bratu, Vector::Zero(24 * 24), options).counts.learning;
  };
  EXPECT_EQ(learning(without_learning()), 0);
  EXPECT_EQ(learning(jfnk::newton_krylov()), 0);
  EXPECT_EQ(learning(jfnk::plasticity()), 0);
  Options options;
  options.learning.least_unknowns = 24 * 24 + 1;
  EXPECT_EQ(learning(options), 0);
  options = {};
  options.learning.after = 10000;
  EXPECT_EQ(learning(options), 0);
  options = {};
  options.learning.most_entries = 1e3;  // known when the diagonals are
  EXPECT_EQ(learning(options), 4);
  options = {};
  options.learning.operations = 0.1;
  EXPECT_EQ(learning(options), 4);
  EXPECT_GT(learning(Options{}), 4);
}

TEST(Learning, LeavesANoisyResidualAlone) {
  const Bratu bratu(16, 6.0);
  const auto F = [&](const Vector& u, Vector& r) {
    bratu(u, r);
    // A difference of single columns drowns in the rounding of single precision.
    for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = static_cast<float>(r[i] + 10.0) - 10.0;
  };
  Options options;
  options.tolerances.relative = 1e-3;
  const Report report = solve_from(F, Vector::Zero(256), options);
  const Report plain = solve_from(F, Vector::Zero(256), without_learning());
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_LE(report.counts.learning, 8);
  EXPECT_LE(report.counts.total(), plain.counts.total() + report.counts.learning);
}

/// Of steps so long that exp(u) overflows.
struct Misleading {
  void apply(const Vector& r, Vector& z) const { z = 1e6 * r; }
};

TEST(Learning, ReplacesAPreconditionerThatDoesNotHelp) {
  const Bratu bratu(24, 6.0);
  const Vector start = Vector::Zero(24 * 24);
  const Report kept = solve_from(bratu, start, without_learning(), Misleading{});
  const Report learnt = solve_from(bratu, start, Options{}, Misleading{});
  ASSERT_TRUE(kept.converged() && learnt.converged()) << learnt.reason;
  EXPECT_GT(learnt.counts.learning, 0);
  EXPECT_LT(learnt.counts.total(), kept.counts.total());
}

TEST(Learning, LeavesAPreconditionerThatHelpsAlone) {
  const Bratu bratu(24, 6.0);
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(24));
  const Report report = solve_from(bratu, Vector::Zero(24 * 24), Options{}, P);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.counts.learning, 0);
}

TEST(Learning, DoesNoHarmWhereTheJacobianIsSingular) {
  // Sums of neighbours only: no factors. Consistent, and solved without them.
  const int n = 64;
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double left = u[(i + n - 1) % n];
      const double right = u[(i + 1) % n];
      r[i] = 2.0 * u[i] - left - right - std::sin(6.0 * M_PI * (i + 0.5) / n);
    }
  };
  Options options;
  options.learning.after = 2;
  options.learning.worth = 0.0;
  const Report report = solve_from(F, Vector::Zero(n), options);
  EXPECT_TRUE(report.converged()) << report.reason;
}

TEST(Learning, StopsWhenAskedTo) {
  const Bratu bratu(24, 6.0);
  for (int at = 8; at < 16; ++at) {
    int calls = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      if (++calls == at) return Evaluation::stop;
      bratu(u, r);
      return Evaluation::ok;
    };
    const Report report = solve_from(F, Vector::Zero(24 * 24), Options{});
    EXPECT_EQ(report.status, jfnk::Status::stopped);
    EXPECT_EQ(calls, at);
    Options few;
    few.max_evaluations = at;
    const Report limited = solve_from(bratu, Vector::Zero(24 * 24), few);
    EXPECT_EQ(limited.status, jfnk::Status::evaluation_limit);
    EXPECT_EQ(limited.counts.total(), at);
  }
}

TEST(Learning, SurvivesPlacesWhereFHasNoValue) {
  const Bratu bratu(24, 6.0);
  for (int hole = 8; hole < 20; ++hole) {
    int calls = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      bratu(u, r);
      return ++calls < hole || calls > hole + 5;
    };
    const Report report = solve_from(F, Vector::Zero(24 * 24), Options{});
    EXPECT_TRUE(report.converged()) << hole << ": " << report.reason;
  }
}

}  // namespace

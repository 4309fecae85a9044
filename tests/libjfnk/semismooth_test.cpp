// Contact by Fischer-Burmeister: where ||F|| must rise for a while, full steps find the root.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jfnk/jfnk.hpp"

namespace {

using jfnk::Options;
using jfnk::Report;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;

/// A simply supported beam above a flat obstacle, stiffness and load scaled by h^4: gap and contact
/// force are complementary.
struct ContactBeam {
  int n;
  double load;
  double depth;

  double at(const Vector& u, int i) const {
    if (i < 0) return i == -1 ? 0.0 : -u[0];
    if (i >= n) return i == n ? 0.0 : -u[n - 1];
    return u[i];
  }
  double force(const Vector& u, int i) const {
    const double bending =
        at(u, i - 2) - 4.0 * at(u, i - 1) + 6.0 * at(u, i) - 4.0 * at(u, i + 1) + at(u, i + 2);
    return bending + load * std::pow(n + 1.0, -4);
  }
  void operator()(const Vector& u, Vector& r) const {
    for (int i = 0; i < n; ++i) {
      const double gap = u[i] + depth;
      const double push = force(u, i);
      r[i] = gap + push - std::hypot(gap, push);
    }
  }
};

TEST(Semismooth, AContactBeamIsSolvedByFullStepsWithAColouredJacobian) {
  for (const ContactBeam& beam : {ContactBeam{200, 1000.0, 0.1}, ContactBeam{400, 5000.0, 0.01}}) {
    jfnk::ColouredJacobian jacobian(beam, jfnk::banded_sparsity(beam.n, 2, 2));
    Options options = jfnk::semismooth();
    options.tolerances.relative = 1e-8;
    Vector u = Vector::Zero(beam.n);
    const Report report = jfnk::solve(beam, u, options, jacobian);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_LE(report.counts.total(), 100);
    // It had to rise on the way.
    double highest = 0.0;
    for (const auto& line : report.history) highest = std::max(highest, line.residual_norm);
    EXPECT_GT(highest, 10.0 * report.initial_residual_norm);
    int touching = 0;
    for (int i = 0; i < beam.n; ++i) {
      EXPECT_GE(u[i] + beam.depth, -1e-8);
      if (u[i] + beam.depth < 1e-7) ++touching;
    }
    EXPECT_GT(touching, beam.n / 2);
  }
}

TEST(Semismooth, FullStepsGoThroughASnapshotBitForBit) {
  const ContactBeam beam{100, 1000.0, 0.1};
  Options options = jfnk::semismooth();
  options.tolerances.relative = 1e-8;
  jfnk::ColouredJacobian jacobian(beam, jfnk::banded_sparsity(beam.n, 2, 2));
  Vector whole = Vector::Zero(beam.n);
  const Report expected = jfnk::solve(beam, whole, options, jacobian);
  ASSERT_TRUE(expected.converged()) << expected.reason;
  Solver first(options);
  ASSERT_TRUE(first.start(beam, Vector::Zero(beam.n), jacobian));
  for (int step = 0; step < 10; ++step) ASSERT_TRUE(first.step(beam, jacobian));
  Solver second(options);
  second.load(first.save());
  jfnk::ColouredJacobian other(beam, jfnk::banded_sparsity(beam.n, 2, 2));
  while (second.step(beam, other)) {
  }
  EXPECT_EQ(second.report().counts.total(), expected.counts.total());
  EXPECT_TRUE((second.solution().array() == whole.array()).all());
}

TEST(Semismooth, TheWatchdogEndsStepsThatLeadNowhere) {
  // Newton's steps for the root of an arc tangent from afar grow without end.
  const auto F = [](const Vector& u, Vector& r) { r = u.array().atan(); };
  Options options = jfnk::semismooth();
  options.globalisation.watchdog = 5;
  options.stagnation.restart = false;
  options.pseudo_transient.enabled = false;
  jfnk::ColouredJacobian jacobian(F, jfnk::banded_sparsity(2, 0, 0));
  Vector u = Vector::Constant(2, 3.0);
  Report report = jfnk::solve(F, u, options, jacobian);
  EXPECT_EQ(report.status, Status::stagnated) << report.reason;
  EXPECT_EQ(report.newton_iterations, options.globalisation.watchdog);
  EXPECT_TRUE((u.array() == 3.0).all());  // the best point
  // With the rescues line searches take over.
  options.stagnation.restart = true;
  report = jfnk::solve(F, u, options, jacobian);
  EXPECT_TRUE(report.converged()) << report.reason;
}

TEST(Semismooth, FullStepsAreTheLastRescueOfTheDefault) {
  const ContactBeam beam{50, 50.0, 0.1};
  Options options = jfnk::newton_krylov();
  options.tolerances.relative = 1e-8;
  jfnk::ColouredJacobian jacobian(beam, jfnk::banded_sparsity(beam.n, 2, 2));
  Vector u = Vector::Zero(beam.n);
  const Report report = jfnk::solve(beam, u, options, jacobian);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_FALSE(jfnk::solve(beam, u = Vector::Zero(beam.n), options).converged());
}

TEST(Semismooth, FullStepsAreTriedEarlyWhereAPreconditionerCanBeSetUp) {
  // As soon as a Newton step is cut to a hundredth; the root within as few evaluations as the issue
  // of soft beams asks of any preset.
  constexpr int bearable = 100;
  for (const ContactBeam& beam : {ContactBeam{200, 1000.0, 0.1}, ContactBeam{400, 5000.0, 0.01}}) {
    for (Options options : {jfnk::hybrid(), jfnk::newton_krylov()}) {
      options.tolerances.relative = 1e-8;
      jfnk::ColouredJacobian jacobian(beam, jfnk::banded_sparsity(beam.n, 2, 2));
      Vector u = Vector::Zero(beam.n);
      const Report report = jfnk::solve(beam, u, options, jacobian);
      EXPECT_TRUE(report.converged()) << report.reason;
      EXPECT_LE(report.counts.total(), bearable);
    }
  }
}

TEST(Semismooth, AnEarlyTryThatFailsCostsFewSteps) {
  // Newton's full steps for a root of |u| go from side to side.
  const auto F = [](const Vector& u, Vector& r) {
    r = u.array().sign() * u.array().abs().sqrt() * 10.0 + 0.1 * u.array();
  };
  constexpr int steps = 4;  // by when the first ones must have been undone
  Options options = jfnk::newton_krylov();
  const auto evaluations = [&] {
    jfnk::ColouredJacobian jacobian(F, jfnk::banded_sparsity(40, 0, 0));
    Vector u = Vector::LinSpaced(40, 0.5, 2.0);
    const Report report = jfnk::solve(F, u, options, jacobian);
    EXPECT_TRUE(report.converged()) << report.reason;
    return report.counts.total();
  };
  const int tried = evaluations();
  options.stagnation.restart = false;
  const int plain = evaluations();
  EXPECT_GT(tried, plain);
  EXPECT_LE(tried, plain + 2 * steps);  // the path from there is another
}

TEST(Semismooth, AStepOutOfTheDomainIsCut) {
  const auto F = [](const Vector& u, Vector& r) {
    r[0] = u[0] > 0.0 ? std::log(u[0]) : std::numeric_limits<double>::quiet_NaN();
  };
  jfnk::ColouredJacobian jacobian(F, jfnk::banded_sparsity(1, 0, 0));
  Vector u = Vector::Constant(1, 20.0);
  const Report report = jfnk::solve(F, u, jfnk::semismooth(), jacobian);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.line_search, 0);
}

}  // namespace

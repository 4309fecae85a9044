#include <gtest/gtest.h>

#include <algorithm>
#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

#include "jfnk/jfnk.hpp"
#include "jfnk/serialization.hpp"
#include "problems.hpp"

namespace {

using jfnk::Method;
using jfnk::Options;
using jfnk::Report;
using jfnk::Snapshot;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;

bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}

Snapshot through_an_archive(const Snapshot& snapshot) {
  std::stringstream file;
  {
    boost::archive::text_oarchive out(file);
    out << snapshot;
  }
  Snapshot read;
  boost::archive::text_iarchive in(file);
  in >> read;
  return read;
}

/// A preconditioner that depends on where it was set up.
struct Refreshed {
  jfnk::ColouredJacobian jacobian;
  void setup(const Vector& u) { jacobian.setup(u); }
  void apply(const Vector& r, Vector& z) const { jacobian.apply(r, z); }
};

/// Solves step by step; before step `at` the state goes through an archive into another solver.
template <class F, class MakePreconditioner>
Report solve_with_break(F&& residual, Vector& u, const Options& options,
                        const MakePreconditioner& make, int at) {
  auto preconditioner = make();
  Solver first(options);
  bool more = first.start(residual, u, preconditioner);
  for (int step = 0; more && step < at; ++step) more = first.step(residual, preconditioner);
  if (!more) {
    u = first.solution();
    return first.report();
  }
  const Snapshot saved = through_an_archive(first.save());
  auto other = make();
  Solver second(options);
  second.load(saved);
  EXPECT_EQ(second.report().status, Status::in_progress);
  EXPECT_TRUE(same_bits(second.solution(), first.solution()));
  while (second.step(residual, other)) {
  }
  u = second.solution();
  return second.report();
}

TEST(Resume, StepsGiveBitForBitWhatSolveGives) {
  const jfnk_test::Bratu bratu(12, 6.0);
  for (const Method method : {Method::newton_krylov, Method::multisecant, Method::hybrid}) {
    Options options;
    options.method = method;
    Vector whole = Vector::Zero(bratu.size());
    const Report expected = jfnk::solve(bratu, whole, options);
    Solver solver(options);
    Vector u = Vector::Zero(bratu.size());
    int steps = 0;
    for (bool more = solver.start(bratu, u); more; more = solver.step(bratu)) ++steps;
    EXPECT_TRUE(solver.report().converged());
    EXPECT_EQ(solver.report().reason, expected.reason);
    EXPECT_TRUE(same_bits(solver.solution(), whole));
    EXPECT_GE(steps, 3);
    EXPECT_FALSE(solver.step(bratu));  // ended
  }
}

TEST(Resume, ContinuesBitForBitFromAnyStepOfEveryStage) {
  // Wanders through multisecant, Newton, the restart and the pseudo-transient stage.
  const jfnk_test::HEquation hard(40, 1.0);
  const jfnk_test::PowellSingular powell;
  Options options;
  options.tolerances.relative = 1e-13;
  options.max_evaluations = 600;
  options.multisecant.patience = 3;
  options.globalisation.window = 3;
  const auto none = [] { return jfnk::Identity{}; };
  for (const bool single_precision : {false, true}) {
    options.multisecant.single_precision = options.krylov.single_precision = single_precision;
    for (const int at : {0, 1, 2, 5, 9, 17, 30, 60}) {
      Vector whole = Vector::Ones(40);
      const Report expected = jfnk::solve(hard, whole, options);
      Vector broken = Vector::Ones(40);
      const Report report = solve_with_break(hard, broken, options, none, at);
      EXPECT_EQ(report.reason, expected.reason) << at;
      EXPECT_EQ(report.history.size(), expected.history.size());
      EXPECT_TRUE(same_bits(broken, whole)) << at;

      Vector a(4);
      a << 3, -1, 0, 1;
      Vector b = a;
      const Report alone = jfnk::solve(powell, a, options);
      EXPECT_EQ(solve_with_break(powell, b, options, none, at).reason, alone.reason);
      EXPECT_TRUE(same_bits(a, b)) << at;
    }
  }
}

TEST(Resume, ContinuesBitForBitWithTheImagesOfAPreconditioner) {
  // So poor a one that the steps are the least squares', with columns that come and go.
  struct Poor {
    void apply(const Vector& r, Vector& z) const { z = 0.1 * r; }
  };
  const jfnk_test::Bratu bratu(12, 6.0);
  for (const int kind : {0, 1, 2}) {
    Options options;
    options.method = Method::multisecant;
    options.multisecant.memory = 12;
    options.multisecant.preconditioned_norm = kind == 1;
    options.multisecant.single_precision = kind == 2;
    const auto make = [] { return Poor{}; };
    for (const int at : {1, 5, 12, 15, 20}) {
      Vector whole = Vector::Zero(bratu.size());
      const Report expected = jfnk::solve(bratu, whole, options, make());
      ASSERT_GT(expected.multisecant_iterations, 20);
      Vector broken = Vector::Zero(bratu.size());
      const Report report = solve_with_break(bratu, broken, options, make, at);
      EXPECT_EQ(report.reason, expected.reason) << at;
      EXPECT_TRUE(same_bits(broken, whole)) << at;
    }
  }
}

TEST(Resume, ContinuesBitForBitWithALearntJacobian) {
  // Learnt, renewed in rounds and, where Newton stands still, shifted by pseudo-transient steps.
  const jfnk_test::Bratu easy(12, 6.0);
  const int n = 60;
  const auto rough = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? u[i - 1] : 0.0;
      const double right = i + 1 < n ? u[i + 1] : 1.0;
      r[i] = 2.0 * u[i] - left - right + 0.3 * std::atan(40.0 * (u[i] - 0.4)) - 0.05;
    }
  };
  Options options;
  options.tolerances.relative = 1e-10;
  const auto none = [] { return jfnk::Identity{}; };
  const auto compare = [&](auto&& residual, Eigen::Index size) {
    Vector whole = Vector::Zero(size);
    const Report expected = jfnk::solve(residual, whole, options);
    EXPECT_GT(expected.counts.learning, 0);
    for (int at = 0; at < 40; at += 3) {
      Vector broken = Vector::Zero(size);
      const Report report = solve_with_break(residual, broken, options, none, at);
      EXPECT_EQ(report.reason, expected.reason) << at;
      EXPECT_EQ(report.counts.learning, expected.counts.learning) << at;
      EXPECT_TRUE(same_bits(broken, whole)) << at;
    }
  };
  compare(easy, 144);
  compare(rough, n);
}

TEST(Resume, SetsThePreconditionerUpWhereItWas) {
  const jfnk_test::Bratu bratu(10, 6.0);
  Options options;
  options.method = Method::newton_krylov;
  options.tolerances.relative = 1e-12;
  options.preconditioner_setup = jfnk::PreconditionerSetup::every_newton_step;
  const auto make = [&] { return Refreshed{{bratu, jfnk_test::laplacian(10)}}; };
  Vector whole = Vector::Zero(100);
  auto preconditioner = make();
  const Report expected = jfnk::solve(bratu, whole, options, preconditioner);
  ASSERT_TRUE(expected.converged());
  for (const int at : {0, 1, 2}) {
    Vector broken = Vector::Zero(100);
    const Report report = solve_with_break(bratu, broken, options, make, at);
    EXPECT_TRUE(same_bits(broken, whole)) << at;
    EXPECT_EQ(report.counts.total(), expected.counts.total());
    EXPECT_EQ(report.counts.preconditioner_setups, expected.counts.preconditioner_setups);
  }
}

TEST(Resume, RefusesWhatItCannotContinue) {
  const jfnk_test::Bratu bratu(6, 5.0);
  Solver solver;
  EXPECT_THROW((void)solver.save(), std::invalid_argument);
  ASSERT_TRUE(solver.start(bratu, Vector::Zero(36)));
  (void)solver.step(bratu);
  const Snapshot good = solver.save();
  Solver other;

  Snapshot cut = good;
  cut.reals.pop_back();
  EXPECT_THROW(other.load(cut), std::invalid_argument);
  Snapshot longer = good;
  longer.integers.push_back(1);
  EXPECT_THROW(other.load(longer), std::invalid_argument);
  // As if a Jacobian were learnt that is not there.
  Snapshot invented = good;
  invented.integers[5] = 1;
  EXPECT_THROW(other.load(invented), std::invalid_argument);
  Snapshot newer = good;
  newer.integers.front() = 1000;
  EXPECT_THROW(other.load(newer), std::invalid_argument);
  EXPECT_THROW(other.load(Snapshot{}), std::invalid_argument);
  Solver newton(jfnk::newton_krylov());
  EXPECT_THROW(newton.load(good), std::invalid_argument);
  EXPECT_FALSE(other.step(bratu));  // still nothing to do
  other.load(good);
  EXPECT_TRUE(other.step(bratu));
}

/// A solve of Bratu's problem in its midst, and what may become of damaged copies of it.
struct Midway {
  jfnk_test::Bratu bratu{8, 6.0};
  Options options;
  Snapshot good;
  double tolerance = 0.0;  // on ||F||, of the undamaged solve

  Midway() {
    options.tolerances.relative = 1e-10;
    Solver solver(options);
    EXPECT_TRUE(solver.start(bratu, Vector::Zero(64)));
    for (int step = 0; step < 7; ++step) EXPECT_TRUE(solver.step(bratu));
    good = solver.save();
    while (solver.step(bratu)) {
    }
    EXPECT_EQ(solver.report().status, Status::converged);
    tolerance = solver.report().tolerance;
  }

  /// @return whether it was refused; if not, the solve goes on, and may not claim what is not so
  bool refused(const Snapshot& damaged) const {
    Solver solver(options);
    try {
      solver.load(damaged);
    } catch (const std::invalid_argument&) {
      return true;
    }
    while (solver.step(bratu)) {
    }
    if (solver.report().status == Status::converged) {
      Vector r(64);
      bratu(solver.solution(), r);
      EXPECT_LE(r.norm(), tolerance);
    }
    return false;
  }
};

TEST(Resume, RefusesAnyDamagedSize) {
  const Midway midway;
  const auto refuses = [&](std::size_t place, std::int64_t value) {
    Snapshot damaged = midway.good;
    damaged.integers[place] = value;
    return midway.refused(damaged);
  };
  // Version, method, unknowns, secant pairs, these in single precision or not, unknowns at the
  // setup, learnt or not, lines.
  for (const std::size_t place : {0, 1, 2, 3, 5, 7}) {
    EXPECT_TRUE(refuses(place, -1)) << place;
    EXPECT_TRUE(refuses(place, std::int64_t{1} << 40)) << place;
  }
  for (const std::size_t place : {0, 1, 2, 5, 7}) EXPECT_TRUE(refuses(place, 77)) << place;
  EXPECT_TRUE(refuses(3, midway.options.multisecant.memory + 1));
  EXPECT_TRUE(refuses(4, 1 - midway.good.integers[4]));
  EXPECT_TRUE(refuses(6, 1 - midway.good.integers[6]));
}

TEST(Resume, RefusesAnyDamagedCount) {
  const Midway midway;
  // None of the residuals of the counts, which are known of this solve, can be negative or so many.
  Solver solver(midway.options);
  solver.load(midway.good);
  const std::vector<std::int64_t>& all = midway.good.integers;
  const jfnk::Counts& counts = solver.report().counts;
  const std::int64_t sought[] = {counts.start,
                                 counts.newton_trials,
                                 counts.line_search,
                                 counts.multisecant,
                                 counts.pseudo_transient,
                                 counts.noise,
                                 counts.difference_actions,
                                 counts.user_actions};
  const auto place = std::search(all.begin() + 7, all.end(), std::begin(sought), std::end(sought));
  ASSERT_NE(place, all.end());
  for (std::ptrdiff_t i = 0; i < std::ssize(sought); ++i) {
    for (const std::int64_t value : {std::int64_t{-1}, std::int64_t{2147483647}}) {
      Snapshot damaged = midway.good;
      damaged.integers[static_cast<std::size_t>(place - all.begin() + i)] = value;
      EXPECT_TRUE(midway.refused(damaged)) << "count " << i << " = " << value;
    }
  }
}

TEST(Resume, ClaimsNothingFalseAfterAnyDamageThatIsNotSeen) {
  const Midway midway;
  int survived = 0;
  for (std::size_t i = 7; i < midway.good.integers.size(); ++i) {
    for (const std::int64_t value : {std::int64_t{-1}, std::int64_t{1} << 40, std::int64_t{77}}) {
      Snapshot damaged = midway.good;
      damaged.integers[i] = value;
      survived += midway.refused(damaged) ? 0 : 1;
    }
  }
  for (std::size_t i = 0; i < midway.good.reals.size(); i += 11) {
    Snapshot damaged = midway.good;
    damaged.reals[i] = std::numeric_limits<double>::quiet_NaN();
    survived += midway.refused(damaged) ? 0 : 1;
  }
  EXPECT_GT(survived, 0);  // else nothing was tried
}

}  // namespace

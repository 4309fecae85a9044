// Pairs of one solve that the next one begins with.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Options;
using jfnk::Report;
using jfnk::SecantPairs;
using jfnk::Solver;
using jfnk::Vector;

constexpr int all = std::numeric_limits<int>::max();

bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}

/// A u = b, n unknowns, n = 12.
struct Linear {
  Eigen::MatrixXd matrix;
  Vector right;
  Linear() : matrix(12, 12), right(Vector::LinSpaced(12, 1.0, 2.0)) {
    for (int i = 0; i < 12; ++i) {
      for (int j = 0; j < 12; ++j) matrix(i, j) = i == j ? 3.0 + i : 1.0 / (1.0 + i + 2 * j);
    }
  }
  void operator()(const Vector& u, Vector& r) const { r = matrix * u - right; }
};

Options by_multisecants() {
  Options options;
  options.method = jfnk::Method::multisecant;
  options.learning.enabled = false;
  return options;
}

// All pairs of a linear problem are its inverse, so that another right-hand side costs a step;
// single precision of the pairs, 1e-7 times the condition of 12, leaves 1e-6 to a second one.
TEST(GivenPairs, OfALinearProblemSolveItForAnyRightHandSide) {
  Linear problem;
  Options options = by_multisecants();
  options.tolerances.relative = 1e-13;
  Solver solver(options);
  Vector u = Vector::Zero(12);
  const int alone = solver.solve(problem, u).counts.total();
  SecantPairs pairs;
  solver.pairs(all, pairs);
  ASSERT_EQ(pairs.step.cols(), 12);
  EXPECT_LT((problem.matrix * pairs.step.cast<double>() - pairs.change.cast<double>()).norm(),
            1e-5);
  problem.right.setRandom();
  Options looser = options;
  looser.tolerances.relative = 1e-5;
  Solver other(looser);
  other.begin_with(pairs);
  u.setZero();
  const Report& report = other.solve(problem, u);
  EXPECT_TRUE(report.converged()) << report.reason;
  // F at the start, the action that measures the mixing, and one step.
  EXPECT_LE(report.counts.total(), 3);
  EXPECT_GT(alone, 12);
}

/// Unit stiffness, but for a few soft modes of which the preconditioner (none) knows nothing, as of
/// mechanisms that yield; a little of it depends on u. The load differs from step to step.
struct SoftModes {
  double step = 0.0;
  void operator()(const Vector& u, Vector& r) const {
    r = u.array() + 1e-6 * u.array().cube();
    for (Eigen::Index i = 0; i < r.size(); ++i) r[i] -= std::sin(step + static_cast<double>(i));
    for (Eigen::Index i = 0; i < 6; ++i) r[i] -= (1.0 - 0.02 * static_cast<double>(i + 1)) * u[i];
  }
};

/// Evaluations of ten steps that hand on so many pairs.
template <class P>
int evaluations(const Options& options, const P& preconditioner, int kept) {
  Solver solver(options);
  Vector u = Vector::Zero(60);
  SecantPairs pairs;
  int sum = 0;
  for (int step = 1; step <= 10; ++step) {
    solver.begin_with(pairs);
    const Report& report = solver.solve(SoftModes{0.1 * step}, u, preconditioner);
    EXPECT_TRUE(report.converged()) << report.reason;
    sum += report.counts.total();
    solver.pairs(kept, pairs);
    EXPECT_LE(pairs.step.cols(), kept);
  }
  return sum;
}

// Each mode takes a pair of a solve that knows nothing, and none of one that is given them: with a
// preconditioner or none, and with Broyden's updates of it besides.
TEST(GivenPairs, SpareEvaluationsWhereTheSameModesAreSoftInEveryStep) {
  constexpr int modes = 6, steps_given = 9, kept = 10;
  const auto scaled = [](const Vector& r, Vector& z) { z = 0.9 * r; };
  Options options = jfnk::plasticity();
  options.tolerances.relative = 1e-3;
  const int spared = modes * steps_given;
  EXPECT_LE(evaluations(options, jfnk::Identity{}, kept),
            evaluations(options, jfnk::Identity{}, 0) - spared);
  EXPECT_LE(evaluations(options, scaled, kept), evaluations(options, scaled, 0) - spared);
  options.multisecant.broyden = true;
  EXPECT_LE(evaluations(options, scaled, kept), evaluations(options, scaled, 0) - spared);
}

// They go on bit for bit in another solver: in files they are as they are kept.
TEST(GivenPairs, LeadAnotherSolverToTheSameBits) {
  const jfnk_test::Bratu bratu(12, 6.0);
  for (const bool single_precision : {false, true}) {
    Options options = by_multisecants();
    options.multisecant.single_precision = single_precision;
    Solver one(options);
    Vector u = Vector::Zero(bratu.size());
    ASSERT_TRUE(one.solve(bratu, u).converged());
    SecantPairs pairs;
    one.pairs(8, pairs);
    ASSERT_EQ(pairs.step.cols(), 8);
    one.begin_with(pairs);
    Vector a = Vector::Ones(bratu.size()), b = a, c = a, d = a;
    (void)one.solve(bratu, a);
    Solver other(options);
    other.begin_with(pairs);
    (void)other.solve(bratu, b);
    EXPECT_TRUE(same_bits(a, b));
    EXPECT_EQ(one.report().counts.total(), other.report().counts.total());
    // And only the next solve: the one after it knows nothing.
    (void)other.solve(bratu, c);
    (void)jfnk::solve(bratu, d, options);
    EXPECT_TRUE(same_bits(c, d));
    EXPECT_FALSE(same_bits(b, c));
  }
}

TEST(GivenPairs, ArePartOfASnapshot) {
  const jfnk_test::Bratu bratu(12, 6.0);
  const Options options = by_multisecants();
  Solver solver(options);
  Vector u = Vector::Zero(bratu.size());
  ASSERT_TRUE(solver.solve(bratu, u).converged());
  SecantPairs pairs;
  solver.pairs(8, pairs);
  pairs.step *= -1.0F;  // of no use: they are dropped on the way
  u.setOnes();
  solver.begin_with(pairs);
  Vector whole = u;
  (void)solver.solve(bratu, whole);
  for (const int at : {0, 2, 4, 6, 9}) {
    solver.begin_with(pairs);
    ASSERT_TRUE(solver.start(bratu, u));
    for (int step = 0; step < at; ++step) ASSERT_TRUE(solver.step(bratu));
    Solver other(options);
    other.load(solver.save());
    while (other.step(bratu)) {
    }
    EXPECT_TRUE(same_bits(other.solution(), whole)) << at;
  }
}

// Pairs of no use cost their patience, and what the steps by them had gained is kept.
TEST(GivenPairs, ThatMisleadAreDropped) {
  const jfnk_test::Bratu bratu(12, 6.0);
  const Options options = by_multisecants();
  Vector u = Vector::Zero(bratu.size());
  const int alone = jfnk::solve(bratu, u, options).counts.total();
  std::mt19937 generator(5);
  std::normal_distribution<float> normal;
  SecantPairs pairs;
  const auto random = [&](Eigen::Index, Eigen::Index) { return normal(generator); };
  for (const float size : {1e-3F, 1.0F, 1e3F}) {
    pairs.step = size * Eigen::MatrixXf::NullaryExpr(bratu.size(), 8, random);
    pairs.change = Eigen::MatrixXf::NullaryExpr(bratu.size(), 8, random);
    Solver solver(options);
    solver.begin_with(pairs);
    u.setZero();
    const Report& report = solver.solve(bratu, u);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_LE(report.counts.total(), alone + 2 * options.multisecant.given_patience) << size;
  }
}

/// Steps that lead nowhere, of a length.
SecantPairs random_pairs(Eigen::Index n, float length) {
  std::mt19937 generator(5);
  std::normal_distribution<float> normal;
  const auto random = [&](Eigen::Index, Eigen::Index) { return normal(generator); };
  return {length * Eigen::MatrixXf::NullaryExpr(n, 4, random),
          Eigen::MatrixXf::NullaryExpr(n, 4, random)};
}

TEST(GivenPairs, ThatMisleadAreDroppedBeforeNewtonHelps) {
  Options options = jfnk::plasticity();
  options.multisecant.given_patience = 1000;  // more than that of all
  Solver solver(options);
  Vector u = Vector::Zero(60);
  ASSERT_EQ(solver.solve(SoftModes{}, u).newton_iterations, 0);
  solver.begin_with(random_pairs(60, 1.0F));
  u.setZero();
  const Report& report = solver.solve(SoftModes{}, u);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_EQ(report.newton_iterations, 0);
}

// They lead out of the domain at once, so that Newton has to help: once.
TEST(GivenPairs, AreForgottenAfterNewtonHasHelped) {
  const auto bounded = [](const Vector& u, Vector& r) {
    if (u.cwiseAbs().maxCoeff() > 1e3) return jfnk::Evaluation::out_of_domain;
    SoftModes{}(u, r);
    return jfnk::Evaluation::ok;
  };
  Options options = jfnk::plasticity();
  options.multisecant.max_cuts = 0;
  Solver solver(options);
  solver.begin_with(random_pairs(60, 1e6F));
  Vector u = Vector::Zero(60);
  const Report& report = solver.solve(bounded, u);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.newton_iterations, 0);
  EXPECT_LE(report.newton_iterations, options.hybrid.newton_steps);
}

TEST(GivenPairs, AreNotThereWhereChangesAreNotThoseOfTheResidual) {
  const jfnk_test::Bratu bratu(8, 6.0);
  Options options;
  options.method = jfnk::Method::newton_krylov;
  Solver solver(options);
  Vector u = Vector::Zero(bratu.size());
  SecantPairs pairs;
  solver.pairs(all, pairs);
  EXPECT_EQ(pairs.step.cols(), 0);  // before the first solve
  ASSERT_TRUE(solver.solve(bratu, u).converged());
  solver.pairs(all, pairs);
  EXPECT_EQ(pairs.step.cols(), 0);
  options = by_multisecants();
  options.multisecant.preconditioned_norm = true;
  solver.set_options(options);
  u.setZero();
  ASSERT_TRUE(solver.solve(bratu, u).converged());
  solver.pairs(all, pairs);
  EXPECT_EQ(pairs.step.cols(), 0);
}

TEST(GivenPairs, AreNotThereOfALearntJacobianNorUnderOtherOptions) {
  const jfnk_test::Bratu bratu(20, 6.0);
  Options options;
  Solver solver(options);
  Vector u = Vector::Zero(bratu.size());
  SecantPairs pairs;
  ASSERT_GT(solver.solve(bratu, u).counts.learning, 0);
  solver.pairs(all, pairs);
  EXPECT_EQ(pairs.step.cols(), 0);
  options.learning.enabled = false;
  solver.set_options(options);
  u.setZero();
  ASSERT_TRUE(solver.solve(bratu, u).converged());
  solver.pairs(all, pairs);
  EXPECT_GT(pairs.step.cols(), 0);
  solver.begin_with(pairs);
  solver.set_options(options);  // which might have been another unit of F
  Vector a = Vector::Ones(bratu.size()), b = a;
  (void)solver.solve(bratu, a);
  (void)jfnk::solve(bratu, b, options);
  EXPECT_TRUE(same_bits(a, b));
  solver.set_options(options);
  solver.pairs(all, pairs);
  EXPECT_EQ(pairs.step.cols(), 0);
}

TEST(GivenPairs, AreTheLatestThatThereIsRoomFor) {
  Options options = jfnk::plasticity();
  options.multisecant.memory = 5;
  Solver solver(options);
  solver.begin_with(random_pairs(60, 1.0F));
  SecantPairs eight = random_pairs(60, 1.0F);
  eight.step = eight.step.replicate(1, 2).eval();
  eight.change = Eigen::MatrixXf::Identity(60, 8);
  solver.begin_with(eight);
  Vector u = Vector::Zero(60);
  ASSERT_TRUE(solver.start(SoftModes{}, u));
  SecantPairs held;
  solver.pairs(all, held);
  EXPECT_TRUE(held.step == eight.step.rightCols(5));
  EXPECT_TRUE(held.change == eight.change.rightCols(5));
}

TEST(GivenPairs, ThatDoNotFitAreRefused) {
  Solver solver(by_multisecants());
  SecantPairs pairs{Eigen::MatrixXf::Ones(12, 3), Eigen::MatrixXf::Ones(12, 2)};
  EXPECT_THROW(solver.begin_with(pairs), std::invalid_argument);
  pairs.change = Eigen::MatrixXf::Ones(11, 3);
  EXPECT_THROW(solver.begin_with(pairs), std::invalid_argument);
  pairs.change = Eigen::MatrixXf::Ones(12, 3);
  pairs.change(4, 1) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(solver.begin_with(pairs), std::invalid_argument);
  pairs.change(4, 1) = 1.0F;
  solver.begin_with(pairs);
  Vector u = Vector::Zero(5);
  const auto residual = [](const Vector& v, Vector& r) { r = v; };
  EXPECT_THROW((void)solver.solve(residual, u), std::invalid_argument);
  EXPECT_TRUE(solver.solve(residual, u).converged());  // they are gone
  Options newton;
  newton.method = jfnk::Method::newton_krylov;
  solver.set_options(newton);
  solver.begin_with(pairs);
  EXPECT_TRUE(solver.solve(residual, u).converged());  // which does not look at them
}

}  // namespace

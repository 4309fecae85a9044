#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "evaluator.hpp"
#include "problems.hpp"

namespace {

using jfnk::Counts;
using jfnk::Evaluation;
using jfnk::Jacobian;
using jfnk::Options;
using jfnk::PreconditionerRef;
using jfnk::ResidualRef;
using jfnk::Vector;
using jfnk::detail::Evaluator;
using jfnk::detail::EvaluatorState;
using jfnk::detail::EvaluatorVectors;
using jfnk::detail::Iterate;
using jfnk::detail::Outcome;

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

/// An evaluator about one base point.
template <class F>
class About {
 public:
  About(F& f, const Vector& u, const Options& options)
      : options_(options),
        residual_(f),
        evaluator_(residual_, preconditioner_, options_, counts, vectors_, state_) {
    vectors_.probe.resize(u.size());
    state_.noise = options.jacobian.noise;
    base_.resize(u.size());
    base_.u = u;
    start = evaluator_.evaluate_start(base_);
    (void)evaluator_.linearise(base_);
  }
  Outcome action(const Vector& v, Vector& Jv) { return evaluator_.action(v, Jv); }

  Counts counts;
  Outcome start;

 private:
  Options options_;
  ResidualRef residual_;
  PreconditionerRef preconditioner_;
  EvaluatorVectors vectors_;
  EvaluatorState state_;
  Iterate base_;
  Evaluator evaluator_;
};

TEST(JacobianAction, DifferenceErrorIsThatOfTheory) {
  constexpr int m = 12;
  jfnk_test::BratuWithJacobian bratu(m, 5.0);
  const Vector u = Vector::LinSpaced(m * m, 0.0, 1.0);
  const Vector v = Vector::LinSpaced(m * m, -1.0, 2.0).array().sin();
  bratu.linearise(u);
  Vector exact(m * m);
  bratu.apply_jacobian(v, exact);

  Options options;
  options.jacobian.source = Jacobian::Source::finite_difference;
  About about(bratu, u, options);
  Vector approximate(m * m);
  ASSERT_EQ(about.action(v, approximate), Outcome::ok);
  const double eps = options.jacobian.noise * std::sqrt(1.0 + u.norm()) / v.norm();
  // Truncation eps/2 max|F''| ||v^2||, with F'' = lambda h^2 exp(u); rounding of two residuals,
  // whose rows add eight terms of size max|u|.
  const double curvature = 5.0 / (13.0 * 13.0) * std::exp(1.0);
  const double truncation = 0.5 * eps * curvature * v.cwiseAbs2().norm();
  const double rounding = 2.0 * rounding_unit * 8.0 * std::sqrt(m * m) / eps;
  EXPECT_LE((approximate - exact).norm(), truncation + rounding);
  EXPECT_EQ(about.counts.difference_actions, 1);
}

TEST(JacobianAction, UsesTheResidualsOwnUnlessToldOtherwise) {
  jfnk_test::BratuWithJacobian bratu(4, 1.0);
  const Vector v = Vector::Ones(16);
  Vector Jv(16);
  About own(bratu, v, Options{});
  ASSERT_EQ(own.action(v, Jv), Outcome::ok);
  EXPECT_EQ(own.counts.user_actions, 1);
  EXPECT_EQ(own.counts.linearisations, 1);
  EXPECT_EQ(own.counts.difference_actions, 0);
  EXPECT_EQ(own.counts.total(), 2);

  Options options;
  options.jacobian.source = Jacobian::Source::finite_difference;
  About differences(bratu, v, options);
  ASSERT_EQ(differences.action(v, Jv), Outcome::ok);
  EXPECT_EQ(differences.counts.user_actions, 0);
  EXPECT_EQ(differences.counts.linearisations, 0);
  EXPECT_EQ(differences.counts.difference_actions, 1);
}

/// Records where it is evaluated; each component of u must lie in [low, high].
struct Recorder {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  std::vector<Vector> seen;
  bool operator()(const Vector& u, Vector& r) {
    seen.push_back(u);
    r = u;
    return u.minCoeff() >= low && u.maxCoeff() <= high;
  }
};

double perturbation(Jacobian::Step step, const Vector& u, const Vector& v) {
  Recorder recorder;
  Options options;
  options.jacobian.step = step;
  options.jacobian.noise = 1e-4;  // large, so that it is read off u + eps v without loss
  options.jacobian.length_scale = step == Jacobian::Step::length_scale ? 1e-3 : 0.0;
  About about(recorder, u, options);
  Vector Jv(u.size());
  EXPECT_EQ(about.action(v, Jv), Outcome::ok);
  return (recorder.seen.back() - u).norm() / v.norm();
}

TEST(JacobianAction, TakesTheStepItsRuleStates) {
  const Vector u = Vector::Constant(4, 3.0);  // norm 6
  const Vector v = Vector::Constant(4, 5.0);  // norm 10
  constexpr double reading = 1e-9;            // of u + eps v at u = 3: 4e-16 / 1e-6
  EXPECT_NEAR(perturbation(Jacobian::Step::generic, u, v) / (1e-4 * std::sqrt(7.0) / 10.0), 1.0,
              reading);
  EXPECT_NEAR(perturbation(Jacobian::Step::length_scale, u, v) / (1e-4 * 1e-3 * 2.0 / 10.0), 1.0,
              1e2 * reading);
  EXPECT_NEAR(perturbation(Jacobian::Step::paper, u, v) / (11.0 * 1e-4 * 6.0), 1.0, reading);
  EXPECT_NEAR(perturbation(Jacobian::Step::paper, Vector::Zero(4), v) / (11.0 * 1e-4), 1.0,
              reading);
}

TEST(JacobianAction, FlipsTheSignAtTheEdgeOfTheDomain) {
  Recorder recorder;
  recorder.high = 1.0;
  About about(recorder, Vector::Ones(2), Options{});
  Vector Jv(2);
  ASSERT_EQ(about.action(Vector::Ones(2), Jv), Outcome::ok);
  EXPECT_EQ(about.counts.difference_actions, 2);
  EXPECT_GT(recorder.seen[1][0], 1.0);
  EXPECT_LT(recorder.seen[2][0], 1.0);
  EXPECT_NEAR(Jv[0], 1.0, 1e-7);
}

TEST(JacobianAction, ShrinksTheStepBetweenTwoEdges) {
  Recorder recorder;
  recorder.high = 1.0 + 1e-9;
  recorder.low = 1.0 - 1e-9;
  About about(recorder, Vector::Ones(2), Options{});
  Vector Jv(2);
  ASSERT_EQ(about.action(Vector::Ones(2), Jv), Outcome::ok);
  // eps = 1.5e-8 sqrt(1 + sqrt 2) / sqrt 2 = 1.6e-8: both signs at 1.6e-8 and 1.6e-9 are outside.
  EXPECT_EQ(about.counts.difference_actions, 5);
}

TEST(JacobianAction, GivesUpAfterTheAttemptsAllowed) {
  Recorder recorder;
  recorder.high = 1.0;
  recorder.low = 1.0;
  Options options;
  options.jacobian.max_attempts = 3;
  About about(recorder, Vector::Ones(2), options);
  Vector Jv(2);
  EXPECT_EQ(about.action(Vector::Ones(2), Jv), Outcome::out_of_domain);
  EXPECT_EQ(about.counts.difference_actions, 3);
}

TEST(JacobianAction, ZeroDirectionCostsNothing) {
  Recorder recorder;
  About about(recorder, Vector::Ones(2), Options{});
  Vector Jv = Vector::Ones(2);
  EXPECT_EQ(about.action(Vector::Zero(2), Jv), Outcome::ok);
  EXPECT_EQ(Jv.norm(), 0.0);
  EXPECT_EQ(about.counts.difference_actions, 0);
}

TEST(JacobianAction, StopsAtTheEvaluationLimit) {
  Recorder recorder;
  Options options;
  options.max_evaluations = 1;
  About about(recorder, Vector::Ones(2), options);
  Vector Jv(2);
  EXPECT_EQ(about.action(Vector::Ones(2), Jv), Outcome::limit);
  EXPECT_EQ(recorder.seen.size(), 1u);
}

}  // namespace

#include "jfnk/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Status;
using jfnk::Vector;

bool contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

TEST(Report, EveryStatusHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Status::stopped); ++i) {
    names.insert(jfnk::to_string(static_cast<Status>(i)));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(Status::stopped) + 1);
  EXPECT_FALSE(names.contains("unknown"));
  EXPECT_EQ(jfnk::to_string(jfnk::Phase::multisecant), "multisecant");
}

TEST(Report, SuccessSaysWhatWasMetAndAtWhatCost) {
  Vector u = Vector::Constant(1, 3.0);
  Options options;
  options.tolerances.absolute = 0.5;
  const Report report = solve([](const Vector& v, Vector& r) { r[0] = v[0] - 1.0; }, u, options);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.tolerance, 0.5);
  EXPECT_TRUE(contains(report.reason, "met the tolerance 0.5 after 3 evaluations"))
      << report.reason;
}

TEST(Report, NamesTheWorstComponent) {
  const auto F = [](const Vector& u, Vector& r) {
    r = u;
    r[2] += 50.0 + u[2] * u[2];
  };
  Vector u = Vector::Zero(4);
  Options options;
  options.max_evaluations = 1;
  const Report report = solve(F, u, options);
  EXPECT_EQ(report.worst_component, 2);
  EXPECT_TRUE(contains(report.reason, "max_evaluations = 1 is used up")) << report.reason;
  EXPECT_TRUE(contains(report.reason, "largest in component 2 (50)")) << report.reason;
}

TEST(Report, LineSearchFailureOfAWrongJacobianPointsToIt) {
  struct Wrong {
    void operator()(const Vector& u, Vector& r) const { r = u; }
    void linearise(const Vector&) {}
    void apply_jacobian(const Vector& v, Vector& Jv) const { Jv = -v; }
  };
  Options options = jfnk::newton_krylov();
  options.globalisation.rule = jfnk::Globalisation::Rule::backtracking;
  options.stagnation.restart = false;
  options.pseudo_transient.enabled = false;
  Vector u = Vector::Ones(2);
  const Report report = solve(Wrong{}, u, options);
  EXPECT_EQ(report.status, Status::line_search_failed);
  // One more looks to the other side.
  EXPECT_EQ(report.counts.line_search, Options{}.globalisation.max_cuts + 1);
  EXPECT_TRUE(contains(report.reason, "check the Jacobian action")) << report.reason;
  EXPECT_TRUE((u.array() == 1.0).all());
}

TEST(Report, ExhaustedIterationsNameTheOptionToRaise) {
  const jfnk_test::Bratu bratu(10, 6.0);
  Options options = jfnk::newton_krylov();
  options.max_iterations = 1;
  options.tolerances.relative = 1e-12;
  Vector u = Vector::Zero(bratu.size());
  const Report newton = solve(bratu, u, options);
  EXPECT_EQ(newton.status, Status::max_iterations);
  EXPECT_TRUE(contains(newton.reason, "raise max_iterations")) << newton.reason;
  EXPECT_LT(newton.residual_norm, newton.initial_residual_norm);

  options = jfnk::plasticity();
  options.tolerances.relative = 1e-12;
  options.hybrid.rounds = 1;
  options.hybrid.newton_steps = 1;
  options.hybrid.final_newton_steps = 0;
  options.multisecant.patience = 1;
  u.setConstant(1.0);
  const Report hybrid = solve(bratu, u, options);
  EXPECT_EQ(hybrid.status, Status::max_iterations);
  EXPECT_TRUE(contains(hybrid.reason, "hybrid.rounds")) << hybrid.reason;
}

TEST(Report, FailureReturnsTheBestPointMet) {
  // The step tolerance cannot be met before the schedule ends; the residual falls all the same.
  Options options = jfnk::newton_krylov();
  options.tolerances.step = 1e-15;
  options.max_iterations = 4;
  Vector u(2);
  u << -1.2, 1.0;
  const Report report = solve(jfnk_test::Rosenbrock{}, u, options);
  EXPECT_EQ(report.status, Status::max_iterations);
  double lowest = report.history.front().residual_norm;
  for (const auto& line : report.history) lowest = std::min(lowest, line.residual_norm);
  EXPECT_EQ(report.residual_norm, lowest);
  Vector r(2);
  jfnk_test::Rosenbrock{}(u, r);
  EXPECT_EQ(r.norm(), lowest);
}

}  // namespace

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Evaluation;
using jfnk::Method;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Status;
using jfnk::Vector;
using jfnk_test::all_methods;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Domain, NewtonHalvesAStepThatLeavesIt) {
  // From 5 the Newton step of log u goes to 5 - 5 log 5 = -3.05; half of it to 0.98.
  int refused = 0;
  const auto F = [&](const Vector& u, Vector& r) {
    if (u[0] <= 0.0) {
      ++refused;
      return false;
    }
    r[0] = std::log(u[0]);
    return true;
  };
  Vector u = Vector::Constant(1, 5.0);
  const Report report = solve(F, u);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(refused, 1);
  EXPECT_EQ(report.history[1].step_length, 0.5);
  EXPECT_EQ(report.counts.line_search, 1);
  EXPECT_NEAR(u[0], 1.0, 1e-5);
}

TEST(Domain, ItsEdgeIsRememberedFromStepToStep) {
  // Newton's steps for logarithms leave the domain again and again. The first one, 160 long from
  // 20, is halved four times; every other one begins at twice what was left of the one before.
  constexpr int first = 4;
  using Rule = jfnk::Globalisation::Rule;
  for (const Rule rule : {Rule::backtracking, Rule::parabola}) {
    int refused = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      if (!(u.minCoeff() > 0.0)) {
        ++refused;
        return false;
      }
      for (int i = 0; i < u.size(); ++i) r[i] = std::log(u[i]) - 0.3 * i + 5.0;
      return true;
    };
    Options options = jfnk::newton_krylov();
    options.globalisation.rule = rule;
    Vector u = Vector::Constant(20, 20.0);
    const Report report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_LE(refused, first + report.newton_iterations);
  }
}

TEST(Domain, NanIsTreatedAsARefusal) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array().log(); };
  Vector u = Vector::LinSpaced(6, 0.2, 9.0);
  const Report report = solve(F, u);
  EXPECT_TRUE(report.converged());
  EXPECT_LE((u.array() - 1.0).abs().maxCoeff(), 1e-5);
}

TEST(Domain, MultisecantBacksOffTowardsTheBestPoint) {
  // The plain step u - F of sqrt(u) + 20 u = 5 from u = 1 goes to -15.
  const auto F = [](const Vector& u, Vector& r) {
    if (u[0] < 0.0) return Evaluation::out_of_domain;
    r[0] = std::sqrt(u[0]) + 20.0 * u[0] - 5.0;
    return Evaluation::ok;
  };
  Options options;
  options.method = Method::multisecant;
  options.multisecant.scale_mixing = false;
  Vector u = Vector::Ones(1);
  const Report report = solve(F, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.line_search, 0);
  EXPECT_LT(report.history[1].step_length, 1.0);
  EXPECT_NEAR(std::sqrt(u[0]) + 20.0 * u[0], 5.0, 1e-4);
}

TEST(Domain, DifferencesWorkAtItsEdge) {
  // u0 lies on the edge, and the direction GMRES looks along points outwards.
  const auto F = [](const Vector& u, Vector& r) {
    if (u[0] > 2.0) return false;
    r[0] = -(u[0] - 1.0) * (2.0 + u[0]);
    return true;
  };
  Vector u = Vector::Constant(1, 2.0);
  const Report report = solve(F, u);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_NEAR(u[0], 1.0, 1e-5);
}

TEST(Domain, StartOutsideNamesTheComponentAndKeepsU) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array().sqrt() - 2.0; };
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Vector u(4);
    u << 1, 2, -3, 4;
    const Vector before = u;
    const Report report = solve(F, u, options);
    EXPECT_EQ(report.status, Status::out_of_domain_at_start);
    EXPECT_EQ(report.worst_component, 2);
    EXPECT_EQ(report.counts.total(), 1);
    EXPECT_TRUE(std::isnan(report.residual_norm));
    EXPECT_NE(report.reason.find("component 2 is not finite"), std::string::npos);
    EXPECT_TRUE((u.array() == before.array()).all());
  }
}

TEST(Domain, NanInTheFirstGuessIsNamedWithoutAnEvaluation) {
  Vector u = Vector::Zero(5);
  u[3] = nan;
  const Report report = solve([](const Vector& v, Vector& r) { r = v; }, u);
  EXPECT_EQ(report.status, Status::out_of_domain_at_start);
  EXPECT_EQ(report.worst_component, 3);
  EXPECT_EQ(report.counts.total(), 0);
}

TEST(Domain, RefusalAtTheStartWithoutNanSaysSo) {
  Vector u = Vector::Zero(2);
  const Report report = solve([](const Vector&, Vector&) { return false; }, u);
  EXPECT_EQ(report.status, Status::out_of_domain_at_start);
  EXPECT_EQ(report.worst_component, -1);
  EXPECT_NE(report.reason.find("declared the first u out of its domain"), std::string::npos);
}

TEST(Domain, NanIsNeverASuccess) {
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    options.tolerances.absolute = 1e300;
    options.tolerances.step = 0.5;  // so that the start alone does not end it
    int calls = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      r = u;
      if (++calls > 1) r[0] = nan;
    };
    Vector u = Vector::Ones(3);
    const Report report = solve(F, u, options);
    EXPECT_FALSE(report.converged());
    EXPECT_TRUE((u.array() == 1.0).all());
    EXPECT_EQ(report.residual_norm, std::sqrt(3.0));
  }
}

// With zeros in r, whoever forgets a component would be told that it is solved.
TEST(Domain, AComponentThatFForgetsIsNamedAndNeverASuccess) {
  const auto forgets = [](const Vector& u, Vector& r) {
    r[0] = u[0] - 1.0;
    r[2] = u[2] - 1.0;
  };
  const auto adds = [](const Vector& u, Vector& r) { r += u - Vector::Ones(3); };
  // Not at the start, but where it matters.
  const auto forgets_later = [](const Vector& u, Vector& r) {
    r[0] = u[0] - 1.0;
    r[2] = u[2] - 1.0;
    if (u[1] > 1.5) r[1] = u[1] - 2.0;
  };
  for (const jfnk::Method method : jfnk_test::all_methods) {
    Options options;
    options.method = method;
    Vector u = Vector::Constant(3, 3.0);
    Report report = jfnk::solve(forgets, u, options);
    EXPECT_EQ(report.status, Status::out_of_domain_at_start);
    EXPECT_EQ(report.worst_component, 1);
    EXPECT_NE(report.reason.find("did not write component 1"), std::string::npos) << report.reason;
    report = jfnk::solve(adds, u, options);
    EXPECT_NE(report.reason.find("did not write component 0"), std::string::npos) << report.reason;
    u = Vector::Constant(3, 3.0);
    report = jfnk::solve(forgets_later, u, options);
    EXPECT_TRUE(!report.converged() || u[1] > 1.5) << report.reason;
  }
  // By way of another kind of vector.
  std::vector<float> v(3, 3.0F);
  const Report report = jfnk::solve(
      [](const std::vector<float>& x, std::vector<float>& r) { r[0] = x[0] - 1.0F; }, v);
  EXPECT_NE(report.reason.find("did not write component 1"), std::string::npos) << report.reason;
}

TEST(Domain, ARefusalNeedNotWriteAnything) {
  Vector u = Vector::Ones(3);
  const auto refuses = [](const Vector& v, Vector& r) {
    r[0] = v[0];
    return false;
  };
  const Report report = jfnk::solve(refuses, u);
  EXPECT_EQ(report.status, Status::out_of_domain_at_start);
  EXPECT_EQ(report.worst_component, -1);
  EXPECT_NE(report.reason.find("declared"), std::string::npos) << report.reason;
}

TEST(Domain, NanReferenceNormIsARefusal) {
  struct Strange {
    void operator()(const Vector& u, Vector& r) const { r = u; }
    double reference_norm() const { return nan; }
  };
  Vector u = Vector::Ones(2);
  EXPECT_EQ(solve(Strange{}, u).status, Status::out_of_domain_at_start);
}

TEST(Domain, StopEndsTheSolveAtOnceWithTheBestPoint) {
  for (const Method method : all_methods) {
    for (const int last : {1, 2, 3, 5, 8}) {
      Options options;
      options.method = method;
      options.tolerances.relative = 1e-14;
      int calls = 0;
      const auto F = [&](const Vector& u, Vector& r) {
        if (++calls >= last) return Evaluation::stop;
        r = u.array() + 0.2 * u.array().sin() - Vector::LinSpaced(4, 1.0, 5.0).array();
        return Evaluation::ok;
      };
      Vector u = Vector::Zero(4);
      const Report report = solve(F, u, options);
      EXPECT_EQ(report.status, Status::stopped) << last;
      EXPECT_EQ(calls, last);
      EXPECT_EQ(report.counts.total(), last);
      if (last > 1) {
        Vector r(4);
        calls = -100;
        F(u, r);
        EXPECT_DOUBLE_EQ(r.norm(), report.residual_norm);  // sums in another order
      }
    }
  }
}

TEST(Domain, DecliningToLineariseIsReported) {
  struct Declining {
    void operator()(const Vector& u, Vector& r) const { r = u; }
    bool linearise(const Vector&) { return false; }
    void apply_jacobian(const Vector& v, Vector& Jv) const { Jv = v; }
  };
  Options options = jfnk::newton_krylov();
  options.stagnation.restart = false;
  options.pseudo_transient.enabled = false;
  Vector u = Vector::Ones(2);
  const Report report = solve(Declining{}, u, options);
  EXPECT_EQ(report.status, Status::linearisation_failed);
  EXPECT_EQ(report.counts.linearisations, 1);
  EXPECT_EQ(report.counts.user_actions, 0);
}

}  // namespace

#include <gtest/gtest.h>
#include <malloc.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Method;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;
using jfnk_test::all_methods;

Options by(Method method) {
  Options options;
  options.method = method;
  return options;
}

struct Halving {
  void apply(const Vector& r, Vector& z) const { z = 0.5 * r; }
};

/// By each method, without and with a preconditioner.
template <class F>
std::vector<Report> all_reports(const F& f, const Vector& start) {
  std::vector<Report> reports;
  for (const Method method : all_methods) {
    Vector u = start;
    reports.push_back(solve(f, u, by(method)));
    u = start;
    reports.push_back(solve(f, u, by(method), Halving{}));
  }
  return reports;
}

/// What a solve may say where there is no root to be found.
bool says_why(const Report& report) {
  return report.status == Status::local_minimum || report.status == Status::krylov_stalled ||
         report.status == Status::line_search_failed || report.status == Status::stagnated ||
         report.status == Status::multisecant_stalled;
}

TEST(Extremes, OneUnknownOfEveryShape) {
  const auto expect_root = [](double start, double root, auto f) {
    for (const Method method : {Method::newton_krylov, Method::hybrid}) {
      Options options = by(method);
      options.tolerances.relative = 1e-9;
      Vector u = Vector::Constant(1, start);
      const Report report = solve([&](const Vector& v, Vector& r) { r[0] = f(v[0]); }, u, options);
      EXPECT_TRUE(report.converged()) << root << ": " << report.reason;
      EXPECT_NEAR(u[0], root, 1e-4 * std::max(1.0, std::abs(root)));
    }
  };
  expect_root(3.0, 0.0, [](double x) { return std::atan(x); });  // full Newton steps diverge
  expect_root(5.0, 1.0, [](double x) { return std::log(x); });   // and leave the domain
  expect_root(2.0, 1.0, [](double x) { return x * x * x - 1.0; });
  expect_root(0.0, 20.0, [](double x) { return std::exp(0.1 * x) - std::exp(2.0); });
  expect_root(-7.0, 1.0, [](double x) { return x > 1.0 ? 5.0 * (x - 1.0) : x - 1.0; });
}

TEST(Extremes, AMillionUnknowns) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array() + u.array().cube() - 2.0; };
  Vector u = Vector::Zero(1000000);
  const Report report = solve(F, u);
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_NEAR(u[999999], 1.0, 1e-5);
}

TEST(Extremes, AMillionUnknownsInSinglePrecision) {
  const auto F = [](const Eigen::VectorXf& u, Eigen::VectorXf& r) {
    r = u.array() + u.array().cube() - 2.0F;
  };
  Eigen::VectorXf u = Eigen::VectorXf::Zero(1000000);
  Options options;
  options.tolerances.relative = 1e-5;
  const Report report = solve(F, u, options);
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_NEAR(u[999999], 1.0F, 1e-4F);
}

TEST(Extremes, SingularConsistentSystemIsSolved) {
  // Rank one: u0 + u1 = 2 twice.
  const auto F = [](const Vector& u, Vector& r) { r.setConstant(u[0] + u[1] - 2.0); };
  for (const Method method : all_methods) {
    Vector u = Vector::Zero(2);
    const Report report = solve(F, u, by(method));
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_NEAR(u.sum(), 2.0, 1e-5);
  }
}

// Diffusion between insulated ends: the Jacobian annihilates a vector at every u, and the
// right-hand side is in its range as the sources add up to zero.
TEST(Extremes, ARankMissingEverywhereDoesNotHinder) {
  constexpr int n = 40;
  const auto flux = [](double a, double b) { return (a + a * a * a) - (b + b * b * b); };
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      r[i] = (i > 0 ? flux(u[i], u[i - 1]) : 0.0) + (i + 1 < n ? flux(u[i], u[i + 1]) : 0.0) -
             (i < n / 2 ? 0.01 : -0.01);
    }
  };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Vector u = Vector::Zero(n);
    EXPECT_TRUE(solve(F, u, by(method)).converged());
    u.setZero();
    EXPECT_TRUE(solve(F, u, by(method), Halving{}).converged());
  }
}

TEST(Extremes, AJacobianThatVanishesAtTheStartIsLeftBehind) {
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Vector u = Vector::Zero(3);
    const Report report =
        solve([](const Vector& v, Vector& r) { r = v.array().square() - 1.0; }, u, by(method));
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_LE((u.array().abs() - 1.0).abs().maxCoeff(), 1e-5);
  }
}

// Half of the equations say twice what the others say: GMRES, which has no transpose, need not find
// the root, but must not claim one.
TEST(Extremes, HalfOfTheRankMissingIsNeverAFalseSuccess) {
  constexpr int n = 40;
  const auto F = [](const Vector& u, Vector& r) {
    for (int i = 0; i < n / 2; ++i) {
      r[2 * i] = u[i] * u[i] * u[i] + u[i] - 2.0;
      r[2 * i + 1] = 2.0 * r[2 * i];
    }
  };
  for (const Report& report : all_reports(F, Vector::Zero(n))) {
    EXPECT_TRUE(report.converged() ? report.residual_norm <= report.tolerance : says_why(report))
        << report.reason;
  }
}

TEST(Extremes, ARootAtTheStartCostsOneEvaluationWhateverIsAsked) {
  const auto F = [](const Vector& u, Vector& r) { r = u.array().square() - 4.0; };
  for (const Method method : all_methods) {
    Options options = by(method);
    options.tolerances.relative = 0.0;
    options.tolerances.step = 1e-12;  // there is no step to be short
    Vector u = Vector::Constant(4, 2.0);
    const Report report = solve(F, u, options, Halving{});
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_EQ(report.counts.total(), 1);
    EXPECT_EQ(report.history.size(), 1u);
    EXPECT_TRUE((u.array() == 2.0).all());
  }
}

TEST(Extremes, AResidualThatIsZeroEverywhereIsASuccessAtOnce) {
  for (const Report& report :
       all_reports([](const Vector&, Vector& r) { r.setZero(); }, Vector::Constant(3, 0.25))) {
    EXPECT_TRUE(report.converged());
    EXPECT_EQ(report.counts.total(), 1);
  }
}

TEST(Extremes, AConstantResidualGivesNoDirectionInAnyUnit) {
  for (const double value :
       {1.0, -1e300, 1e-300, std::numeric_limits<double>::denorm_min() * 1000.0}) {
    const auto F = [&](const Vector&, Vector& r) { r.setConstant(value); };
    for (const Method method : all_methods) {
      Vector u = Vector::Constant(3, 0.25);
      const Report report = solve(F, u, by(method));
      EXPECT_EQ(report.status, method == Method::multisecant ? Status::multisecant_stalled
                                                             : Status::krylov_stalled)
          << report.reason;
      EXPECT_LT(report.counts.total(), 200);
      EXPECT_TRUE((u.array() == 0.25).all());
    }
  }
}

TEST(Extremes, AnEquationWithoutUnknownsIsNamedAsTheWorst) {
  const auto F = [](const Vector& u, Vector& r) {
    r = u.array() - 1.0;
    r[1] = 5.0;
  };
  for (const Report& report : all_reports(F, Vector::Zero(3))) {
    EXPECT_TRUE(says_why(report)) << report.reason;
    EXPECT_EQ(report.worst_component, 1);
    EXPECT_NEAR(report.residual_norm, 5.0, 1e-5);  // the others are solved
  }
}

TEST(Extremes, InconsistentLinesEndAtTheirLeastSquares) {
  const auto F = [](const Vector& u, Vector& r) {
    r[0] = u[0] + u[1] - 2.0;
    r[1] = u[0] + u[1] - 4.0;
  };
  for (const Method method : {Method::newton_krylov, Method::hybrid}) {
    Vector u = Vector::Zero(2);
    const Report report = solve(F, u, by(method));
    EXPECT_TRUE(report.status == Status::local_minimum || report.status == Status::krylov_stalled)
        << report.reason;
    EXPECT_NEAR(report.residual_norm, std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(u.sum(), 3.0, 1e-3);
  }
}

TEST(Extremes, SystemsWithoutARootEndInFiniteTimeWithAReason) {
  const auto expect_failure = [](double infimum, double start, auto f) {
    for (const Report& report :
         all_reports([&](const Vector&u, Vector&r) { r = f(u.array()).matrix(); },
                     Vector::Constant(3, start))) {
      EXPECT_TRUE(says_why(report)) << report.reason;
      EXPECT_GE(report.residual_norm, std::sqrt(3.0) * infimum * (1.0 - 1e-12));
      EXPECT_LT(report.counts.total(), 1000);
    }
  };
  expect_failure(1.0, 1.7, [](const auto& u) { return Eigen::ArrayXd(u.square() + 1.0); });
  // The infimum lies at infinity.
  expect_failure(2.0 - std::atan(1.0) * 2.0, 0.0,
                 [](const auto& u) { return Eigen::ArrayXd(u.atan() - 2.0); });
}

TEST(Extremes, SinglePrecisionIsAsHonest) {
  for (const Method method : all_methods) {
    Eigen::VectorXf u = Eigen::VectorXf::Constant(2, 1.7F);
    const Report without_root =
        solve([](const Eigen::VectorXf& v, Eigen::VectorXf& r) { r = v.array().square() + 1.0F; },
              u, by(method));
    EXPECT_TRUE(says_why(without_root)) << without_root.reason;
    const Report constant =
        solve([](const Eigen::VectorXf&, Eigen::VectorXf& r) { r.setOnes(); }, u, by(method));
    EXPECT_TRUE(says_why(constant)) << constant.reason;
    const Report zero =
        solve([](const Eigen::VectorXf&, Eigen::VectorXf& r) { r.setZero(); }, u, by(method));
    EXPECT_TRUE(zero.converged());
  }
}

TEST(Extremes, ResidualsIn1e300UnitsAndTheirInverse) {
  const jfnk_test::Bratu bratu(8, 5.0);
  for (const Method method : all_methods) {
    Vector reference = Vector::Zero(64);
    const Report plain = solve(bratu, reference, by(method));
    ASSERT_TRUE(plain.converged()) << plain.reason;
    for (const double unit : {1e-300, 1e300}) {
      const auto F = [&](const Vector& u, Vector& r) {
        bratu(u, r);
        r *= unit;
      };
      Vector u = Vector::Zero(64);
      const Report report = solve(F, u, by(method));
      EXPECT_TRUE(report.converged()) << unit << " " << report.reason;
      EXPECT_LE((u - reference).norm(), 1e-4 * reference.norm());
      EXPECT_LE(report.counts.total(), 2 * plain.counts.total());
    }
  }
}

TEST(Extremes, UnknownsIn1e300UnitsAndTheirInverse) {
  const jfnk_test::Bratu bratu(8, 5.0);
  for (const Method method : all_methods) {
    Vector reference = Vector::Zero(64);
    ASSERT_TRUE(solve(bratu, reference, by(method)).converged());
    for (const double unit : {1e-300, 1e300}) {
      const auto F = [&](const Vector& u, Vector& r) { bratu(u / unit, r); };
      Options options = by(method);
      options.u_scale = Vector::Constant(64, unit);
      Vector u = Vector::Zero(64);
      const Report report = solve(F, u, options);
      EXPECT_TRUE(report.converged()) << unit << " " << report.reason;
      EXPECT_LE((u / unit - reference).norm(), 1e-4 * reference.norm());
    }
  }
}

double scatter(double u) {
  auto z = std::bit_cast<std::uint64_t>(u);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return 2.0 * static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53 - 1.0;
}

TEST(Extremes, AHundredThousandEvaluationsOfOneSolveEndAtTheLimit) {
  constexpr int limit = 100000;
  Options options = by(Method::multisecant);
  options.max_evaluations = limit;
  options.max_iterations = std::numeric_limits<int>::max();
  options.multisecant.memory = 5;
  options.multisecant.patience = std::numeric_limits<int>::max();
  options.multisecant.wild_patience = std::numeric_limits<int>::max();
  int calls = 0;
  const auto F = [&](const Vector& u, Vector& r) {
    ++calls;
    for (Eigen::Index i = 0; i < u.size(); ++i) r[i] = 2.0 + scatter(u[i]);  // between 1 and 3
  };
  Vector u = Vector::Ones(3);
  const Report report = solve(F, u, options);
  EXPECT_EQ(report.status, Status::evaluation_limit) << report.reason;
  EXPECT_EQ(calls, limit);
  EXPECT_EQ(report.counts.total(), limit);
}

class OneSolver : public testing::TestWithParam<bool> {};

TEST_P(OneSolver, DoesNotGrowInAHundredThousandEvaluations) {
  const jfnk_test::Bratu bratu(6, 5.0);
  const bool learning = GetParam();
  Options options;
  options.learning.enabled = learning;
  Solver solver(options);
  int evaluations = 0;
  const auto live = [] { return mallinfo2().uordblks; };
  const auto solve_both = [&] {
    Vector u = Vector::Zero(36);
    const Report& success = solver.solve(bratu, u);
    EXPECT_TRUE(success.converged());
    evaluations += success.counts.total();
    u.setConstant(1.7);
    const Report& failure =
        solver.solve([](const Vector& v, Vector& r) { r = v.array().square() + 1.0; }, u);
    EXPECT_FALSE(failure.converged());
    evaluations += failure.counts.total();
  };
  for (int i = 0; i < 10; ++i) solve_both();
  const auto before = live();
  while (evaluations < 100000) solve_both();
  // Factors are allocated anew by each solve, in blocks that need not be rounded alike.
  const std::size_t rounding = learning ? 4096 : 0;
  EXPECT_LE(live(), before + rounding);
}
INSTANTIATE_TEST_SUITE_P(WithoutAndWithLearning, OneSolver, testing::Bool());

}  // namespace

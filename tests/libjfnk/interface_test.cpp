#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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

TEST(Scales, PowersOfTwoChangeNoBitOfTheCourse) {
  const jfnk_test::Bratu bratu(8, 5.0);
  const auto n = static_cast<Eigen::Index>(bratu.size());
  Vector us(n);
  Vector fs(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    us[i] = std::ldexp(1.0, static_cast<int>(i % 41) - 20);
    fs[i] = std::ldexp(1.0, static_cast<int>((7 * i) % 53) - 26);
  }
  const auto other_units = [&](const Vector& u, Vector& r) {
    bratu(u.cwiseQuotient(us), r);
    r.array() *= fs.array();
  };
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(8));
  struct InOtherUnits {
    const jfnk_test::CholeskyPreconditioner& P;
    const Vector& us;
    const Vector& fs;
    void apply(const Vector& r, Vector& z) const {
      P.apply(r.cwiseQuotient(fs), z);
      z.array() *= us.array();
    }
  } const P2{P, us, fs};
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Vector plain = Vector::Zero(n);
    const Report expected = solve(bratu, plain, options, P);
    options.u_scale = us;
    options.f_scale = fs;
    Vector u = Vector::Zero(n);
    const Report report = solve(other_units, u, options, P2);
    EXPECT_EQ(report.counts.total(), expected.counts.total());
    EXPECT_EQ(report.residual_norm, expected.residual_norm);
    EXPECT_TRUE((u.array() == (plain.array() * us.array())).all());
  }
}

TEST(Scales, OfAnotherSizeAreRefusedWithBothNumbers) {
  Options options;
  options.u_scale = Vector::Ones(3);
  Vector u = Vector::Ones(2);
  try {
    (void)solve([](const Vector& v, Vector& r) { r = v; }, u, options);
    FAIL() << "a scale of another size was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "jfnk::Solver: u has size 2, u_scale has size 3");
  }
}

TEST(Bounds, AreNeverCrossedByAnyEvaluation) {
  // Newton from 3 goes to -0.3 first; at and below 0 the logarithm has no value.
  const double lower = 1e-3;
  const double upper = 4.0;
  for (const Method method : all_methods) {
    const auto F = [&](const Vector& u, Vector& r) {
      EXPECT_GE(u.minCoeff(), lower);
      EXPECT_LE(u.maxCoeff(), upper);
      r = u.array().log() + 1.0;
    };
    Options options;
    options.method = method;
    options.lower = Vector::Constant(3, lower);
    options.upper = Vector::Constant(3, upper);
    Vector u(3);
    u << 3.0, 4.0, 1e-3;
    const Report report = solve(F, u, options);
    if (method == Method::multisecant) continue;  // has nobody to rescue it
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_NEAR(u[0], std::exp(-1.0), 1e-5);
  }
}

TEST(Bounds, RefuseAStartOutside) {
  Options options;
  options.lower = Vector::Zero(2);
  Vector u(2);
  u << 1.0, -1.0;
  EXPECT_THROW((void)solve([](const Vector& v, Vector& r) { r = v; }, u, options),
               std::invalid_argument);
}

/// Stiff in loading, soft in unloading: which it is depends on the last accepted point only.
struct Hysteresis {
  void operator()(const Vector& u, Vector& r) const {
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      const double du = u[i] - accepted[i];
      r[i] = force[i] + (du > 0.0 ? 1.0 : 0.5) * du - 1.0;
    }
  }
  void on_accept(const Vector& u) {
    Vector r(u.size());
    (*this)(u, r);
    force = r.array() + 1.0;
    accepted = u;
    ++accepts;
  }
  Vector accepted = Vector::Zero(4);
  Vector force = Vector::LinSpaced(4, 0.0, 3.0);
  int accepts = 0;
};

TEST(OnAccept, ReachesResidualsThatRememberAndIsCalledAtEachAcceptedPoint) {
  for (const Method method : all_methods) {
    Hysteresis F;
    Options options;
    options.method = method;
    Vector u = Vector::Zero(4);
    const Report report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_GE(F.accepts, static_cast<int>(report.history.size()));
    EXPECT_TRUE((F.accepted.array() == u.array()).all());
  }
}

TEST(StepFilter, MayShortenEveryStep) {
  struct Careful {
    void operator()(const Vector& u, Vector& r) const { r = u.array().exp() - 20.0; }
    void filter_step(const Vector&, Vector& du) {
      longest = std::max(longest, du.cwiseAbs().maxCoeff());
      du = du.cwiseMax(-0.5).cwiseMin(0.5);
    }
    double longest = 0.0;
  };
  for (const Method method : all_methods) {
    Careful F;
    Options options;
    options.method = method;
    Vector u = Vector::Zero(2);
    const Report report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_GT(F.longest, 0.5);
    for (const auto& line : report.history) {
      EXPECT_LE(line.step_norm, 0.5 * std::sqrt(2.0) * (1.0 + 1e-12));
    }
  }
}

TEST(Vectors, OfTheStandardLibraryServeWithAllOptionalMembers) {
  struct Full {
    void operator()(const std::vector<double>& u, std::vector<double>& r) const {
      for (std::size_t i = 0; i < u.size(); ++i) r[i] = u[i] * u[i] - static_cast<double>(i + 1);
    }
    void linearise(const std::vector<double>& u) { at = u; }
    bool apply_jacobian(const std::vector<double>& v, std::vector<double>& Jv) const {
      for (std::size_t i = 0; i < v.size(); ++i) Jv[i] = 2.0 * at[i] * v[i];
      return true;
    }
    void on_accept(const std::vector<double>&) { ++accepts; }
    std::vector<double> at;
    int accepts = 0;
  };
  struct Halving {
    void apply(const std::vector<double>& r, std::vector<double>& z) const {
      for (std::size_t i = 0; i < r.size(); ++i) z[i] = 0.5 * r[i];
    }
  };
  Full F;
  std::vector<double> u(5, 2.0);
  const Report report = solve(F, u, jfnk::newton_krylov(), Halving{});
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.user_actions, 0);
  EXPECT_EQ(report.counts.difference_actions, 0);
  EXPECT_GT(report.counts.preconditioner, 0);
  EXPECT_GT(F.accepts, 1);
  EXPECT_NEAR(u[3], 2.0, 1e-5);
  EXPECT_NEAR(u[4], std::sqrt(5.0), 1e-5);
}

TEST(Vectors, GiveBitForBitWhatEigenGives) {
  const jfnk_test::Bratu bratu(8, 5.0);
  Vector expected = Vector::Zero(64);
  ASSERT_TRUE(solve(bratu, expected).converged());
  const auto F = [&](const std::vector<double>& u, std::vector<double>& r) {
    Vector image(64);
    bratu(Eigen::Map<const Vector>(u.data(), 64), image);
    std::copy(image.begin(), image.end(), r.begin());
  };
  std::vector<double> u(64, 0.0);
  ASSERT_TRUE(solve(F, u).converged());
  EXPECT_TRUE((Eigen::Map<Vector>(u.data(), 64).array() == expected.array()).all());
}

TEST(Vectors, OfSinglePrecisionConvergeToTheirOwnRounding) {
  const auto F = [](const Eigen::VectorXf& u, Eigen::VectorXf& r) {
    const Eigen::Index n = u.size();
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] = (3.0F - 2.0F * u[i]) * u[i] + 1.0F - (i > 0 ? u[i - 1] : 0.0F) -
             (i + 1 < n ? 2.0F * u[i + 1] : 0.0F);
    }
  };
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    options.tolerances.relative = 1e-5;
    Eigen::VectorXf u = Eigen::VectorXf::Constant(50, -1.0F);
    const Report report = solve(F, u, options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_NEAR(u[25], -std::sqrt(0.5F), 1e-4F);
  }
}

TEST(Vectors, AResidualThatResizesItsOutputIsRefused) {
  std::vector<double> u(3, 1.0);
  EXPECT_THROW(
      (void)solve([](const std::vector<double>&, std::vector<double>& r) { r.pop_back(); }, u),
      std::invalid_argument);
}

}  // namespace

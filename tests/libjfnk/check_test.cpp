#include "jfnk/check.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "problems.hpp"

namespace {

using jfnk::check;
using jfnk::CheckReport;
using jfnk::Options;
using jfnk::Vector;

/// A number in [-1, 1] that looks random and depends on the bits of u alone.
double scatter(double u) {
  auto z = std::bit_cast<std::uint64_t>(u);
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return 2.0 * static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1p-53 - 1.0;
}

bool mentions(const CheckReport& report, const char* words) {
  for (const std::string& finding : report.findings) {
    if (finding.find(words) != std::string::npos) return true;
  }
  return false;
}

const Vector point = Vector::LinSpaced(20, 0.5, 2.0);

TEST(Check, FindsNothingWrongWithASmoothResidualAndItsAction) {
  jfnk_test::BratuWithJacobian bratu(8, 4.0);
  const CheckReport report = check(bratu, Vector::LinSpaced(bratu.size(), 0.0, 1.0));
  EXPECT_TRUE(report.good);
  EXPECT_TRUE(report.findings.empty());
  EXPECT_TRUE(report.deterministic);
  EXPECT_TRUE(report.repeatable);
  EXPECT_NEAR(report.taylor_order, 2.0, 0.1);
  // Central differences at the cube root of the rounding unit are good to its square, 4e-11, times
  // F''' (1 + ||u||)^2, here below 100.
  EXPECT_LT(report.action_error, 4e-9);
  EXPECT_GT(report.evaluations, 0);
  EXPECT_EQ(report.suggested_noise, jfnk::Jacobian{}.noise);
}

TEST(Check, FindsAWrongAction) {
  struct Wrong {
    void operator()(const Vector& u, Vector& r) const { r = u.array().cube(); }
    void linearise(const Vector& u) { slope = 2.4 * u.array().square(); }  // not 3
    void apply_jacobian(const Vector& v, Vector& Jv) const { Jv = slope.cwiseProduct(v); }
    Vector slope;
  };
  const CheckReport report = check(Wrong{}, point);
  EXPECT_FALSE(report.good);
  EXPECT_NEAR(report.taylor_order, 1.0, 0.1);
  EXPECT_NEAR(report.action_error, 0.25, 1e-6);  // (3 - 2.4) / 2.4
  EXPECT_TRUE(mentions(report, "apply_jacobian differs"));
}

TEST(Check, FindsAResidualThatRemembers) {
  struct Remembering {
    void operator()(const Vector& u, Vector& r) {
      r = u.array() + last;
      last = 0.1 * u[0];
    }
    double last = 0.0;
  };
  const CheckReport report = check(Remembering{}, point);
  EXPECT_TRUE(report.deterministic);
  EXPECT_FALSE(report.repeatable);
  EXPECT_TRUE(mentions(report, "on_accept"));
}

TEST(Check, FindsChance) {
  int calls = 0;
  const auto F = [&](const Vector& u, Vector& r) { r = u.array() * (1.0 + 1e-9 * ++calls); };
  const CheckReport report = check(F, point);
  EXPECT_FALSE(report.deterministic);
  EXPECT_FALSE(report.good);
}

TEST(Check, MeasuresTheNoise) {
  constexpr double level = 1e-6;
  const auto F = [](const Vector& u, Vector& r) {
    for (Eigen::Index i = 0; i < u.size(); ++i) r[i] = std::exp(u[i]) + level * scatter(u[i]);
  };
  const CheckReport report = check(F, point);
  // Uniform on [-level, level]: deviation level / sqrt(3) in each of 20 components. The estimate is
  // one of 7 points and 4 projections, good to a factor (Moré & Wild 2011 ask for 4).
  const double expected = level / std::sqrt(3.0) * std::sqrt(20.0);
  EXPECT_GT(report.noise, expected / 4.0);
  EXPECT_LT(report.noise, expected * 4.0);
  EXPECT_GT(report.suggested_noise, 1e-5);
  EXPECT_TRUE(mentions(report, "jacobian.noise"));
}

TEST(Check, TellsHowNearTheDomainEnds) {
  const auto F = [](const Vector& u, Vector& r) { r = (u.array() - 0.499).log(); };
  const CheckReport report = check(F, point);
  EXPECT_GT(report.probes_out_of_domain, 0);
  EXPECT_LT(report.distance_to_domain_edge, 1e-2);
  EXPECT_TRUE(mentions(report, "F has no value"));
}

TEST(Check, SaysWhenThereIsNothingToCheck) {
  const CheckReport report = check([](const Vector&, Vector&) { return false; }, point);
  EXPECT_FALSE(report.evaluable);
  EXPECT_FALSE(report.good);
  EXPECT_EQ(report.evaluations, 1);
  EXPECT_THROW((void)check([](const Vector&, Vector&) {}, Vector()), std::invalid_argument);
}

TEST(Check, NamesTheComponentThatFForgets) {
  const auto F = [](const Vector& u, Vector& r) {
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      if (i != 7) r[i] = u[i] - 1.0;
    }
  };
  const CheckReport report = check(F, point);
  EXPECT_FALSE(report.good);
  EXPECT_TRUE(mentions(report, "did not write component 7"));
}

}  // namespace

#include <gtest/gtest.h>
#include <fpm/kernel.hpp>

#include <cmath>
#include <ostream>

namespace fpm {

// For the names of the tests.
static void PrintTo(Kernel kernel, std::ostream* out) {
  switch (kernel) {
    case Kernel::cubic_spline:
      *out << "cubic_spline";
      break;
    case Kernel::quintic_spline:
      *out << "quintic_spline";
      break;
    case Kernel::wendland_c2:
      *out << "wendland_c2";
      break;
  }
}

}  // namespace fpm

namespace {

using fpm::evaluate;
using fpm::Kernel;

class EveryKernel : public testing::TestWithParam<Kernel> {
 protected:
  static constexpr double radius = 0.7;
};

INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernel,
                         testing::Values(Kernel::cubic_spline, Kernel::quintic_spline,
                                         Kernel::wendland_c2),
                         testing::PrintToStringParamName());

TEST_P(EveryKernel, IsOneAndFlatAtItsCentre) {
  const auto w = evaluate(GetParam(), 0.0, radius);
  EXPECT_DOUBLE_EQ(w.value, 1.0);
  EXPECT_NEAR(w.derivative, 0.0, 1e-14 / radius);  // the quintic's slope is a sum of terms <= 400
}

TEST_P(EveryKernel, VanishesFromItsSupportOn) {
  for (const double r : {radius, 1.01 * radius, 10.0 * radius}) {
    const auto w = evaluate(GetParam(), r, radius);
    EXPECT_EQ(w.value, 0.0);
    EXPECT_EQ(w.derivative, 0.0);
  }
  // At least quadratic contact: W < (1 - r/R)^2 close to the edge.
  const double gap = 1e-3;
  EXPECT_LT(evaluate(GetParam(), (1.0 - gap) * radius, radius).value, 4.0 * gap * gap);
}

TEST_P(EveryKernel, IsPositiveAndFallsInsideItsSupport) {
  double previous = 1.0;
  for (int i = 1; i < 1000; ++i) {
    const auto w = evaluate(GetParam(), 1e-3 * i * radius, radius);
    EXPECT_GT(w.value, 0.0);
    EXPECT_LT(w.value, previous);
    EXPECT_LT(w.derivative, 0.0);
    previous = w.value;
  }
}

TEST_P(EveryKernel, DerivativeIsThatOfItsValue) {
  // Central differences: h^2/6 |W'''| + eps/h, with |W'''| < 200 / R^3 for all three.
  const double h = 1e-5 * radius;
  const double tolerance = (200.0 * 1e-10 / 6.0 + 2.3e-16 / 1e-5) / radius;
  for (int i = 1; i < 300; ++i) {
    const double r = i / 300.0 * radius;
    const double difference =
        (evaluate(GetParam(), r + h, radius).value - evaluate(GetParam(), r - h, radius).value) /
        (2.0 * h);
    EXPECT_NEAR(evaluate(GetParam(), r, radius).derivative, difference, tolerance) << "r = " << r;
  }
}

TEST_P(EveryKernel, DependsOnTheRatioToItsSupportAlone) {
  for (const double ratio : {0.1, 0.4, 0.5, 0.9}) {
    const auto unit = evaluate(GetParam(), ratio, 1.0);
    const auto large = evaluate(GetParam(), ratio * 1024.0, 1024.0);
    EXPECT_DOUBLE_EQ(large.value, unit.value);
    EXPECT_DOUBLE_EQ(large.derivative * 1024.0, unit.derivative);
  }
}

TEST(CubicSpline, HasThePublishedValues) {
  // q = 1 and q = 3/2 of 1 - 3/2 q^2 + 3/4 q^3 and (2 - q)^3 / 4.
  EXPECT_DOUBLE_EQ(evaluate(Kernel::cubic_spline, 1.0, 2.0).value, 0.25);
  EXPECT_DOUBLE_EQ(evaluate(Kernel::cubic_spline, 1.5, 2.0).value, 0.03125);
  EXPECT_DOUBLE_EQ(evaluate(Kernel::cubic_spline, 1.0, 2.0).derivative, -0.75);
}

TEST(Kernel, SupportIsThreeSmoothingLengthsForTheQuinticAndTwoOtherwise) {
  EXPECT_EQ(fpm::support_over_smoothing_length(Kernel::cubic_spline), 2.0);
  EXPECT_EQ(fpm::support_over_smoothing_length(Kernel::wendland_c2), 2.0);
  EXPECT_EQ(fpm::support_over_smoothing_length(Kernel::quintic_spline), 3.0);
}

}  // namespace

#include "convergence/convergence.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace convergence {
namespace {

// A search by thirds ends where squares of round-off (1e-16)^2 no longer differ: orders to some
// 1e-6.
constexpr double search = 1e-5;

std::vector<Sample> sampled(const std::function<double(double)>& value,
                            const std::vector<double>& sizes) {
  std::vector<Sample> samples;
  for (const double size : sizes) samples.push_back({size, value(size)});
  return samples;
}

TEST(Extrapolation, FindsLimitAndOrderOfAPowerWhateverTheRatioOfSizes) {
  for (const double order : {0.7, 1.0, 1.5, 2.0}) {
    const auto power = [&](double h) { return 3.0 - 0.4 * std::pow(h, order); };
    const Extrapolation found = extrapolate(sampled(power, {0.1, 0.02, 0.05}));
    EXPECT_EQ(found.course, Course::monotone);
    ASSERT_TRUE(found.order.has_value());
    EXPECT_NEAR(*found.order, order, search);
    EXPECT_NEAR(found.limit, 3.0, search);
    // 1.25 times the distance of the finest value (Roache 1994).
    EXPECT_NEAR(found.uncertainty, 1.25 * 0.4 * std::pow(0.02, order), search);
    EXPECT_FALSE(found.order_error.has_value()) << "three values leave nothing to judge by";
  }
}

// Composite trapezoid and Simpson rules of exp over 0..1, whose orders are 2 and 4.
TEST(Extrapolation, SeesTheOrdersOfTrapezoidAndSimpson) {
  const auto trapezoid = [](double h) {
    const int n = static_cast<int>(std::lround(1.0 / h));
    double sum = (1.0 + std::numbers::e) / 2.0;
    for (int i = 1; i < n; ++i) sum += std::exp(i * h);
    return sum * h;
  };
  const auto simpson = [&](double h) { return (4.0 * trapezoid(h / 2.0) - trapezoid(h)) / 3.0; };
  const double exact = std::numbers::e - 1.0;
  const std::vector<double> sizes{0.25, 0.125, 0.0625, 0.03125};

  const auto second = sampled(trapezoid, sizes);
  const Extrapolation of_second = extrapolate(second);
  // The next term of Euler and Maclaurin's series is -h^2/60 of the first, so the slope of log
  // error over log h is 2 - 2 h^2/60, at the coarsest.
  EXPECT_NEAR(of_second.order.value(), 2.0, 2.0 * 0.25 * 0.25 / 60.0);
  EXPECT_LE(std::abs(second.back().value - exact), of_second.uncertainty);
  EXPECT_LT(of_second.order_error.value(), 0.01);

  // An order above the formal one may be a cancellation: it is said, but the uncertainty is that of
  // the formal order.
  const auto fourth = sampled(simpson, sizes);
  const Extrapolation of_fourth = extrapolate(fourth);
  EXPECT_NEAR(of_fourth.order.value(), 4.0, 0.25 * 0.25);
  EXPECT_GT(of_fourth.uncertainty, 10.0 * std::abs(fourth.back().value - exact));
  EXPECT_LT(extrapolate(fourth, 4.5).uncertainty, of_fourth.uncertainty);
}

TEST(Extrapolation, OfANoisyPowerKnowsItsOrderWithinItsStandardErrorTwoTimesInThree) {
  // Noise of +-1 % of the smallest difference, by the low bits of a square root: no generator.
  int within = 0;
  constexpr int trials = 60;
  for (int trial = 0; trial < trials; ++trial) {
    double seed = std::sqrt(2.0 + trial);
    const auto noisy = [&](double h) {
      seed = std::fmod(seed * 997.0 + h, 1.0);
      return 1.0 + h * std::sqrt(h) + 1e-4 * (seed - 0.5);
    };
    const Extrapolation found = extrapolate(sampled(noisy, {0.4, 0.3, 0.2, 0.15, 0.1, 0.07, 0.05}));
    if (std::abs(*found.order - 1.5) <= *found.order_error) ++within;
  }
  // 68 % of normal errors, less for the few samples; a factor of two in the error gives 38 or 95 %.
  EXPECT_GT(within, trials * 45 / 100);
  EXPECT_LT(within, trials * 90 / 100);
}

TEST(Extrapolation, OfOscillatingValuesTrustsNoneOfThem) {
  const Extrapolation found = extrapolate({{0.4, 1.2}, {0.2, 0.9}, {0.1, 1.0}});
  EXPECT_EQ(found.course, Course::oscillating);
  EXPECT_FALSE(found.order.has_value());
  EXPECT_EQ(found.limit, 1.0);
  EXPECT_DOUBLE_EQ(found.uncertainty, 3.0 * (1.2 - 0.9));
}

TEST(Extrapolation, OfValuesThatDoNotSettleTrustsNoneOfThem) {
  // Order 0.2: differences that hardly shrink; and differences that grow as the size falls.
  for (const auto& samples : {sampled([](double h) { return std::pow(h, 0.2); }, {0.4, 0.2, 0.1}),
                              std::vector<Sample>{{0.4, 1.0}, {0.2, 1.1}, {0.1, 1.4}}}) {
    const Extrapolation found = extrapolate(samples);
    EXPECT_EQ(found.course, Course::slow);
    EXPECT_DOUBLE_EQ(found.uncertainty,
                     3.0 * std::abs(samples.front().value - samples.back().value));
  }
}

TEST(Extrapolation, OfTwoValuesIsOfTheFormalOrderAndCautious) {
  const Extrapolation found = extrapolate({{0.1, 1.0}, {0.2, 1.3}}, 2.0);
  EXPECT_EQ(found.course, Course::two);
  EXPECT_NEAR(found.limit, 1.0 - 0.3 / 3.0, 1e-12);  // Richardson: (4 f1 - f2) / 3
  EXPECT_NEAR(found.uncertainty, 3.0 * 0.3 / 3.0, 1e-12);
}

TEST(Extrapolation, OfEqualValuesIsTheirValue) {
  const Extrapolation found = extrapolate({{0.1, 5.0}, {0.2, 5.0}, {0.4, 6.0}});
  EXPECT_NE(found.course, Course::still) << "the third differs";
  const Extrapolation still = extrapolate({{0.1, 5.0}, {0.2, 5.0}, {0.4, 5.0}});
  EXPECT_EQ(still.course, Course::still);
  EXPECT_EQ(still.limit, 5.0);
  EXPECT_EQ(still.uncertainty, 0.0);
}

TEST(Extrapolation, RefusesWhatHasNoAnswer) {
  EXPECT_THROW((void)extrapolate({{0.1, 1.0}}), std::invalid_argument);
  EXPECT_THROW((void)extrapolate({{0.1, 1.0}, {0.1, 2.0}}), std::invalid_argument);
  EXPECT_THROW((void)extrapolate({{0.0, 1.0}, {0.1, 2.0}}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)extrapolate({{0.1, nan}, {0.2, 2.0}}), std::invalid_argument);
}

TEST(SlopeOfErrors, IsTheOrderOfAPowerAndLeavesOutWhatHasNoLogarithm) {
  const auto slope = slope_of_errors({{0.1, 2e-3}, {0.2, -8e-3}, {0.4, 32e-3}, {0.8, 0.0}});
  ASSERT_TRUE(slope.has_value());
  EXPECT_NEAR(slope->order, 2.0, 1e-12);
  EXPECT_NEAR(slope->standard_error.value(), 0.0, 1e-7);
  EXPECT_FALSE(slope_of_errors({{0.1, 1.0}, {0.2, 0.0}}).has_value());
  EXPECT_FALSE(slope_of_errors({{0.1, 1.0}, {0.2, 2.0}})->standard_error.has_value());
}

}  // namespace
}  // namespace convergence

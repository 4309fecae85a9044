#include "stepping/patience.hpp"

#include <gtest/gtest.h>

namespace stepping {
namespace {

constexpr double increment = 1.0 / 170.0;  // sums of it are not exact

TEST(Patience, IsLostWhenItsAttemptsGainNoIncrement) {
  Patience patience(3, increment, 0.5);
  patience.attempted();
  patience.attempted();
  patience.reached(0.5 + 0.9 * increment);
  EXPECT_FALSE(patience.lost());
  patience.attempted();
  EXPECT_TRUE(patience.lost());
  EXPECT_EQ(patience.attempts(), 3);
  EXPECT_EQ(patience.mark(), 0.5);
}

TEST(Patience, IsRenewedByEveryIncrement) {
  Patience patience(2, increment, 0.0);
  double load = 0.0;
  for (int step = 0; step < 170; ++step) {
    patience.attempted();
    load += increment;
    patience.reached(load);
    ASSERT_EQ(patience.attempts(), 0) << step;
  }
  EXPECT_FALSE(patience.lost());
}

TEST(Patience, IsRenewedByManySmallSteps) {
  Patience patience(10, increment, 0.0);
  double load = 0.0;
  for (int step = 0; step < 800; ++step) {
    patience.attempted();
    load += increment / 8.0;
    patience.reached(load);
    ASSERT_FALSE(patience.lost()) << step;
  }
}

TEST(Patience, OfZeroAttemptsIsEndless) {
  Patience patience(0, increment, 0.0);
  for (int attempt = 0; attempt < 1000; ++attempt) patience.attempted();
  EXPECT_FALSE(patience.lost());
}

}  // namespace
}  // namespace stepping

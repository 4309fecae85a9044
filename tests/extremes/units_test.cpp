// The results do not depend on the units of length and stress.

#include "small_footing.hpp"

namespace extremes {
namespace {

// Nothing in the code has a unit of its own: powers of two change no bit.
TEST(Units, OfPowersOfTwoChangeNoBit) {
  constexpr double length = 1024.0, stress = 1.0 / 1048576.0;
  const Steps si = footing_steps(small_footing());
  const Steps other = footing_steps(small_footing(length, stress));
  ASSERT_EQ(si.size(), other.size());
  for (std::size_t k = 0; k < si.size(); ++k) {
    EXPECT_EQ(other[k].settlement, length * si[k].settlement);
    EXPECT_EQ(other[k].mean_pressure, stress * si[k].mean_pressure);
    EXPECT_EQ(other[k].corrected_pressure, stress * si[k].corrected_pressure);
    EXPECT_EQ(other[k].max_displacement, length * si[k].max_displacement);
    EXPECT_EQ(other[k].evaluations, si[k].evaluations);
  }
}

// Millimetres and kilopascals, kilometres and gigapascals: other roundings of the same numbers. The
// iterates of a solver with memory amplify them; where it stops bounds what can come of it.
TEST(Units, ChangeTheLoadLessThanTheSolverTolerance) {
  constexpr double tolerance = 1e-3;
  const Steps si = footing_steps(small_footing());
  const double units[][2] = {{1e3, 1e-3}, {1e-3, 1e-9}, {1.0, 1e6}};
  for (const auto& [length, stress] : units) {
    const Steps other = footing_steps(small_footing(length, stress));
    ASSERT_EQ(si.size(), other.size());
    double worst = 0.0;
    for (std::size_t k = 0; k < si.size(); ++k) {
      const double ratio = other[k].mean_pressure / (stress * si[k].mean_pressure);
      worst = std::max(worst, std::abs(ratio - 1.0));
    }
    report("worst_difference", worst);
    EXPECT_LT(worst, tolerance);
  }
}

}  // namespace
}  // namespace extremes

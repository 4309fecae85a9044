#include "material/error_map.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace material {
namespace {

ErrorMapCase case_of(const std::string& name) {
  for (const ErrorMapCase& one : error_map_cases()) {
    if (one.name == name) return one;
  }
  ADD_FAILURE() << "no case " << name;
  return {};
}

// On von Mises' cylinder the deviator turns towards the strain's direction: with psi the angle
// between them tan(psi/2) falls as exp(-2 G |e| / R), R = |s| (R. D. Krieg & D. B. Krieg, J.
// Pressure Vessel Technol. 99 (1977) 510). One step points along s + 2 G e. The error is their
// chord over R; the map measures |e| in R / 2 G.
double error_of_one_step(double outward, double across) {
  const double size = std::hypot(outward, across);
  if (size == 0.0) return 0.0;
  const double begin = std::atan2(std::abs(across), outward);
  const double exact = begin - 2.0 * std::atan(std::tan(begin / 2.0) * std::exp(-size));
  const double one = std::atan2(std::abs(across), 1.0 + outward);
  return 2.0 * std::sin(std::abs(exact - one) / 2.0);
}

TEST(AMap, OfVonMisesIsThatOfKriegAndKrieg) {
  const ErrorMap map = error_map(case_of("von_mises"), 9);
  ASSERT_EQ(map.error.size(), 81U);
  double largest = 0.0;
  for (std::size_t i = 0; i < map.outward.size(); ++i) {
    for (std::size_t j = 0; j < map.across.size(); ++j) {
      const double expected = error_of_one_step(map.outward[i], map.across[j]);
      // The two integrations it is extrapolated from differ by what the uncertainty says.
      EXPECT_NEAR(map.at(i, j), expected, map.uncertainty)
          << map.outward[i] << ' ' << map.across[j];
      largest = std::max(largest, expected);
    }
  }
  EXPECT_LT(map.uncertainty, 0.02 * largest);
}

// Extrapolation to first order leaves second order: four times as close with twice the parts.
TEST(AMap, ComesCloserWithSecondOrderOfItsParts) {
  const auto rest = [&](int parts) {
    const ErrorMap map = error_map(case_of("von_mises"), 3, 3.0, parts);
    return std::abs(map.at(2, 2) - error_of_one_step(3.0, 3.0));
  };
  EXPECT_NEAR(rest(20) / rest(40), 4.0, 0.4);
}

// The step goes from a point of the surface outwards: that very way is radial for every surface
// whose deviator shrinks without a turn, and one step is as good as many.
TEST(AMap, HasNoErrorAlongTheDeviatorOfACylinder) {
  const ErrorMap map = error_map(case_of("von_mises"), 5);
  for (std::size_t i = 0; i < map.outward.size(); ++i) EXPECT_LT(map.at(i, 2), 1e-12);
}

TEST(AMap, OfEverySurfaceFallsWithTheStep) {
  for (const ErrorMapCase& one : error_map_cases()) {
    const ErrorMap wide = error_map(one, 5, 4.0, 50), near = error_map(one, 5, 0.1, 50);
    const auto largest = [](const ErrorMap& map) {
      return *std::max_element(map.error.begin(), map.error.end());
    };
    EXPECT_GT(largest(wide), 0.01) << one.name;
    // One step of backward Euler is off by the square of its length at most, where it meets no
    // corner; 40 times shorter, a twentieth is far above that and far below no change at all.
    EXPECT_LT(largest(near), largest(wide) / 20.0) << one.name;
  }
}

ErrorMap plane_map(double slope_outward, double slope_across) {
  ErrorMap map;
  for (int i = 0; i < 5; ++i) {
    map.outward.push_back(i);
    map.across.push_back(i - 2);
  }
  for (const double out : map.outward) {
    for (const double side : map.across) {
      map.error.push_back(slope_outward * out + slope_across * side);
    }
  }
  return map;
}

TEST(AContour, OfALinearFieldIsItsLine) {
  const ErrorMap map = plane_map(1.0, 0.5);
  const Contour lines = contour(map, 1.3);
  std::size_t breaks = 0, points = 0;
  for (std::size_t k = 0; k < lines.outward.size(); ++k) {
    if (std::isnan(lines.outward[k])) {
      ++breaks;
      continue;
    }
    ++points;
    EXPECT_NEAR(lines.outward[k] + 0.5 * lines.across[k], 1.3, 1e-12);
  }
  EXPECT_EQ(breaks, 1U) << "one line";
  EXPECT_GE(points, 5U);
}

TEST(AContour, IsEmptyWhereTheFieldDoesNotComeToIt) {
  EXPECT_TRUE(contour(plane_map(1.0, 0.5), 99.0).outward.empty());
}

}  // namespace
}  // namespace material

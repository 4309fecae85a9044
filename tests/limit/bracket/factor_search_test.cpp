#include "limit/bracket/factor_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using limit::bracket::FactorSearch;

constexpr double most = 4.0;  // as multipliers are followed

// Values it takes to come within a part in 400 of the root.
int steps_to(double root, double first, const std::function<double(double)>& multiplier) {
  FactorSearch search(first);
  for (int step = 1; step < 40; ++step) {
    const double factor = search.root();
    if (std::abs(std::log(factor / root)) < 0.0025) return step;
    const double value = multiplier(factor);
    search.saw(factor, std::min(value, most), value >= most);
  }
  return 40;
}

// Clay: the multiplier is in proportion to the strength, and one value tells all but the slope.
TEST(FactorSearch, FindsTheFactorOfAClayFromFarAway) {
  for (const double root : {0.01, 0.7, 30.0}) {
    EXPECT_LE(steps_to(root, 1.0, [&](double factor) { return root / factor; }), 9) << root;
  }
}

// An infinite slope of depth D: M = c / (gamma D cos(b)^2 (F tan(b) - tan(phi))), without end up to
// tan(phi) / tan(b); the less cohesion, the steeper. Halving alone from a factor of three on would
// take 9 steps more than the way to it.
TEST(FactorSearch, FindsTheFactorWhereTheMultiplierHasNoEndBeforeIt) {
  for (const double friction : {0.5, 1.0, 6.0}) {  // tan(phi) / tan(b)
    for (const double cohesion : {1e-4, 1e-2, 1.0}) {
      const auto multiplier = [&](double factor) {
        const double lacking = factor - friction;
        return lacking > 0.0 ? cohesion / lacking : 1e9;
      };
      EXPECT_LE(steps_to(friction + cohesion, 1.0, multiplier), 18) << friction << ' ' << cohesion;
    }
  }
}

TEST(FactorSearch, GoesOnFromTheRootOfTheMeshBefore) {
  FactorSearch search(1.0);
  search.saw(1.0, 2.0, false);
  search.saw(2.0, 0.9, false);
  const double before = search.root();
  search.begin_anew();
  EXPECT_EQ(search.root(), before);
  EXPECT_TRUE(std::isinf(search.width()));
  search.saw(before, 1.1, false);  // the finer mesh bears more
  EXPECT_GT(search.root(), before);
  // What is no multiplier at all says nothing.
  const double root = search.root();
  search.saw(before, NAN, false);
  search.saw(before, -1.0, false);
  EXPECT_EQ(search.root(), root);
}

// Sand with a trace of cohesion: somewhere between these two the multiplier falls off, and where is
// for neither of them to say.
TEST(FactorSearch, DoesNotTrustASecantToNextToNothing) {
  FactorSearch search(1.0);
  search.saw(2.17, 1.15, false);
  search.saw(2.26, 0.08, false);
  EXPECT_GT(std::log(search.root() / 2.17), 0.19 * std::log(2.26 / 2.17));
  EXPECT_LT(search.root(), 2.26);
}

TEST(FactorSearch, ExpectsOfAFinerMeshWhatTheLastOneMakesLikely) {
  FactorSearch search(3.0);
  search.begin_anew(0.9);
  EXPECT_DOUBLE_EQ(search.root(), 2.7);
}

// Two mechanisms, one deep, which strength hardly matters to, and a skin of next to no cohesion:
// the multiplier falls slowly, and then off. A secant from one of them to the other creeps along
// the first: in steps of a twentieth of what is left, 60 of them, where halving takes 12.
TEST(FactorSearch, FindsWhereTheMultiplierFallsOff) {
  const auto multiplier = [](double factor) {
    const double deep = 3.0 / factor, skin = 1e-3 / std::max(1e-9, factor - 2.25);
    return std::min(deep, skin);
  };
  EXPECT_LE(steps_to(2.251, 2.4, multiplier), 12);
}

// A bound of the other side is mostly close, and a step of a half back from it a waste.
TEST(FactorSearch, GoesNoFurtherThanToldAtFirstAndFurtherEachTime) {
  FactorSearch search(1.0, 1.05);
  search.saw(1.0, 0.1, false);
  EXPECT_NEAR(search.root(), 1.0 / 1.05, 1e-12);
  search.saw(search.root(), 0.11, false);
  EXPECT_LT(search.root(), 1.0 / 1.15);
  EXPECT_GT(search.root(), 1.0 / 1.3);
}

// A solver's digits may contradict each other near the root: the last word counts.
TEST(FactorSearch, IsNotLostWhereValuesContradictEachOther) {
  FactorSearch search(1.0);
  search.saw(1.0, 1.001, false);
  search.saw(0.99, 0.999, false);
  EXPECT_LT(search.root(), 0.99);
  EXPECT_GT(search.root(), 0.9);
}

}  // namespace

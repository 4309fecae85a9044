// The table of share/doc/limit-analysis.md: exact values inside, and how close the bounds come.
#include <gmock/gmock.h>

#include <cstdio>
#include <numbers>
#include <string>

#include "limit/bracket/bracket.hpp"
#include "limit/problem/case.hpp"

namespace {

using namespace limit;

constexpr double degree = std::numbers::pi / 180.0;

struct Known {
  const char* name;
  double cohesion, phi, weight, half_width;
  bool rough;
  double exact;         // [Pa]
  double below, above;  // how far off the bounds may be, as shares
  double gap;           // asked for
};

class Table : public ::testing::TestWithParam<Known> {};

TEST_P(Table, BracketsTheExactValueClosely) {
  const Known& known = GetParam();
  problem::Strip strip;
  strip.soil = {known.cohesion, known.phi * degree, known.weight};
  strip.half_width = known.half_width;
  strip.rough = known.rough;
  bracket::BracketOptions options;
  options.gap = known.gap;
  const problem::Case problem = problem::strip_case(strip, std::nullopt);
  const bracket::Bracket found = bracket::bracket(problem, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  const double stress = problem.units.stress;
  const double lower = found.lower_bound() * stress, upper = found.upper_bound() * stress;
  double seconds = 0.0;
  for (const bracket::Attempt& attempt : found.attempts) seconds += attempt.seconds;
  std::printf(
      "%-14s exact %10.6g  lower %10.6g (%+.2f %%)  upper %10.6g (%+.2f %%)  gap %.2f %%  "
      "%zu and %zu triangles, %.0f s\n",
      known.name, known.exact, lower, 100 * (lower / known.exact - 1), upper,
      100 * (upper / known.exact - 1), 100 * found.gap(), found.lower->mesh.triangles.size(),
      found.upper->mesh.triangles.size(), seconds);
  EXPECT_LE(lower, known.exact);
  EXPECT_GE(upper, known.exact);
  EXPECT_GE(lower, (1.0 - known.below) * known.exact);
  EXPECT_LE(upper, (1.0 + known.above) * known.exact);
  EXPECT_LE(found.gap(), known.gap);
}

// Weightless: Prandtl's c N_c, closed form. With weight: method of characteristics, to its digits.
INSTANTIATE_TEST_SUITE_P(
    Strips, Table,
    ::testing::Values(
        Known{"phi_0", 1.0, 0.0, 0.0, 1.0, false, 5.141593, 0.005, 0.01, 0.01},
        Known{"phi_10", 1.0, 10.0, 0.0, 1.0, false, 8.344926, 0.005, 0.01, 0.01},
        Known{"phi_20", 1.0, 20.0, 0.0, 1.0, false, 14.834712, 0.005, 0.01, 0.01},
        Known{"phi_30", 1.0, 30.0, 0.0, 1.0, false, 30.139628, 0.005, 0.01, 0.009},
        Known{"phi_40", 1.0, 40.0, 0.0, 1.0, false, 75.313114, 0.005, 0.017, 0.009},
        Known{"phi_45", 1.0, 45.0, 0.0, 1.0, false, 133.873841, 0.01, 0.02, 0.015},
        Known{"phi_50", 1.0, 50.0, 0.0, 1.0, false, 266.881763, 0.01, 0.02, 0.02},
        Known{"paper_rough", 2.5e3, 20.0, 1850 * 9.81, 0.22, true, 58437.0, 0.0125, 0.0125, 0.02},
        Known{"paper_smooth", 2.5e3, 20.0, 1850 * 9.81, 0.22, false, 48752.0, 0.0125, 0.0125, 0.02},
        Known{"paper_rough_1", 2.5e3, 20.0, 1850 * 9.81, 0.22, true, 58437.0, 0.0075, 0.0075, 0.01},
        Known{"paper_smooth_1", 2.5e3, 20.0, 1850 * 9.81, 0.22, false, 48752.0, 0.0075, 0.0075,
              0.01}),
    [](const auto& info) { return std::string(info.param.name); });

// Beyond the default size, a box does not matter: the mechanism is inside, and the exact value of a
// half-space stays in a bracket as tight.
TEST(Boxes, DoNotMatterOnceTheMechanismFits) {
  problem::Strip strip;
  strip.soil = {2.5e3, 20.0 * degree, 1850 * 9.81};
  strip.half_width = 0.22;
  for (const double factor : {1.0, 1.5, 3.0}) {
    problem::Box box = problem::box_of(strip);
    box.width *= factor;
    box.depth *= factor;
    const problem::Case problem = problem::strip_case(strip, box);
    const bracket::Bracket found = bracket::bracket(problem, bracket::BracketOptions{}, {});
    EXPECT_TRUE(found.reached) << factor;
    EXPECT_LT(found.lower_bound() * problem.units.stress, 58437.0);
    EXPECT_GT(found.upper_bound() * problem.units.stress, 58437.0);
  }
}

}  // namespace

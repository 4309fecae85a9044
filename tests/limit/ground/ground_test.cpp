// Small brackets of ground whose answers are known.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string_view>

#include "limit/bracket/strength_reduction.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scenes.hpp"

namespace {

using namespace limit;
using ::testing::Contains;
using ::testing::HasSubstr;

// On the meshes to begin with; what is asserted is that the known value lies inside.
bracket::Solution coarse(const Read& made) {
  bracket::BracketOptions options;
  options.max_triangles = 1;
  return bracket::solution_of(made.found->associated, options, {});
}

class Shipped : public ::testing::TestWithParam<KnownGround> {};

TEST_P(Shipped, HoldsTheKnownValue) {
  const KnownGround& known = GetParam();
  const auto problem = shipped(known.scene);
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(*found.lower, known.high) << known.source;
  EXPECT_GE(*found.upper, known.low) << known.source;
  // A mesh that is not refined at all; this only finds gross errors.
  EXPECT_LE(found.gap(), 0.3);
}

// All but the slopes, which take a minute; the validation has them.
std::vector<KnownGround> quick_grounds() {
  std::vector<KnownGround> quick = known_grounds();
  std::erase_if(quick, [](const KnownGround& known) {
    return std::string_view(known.scene).starts_with("slope");
  });
  return quick;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Shipped, ::testing::ValuesIn(quick_grounds()),
                         [](const auto& info) { return std::string(info.param.scene); });

// A ring of clay of 1 m to 2 m bears 2 c ln 2 in its bore; of its 48 chords between the values of
// rings whose radii are those of circles within and around them.
TEST(Ground, ARingOfArcsBearsTheLogarithmOfItsRadii) {
  const Read made = read(R"([load]
sought = "traction"
[[material]]
name = "clay"
cohesion = 1.0
[[region]]
material = "clay"
outline = [{ centre = [0, 0], radius = 2, chords = 48 }]
holes = [[{ centre = [0, 0], radius = 1, chords = 48 }]]
[[side]]
name = "bore"
kind = "loaded"
live_pressure = 1
along = [{ centre = [0, 0], radius = 1, chords = 48 }]
[[side]]
name = "mantle"
kind = "free"
along = [{ centre = [0, 0], radius = 2, chords = 48 }]
)",
                         {});
  ASSERT_TRUE(made.found) << made.errors;
  bracket::BracketOptions options;
  options.gap = 0.1;
  const bracket::Solution found = bracket::solution_of(made.found->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  const double of_chords = std::cos(std::numbers::pi / 48.0);
  EXPECT_LT(*found.lower, 2.0 * std::log(2.0 / of_chords));
  EXPECT_GT(*found.upper, 2.0 * std::log(2.0 * of_chords));
  EXPECT_LE(found.gap(), options.gap);
}

TEST(Ground, AUniformTractionOnAStripCarriesPrandtlsPressure) {
  const Read made = read(layered, {"load.sought=traction", "side.footing.kind=loaded",
                                   "side.footing.live_pressure=2.0", "material.soft.cohesion=2.0"});
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  const double exact = 2.0 + std::numbers::pi;  // c / live_pressure = 1
  EXPECT_LT(*found.lower, exact);
  EXPECT_GT(*found.upper, exact);
  EXPECT_LT(found.gap(), 0.1);
}

// With one triangle in a corner, its stress would have the top's shear and none: no load at all.
TEST(Ground, AShearMayMeetAFreeSide) {
  const Read made = read(sheared);
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, 1.0);  // the block slips along its floor under the cohesion
  EXPECT_LT(found.gap(), 0.1);
}

TEST(Ground, StrengthOfClayIsReducedByTheFactorOfItsLoad) {
  // Without friction the factor of safety is the multiplier of all loads: 3.777 of a cut whose
  // gamma H / c is one; here half of it.
  const Read made = read(cut, {"load.sought=strength", "material.clay.unit_weight=2.0"});
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, 3.778 / 2);
  EXPECT_GT(*found.upper, 3.776 / 2);
  EXPECT_LT(found.gap(), 0.1);
  // Each bound is what its own field proves: the strength divided by it carries the loads.
  EXPECT_GE(found.bracket.lower->certificate.multiplier * made.found->associated.units.multiplier(),
            1.0);
  // On this side it is a turning block's.
  ASSERT_TRUE(found.block);
  EXPECT_LE(found.block->certificate.multiplier * made.found->associated.units.multiplier(), 1.0);
}

TEST(Ground, UnitsDoNotMatter) {
  const Read si = read(layered);
  const Read kilo =
      read(layered, {"material.crust.cohesion=0.002", "material.soft.cohesion=0.001"});
  const bracket::Solution a = coarse(si), b = coarse(kilo);
  ASSERT_TRUE(a.lower && b.lower && a.upper && b.upper);
  constexpr double digits = 1e-6;  // of the solver, see Bracket.DoesNotDependOnTheUnits
  EXPECT_NEAR(*a.lower / *b.lower, 1e3, 1e3 * digits);
  EXPECT_NEAR(*a.upper / *b.upper, 1e3, 1e3 * digits);
}

// The same meshes: what the footing cannot use makes no bound better.
TEST(Ground, AFootingThatMayLiftOffBearsNoMoreThanABondedOne) {
  std::vector<bracket::Solution> found;
  for (const bool tension : {true, false}) {
    auto problem = shipped("eccentric_lift_off");
    ASSERT_TRUE(problem);
    problem::Case& made = problem->associated;
    EXPECT_THAT(made.assumptions, Contains(HasSubstr("may lift off the soil")));
    // Smooth, so that no slip is paid for where it lifts off.
    for (problem::Problem* each : {&made.lower, &made.upper}) {
      each->boundaries[0].may_open = !tension;
      each->boundaries[0].tangential = problem::Known::traction;
    }
    bracket::BracketOptions options;
    options.max_triangles = 1;
    found.push_back(bracket::solution_of(made, options, {}));
    ASSERT_TRUE(found.back().lower && found.back().upper);
  }
  EXPECT_LT(*found[1].lower, *found[0].lower);
  EXPECT_LT(*found[1].upper, *found[0].upper);
  // Meyerhof's effective width, half the base.
  EXPECT_GT(*found[1].upper, 0.5e3 * (2.0 + std::numbers::pi));
}

// Of the base, nine tenths lift off: little stiffness beside the mean stresses of clay, which are
// free.
TEST(Ground, ALoadCloseToTheEdgeOfABaseThatLiftsOffNeedsNoFallBack) {
  const auto problem = shipped("eccentric_lift_off", {"load.eccentricity=0.9"});
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  ASSERT_EQ(found.bracket.attempts.size(), 2U);
  for (const bracket::Attempt& attempt : found.bracket.attempts) {
    EXPECT_EQ(attempt.status, solver::SolverStatus::solved) << attempt.message;
  }
  EXPECT_GT(*found.upper, 0.1e3 * (2.0 + std::numbers::pi));  // Meyerhof's effective width
}

TEST(StrengthReduction, DividesCohesionAndTheTangent) {
  const problem::Soil soil{10.0, 0.5, 18.0};
  const problem::Soil weak = bracket::weakened(soil, 2.0);
  EXPECT_DOUBLE_EQ(weak.cohesion, 5.0);
  EXPECT_DOUBLE_EQ(std::tan(weak.friction_angle), std::tan(0.5) / 2.0);
  EXPECT_EQ(weak.unit_weight, 18.0);
}

}  // namespace

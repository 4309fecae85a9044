// Strips at the edges of what is allowed: the bracket must hold, or say why there is none.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "limit/bracket/bracket.hpp"

namespace {

using namespace limit;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double pi = std::numbers::pi;

// Prandtl & Reissner: N_q, and N_c = (N_q - 1) cot(phi).
double bearing_q(double phi) {
  return std::exp(pi * std::tan(phi)) * std::pow(std::tan(pi / 4 + phi / 2), 2);
}
double bearing_c(double phi) {
  return (bearing_q(phi) - 1.0) / std::tan(phi);
}

struct Found {
  double lower, upper;  // in the strip's unit of stress
};

// On coarse meshes, without refinement.
Found bounds(const problem::Strip& strip, const std::optional<problem::Box>& wanted = std::nullopt,
             int rays = 16, int rings = 6) {
  const problem::Box box = wanted.value_or(problem::box_of(strip));
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const problem::Problem lower =
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, rays, rings, 1.5));
  const problem::Problem upper =
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, rays, rings, 2.0));
  const problem::Units units = problem::units_of(strip);
  const bracket::Bracket found =
      bracket::bracket(problem::in_units(lower, units), problem::in_units(upper, units), options);
  if (!found.lower || !found.upper) {
    ADD_FAILURE() << "a bound is missing";
    return {0.0, 0.0};
  }
  return {found.lower_bound() * units.stress, found.upper_bound() * units.stress};
}

problem::Strip strip_of(double cohesion, double phi, double weight, double surcharge = 0.0) {
  problem::Strip strip;
  strip.soil = {cohesion, phi * degree, weight};
  strip.surcharge = surcharge;
  strip.rough = false;
  return strip;
}

TEST(Extremes, HardlyAnyFriction) {
  const Found found = bounds(strip_of(1.0, 0.1, 0.0));
  const double exact = bearing_c(0.1 * degree);
  EXPECT_LT(found.lower, exact);
  EXPECT_GT(found.upper, exact);
  // As wide as without any friction on this mesh: nothing is lost to the almost flat cones.
  const Found clay = bounds(strip_of(1.0, 0.0, 0.0));
  EXPECT_NEAR((found.upper - found.lower) / (clay.upper - clay.lower), 1.0, 0.1);
}

TEST(Extremes, FortyFiveAndFiftyDegrees) {
  for (const double phi : {45.0, 50.0}) {
    const Found found = bounds(strip_of(1.0, phi, 0.0), std::nullopt, 30, 8);
    const double exact = bearing_c(phi * degree);
    EXPECT_LT(found.lower, exact);
    EXPECT_GT(found.upper, exact);
    // Meshes of this size are off by 5 % below and 25 % above, four times as many triangles by 7 %.
    EXPECT_GT(found.lower, 0.93 * exact);
    EXPECT_LT(found.upper, 1.3 * exact);
  }
}

// Weight only adds to what a rough strip on weightless soil bears.
TEST(Extremes, SteepFrictionUnderWeightAndSurcharge) {
  problem::Strip strip = strip_of(1.0, 45.0, 2.0, 0.5);
  strip.rough = true;
  const double weightless = bearing_c(45.0 * degree) + 0.5 * bearing_q(45.0 * degree);
  const Found found = bounds(strip);
  EXPECT_LT(found.lower, found.upper);
  EXPECT_GT(found.upper, weightless);
}

// Squeezed, such soil bears some hundred times more than in the open. The multipliers that this
// takes are far from those an interior-point method starts from.
TEST(Extremes, SteepFrictionInAShallowBox) {
  const Found found = bounds(strip_of(1.0, 50.0, 0.0), problem::Box{4.0, 2.0}, 20);
  EXPECT_LT(found.lower, found.upper);
  EXPECT_GT(found.upper, 10.0 * bearing_c(50.0 * degree));
}

// Without cohesion the pressure is a little less: both bounds of a thousandth of gamma b approach
// those of a tenth of it as c N_c falls away (the rest is gamma b N_gamma and does not).
TEST(Extremes, HardlyAnyCohesionUnderWeight) {
  const double weight = 18e3;
  const Found little = bounds(strip_of(1e-3 * weight, 30.0, weight));
  const Found more = bounds(strip_of(1e-1 * weight, 30.0, weight));
  EXPECT_LT(little.lower, little.upper);
  EXPECT_LT(little.lower, more.lower);
  EXPECT_LT(little.upper, more.upper);
  // N_gamma, smooth, by the method of characteristics: 7.653, times gamma b, b the half width.
  EXPECT_GT(little.upper, 7.653 * weight);
}

TEST(Extremes, ASurchargeInsteadOfCohesion) {
  const Found found = bounds(strip_of(0.0, 30.0, 0.0, 50.0));
  const double exact = 50.0 * bearing_q(30.0 * degree);
  EXPECT_LT(found.lower, exact);
  EXPECT_GT(found.upper, exact);
}

// N_gamma of sand of 30 degrees, times gamma b, b the half width: 14.7543 under a rough base and
// 7.6532 under a smooth one (method of characteristics, Martin 2005).
// No stress at the surface lies strictly within yield.
TEST(Extremes, SandIsBoundedByItsWeightAlone) {
  const double weight = 18e3;
  for (const auto& [is_rough, tension] :
       {std::pair(true, true), std::pair(false, true), std::pair(true, false)}) {
    problem::Strip strip = strip_of(0.0, 30.0, weight);
    strip.rough = is_rough;
    strip.tension = tension;
    const Found found = bounds(strip, problem::Box{6.0, 2.5});
    const double exact = weight * (is_rough ? 14.7543 : 7.6532);
    EXPECT_LT(found.lower, exact);
    EXPECT_GT(found.upper, exact);
  }
}

TEST(Extremes, NeitherCohesionNorWeightNorSurchargeIsRefusedWithTheReason) {
  for (const double phi : {0.0, 30.0}) {
    try {
      (void)problem::strip_case(strip_of(0.0, phi, 0.0), std::nullopt);
      ADD_FAILURE() << "not refused";
    } catch (const std::invalid_argument& refusal) {
      EXPECT_THAT(refusal.what(), ::testing::HasSubstr(phi > 0.0 ? "weight" : "friction"));
    }
  }
}

TEST(Extremes, UnitsDoNotMatter) {
  const problem::Strip si = [] {
    problem::Strip strip = strip_of(2.5e3, 20.0, 1850.0 * 9.81);
    strip.half_width = 0.22;
    return strip;
  }();
  const Found pascal = bounds(si);
  struct Unit {
    double stress, length;  // of one of them in Pa and m
  };
  for (const auto& [stress, length] : {Unit{1e3, 1.0}, {1e6, 1.0}, {1e6, 1e-3}, {1.0, 1e3}}) {
    problem::Strip strip = si;
    strip.soil.cohesion /= stress;
    strip.soil.unit_weight *= length / stress;
    strip.half_width /= length;
    const Found other = bounds(strip);
    // The same numbers but for the rounding of the input, times what the solver makes of it: its
    // gap, 1e-5, is met at the same iteration.
    constexpr double digits = 1e-7;
    EXPECT_NEAR(other.lower * stress / pascal.lower, 1.0, digits);
    EXPECT_NEAR(other.upper * stress / pascal.upper, 1.0, digits);
  }
}

TEST(Extremes, VeryWideAndVeryShallowBoxes) {
  const problem::Strip strip = strip_of(1.0, 20.0, 0.0);
  const problem::Box box = problem::box_of(strip);
  // Far beyond the mechanism the rings are coarse, but a bound is a bound.
  const Found wide = bounds(strip, problem::Box{30.0 * box.width, box.depth});
  EXPECT_LT(wide.lower, bearing_c(20.0 * degree));
  EXPECT_GT(wide.upper, bearing_c(20.0 * degree));
  // Squeezed between the base and a rigid floor the soil bears more.
  const Found shallow = bounds(strip, problem::Box{box.width, 0.4});
  EXPECT_LT(shallow.lower, shallow.upper);
  EXPECT_GT(shallow.lower, bearing_c(20.0 * degree));
}

}  // namespace

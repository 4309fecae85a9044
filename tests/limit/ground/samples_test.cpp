// Strengths and weights that change from place to place: by tables, rasters and points, and
// linearly, against closed forms.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "limit/bracket/bracket.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scenes.hpp"
#include "limit/ground/ground_variation.hpp"
#include "limit/problem/local_soil.hpp"

namespace {

using namespace limit;
using tables::Samples;
using tables::VaryingNumber;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

std::mt19937 generator(7);

double any(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

VaryingNumber raster_of(std::size_t columns, std::size_t rows,
                        const std::function<double(double, double)>& value) {
  Samples raster;
  raster.kind = Samples::Kind::raster;
  raster.columns = columns;
  raster.lower = {-1.0, -1.0};
  raster.step = {2.0 / static_cast<double>(columns - 1), 2.0 / static_cast<double>(rows - 1)};
  raster.values.resize(columns * rows);
  for (std::size_t i = 0; i < raster.values.size(); ++i) {
    const auto place = raster.place(i);
    raster.values[i] = value(place[0], place[1]);
  }
  return VaryingNumber(std::move(raster));
}

VaryingNumber rough_raster() {
  return raster_of(7, 5, [](double, double) { return any(1.0, 3.0); });
}
VaryingNumber rough_table() {
  std::vector<std::array<double, 2>> lines;
  for (const double y : {-1.0, -0.6, -0.5, 0.1, 0.7, 1.0}) lines.push_back({y, any(1.0, 3.0)});
  return VaryingNumber(tables::table_samples(lines, 1, std::nullopt));
}
VaryingNumber rough_cells() {
  tables::Samples cells = *rough_raster().samples;
  cells.nearest = true;
  return VaryingNumber(cells);
}
VaryingNumber rough_points() {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 30; ++i) points.push_back({any(-1, 1), any(-1, 1), any(1.0, 3.0)});
  return VaryingNumber(tables::point_samples(points));
}

// Whatever is sampled within a triangle is within the bounds, and, of what is bilinear, comes as
// near to them as the sampling does.
TEST(BoundsInATriangle, HoldForAllKindsAndAreTight) {
  for (const bool jumps : {false, true}) {
    for (int trial = 0; trial < 60; ++trial) {
      const VaryingNumber number = jumps ? (trial % 2 == 0 ? rough_points() : rough_cells())
                                         : (trial % 2 == 0 ? rough_raster() : rough_table());
      std::array<mesh::Point, 3> corners;
      for (mesh::Point& corner : corners) corner = {any(-1.1, 1.1), any(-1, 1)};
      if (trial % 5 == 0) corners[2] = corners[1];  // along a side
      const ground::NumberWithin within = ground::number_within(number, corners);
      double least = 9.0, most = -9.0, below = 0.0, above = 0.0;
      constexpr int cuts = 60;
      for (int i = 0; i <= cuts; ++i) {
        for (int j = 0; i + j <= cuts; ++j) {
          const double a = double(i) / cuts, b = double(j) / cuts, c = 1.0 - a - b;
          const mesh::Point at = a * corners[0] + b * corners[1] + c * corners[2];
          const double here = number.at_place(std::array{at.x(), at.y()});
          const double linear = a * within.corner[0] + b * within.corner[1] + c * within.corner[2];
          least = std::min(least, here);
          most = std::max(most, here);
          below = std::min(below, here - linear);
          above = std::max(above, here - linear);
        }
      }
      constexpr double rounding = 1e-13;  // of the sampling
      EXPECT_LE(within.least, least + rounding);
      EXPECT_GE(within.most, most - rounding);
      EXPECT_LE(within.below, below + rounding);
      EXPECT_GE(within.above, above - rounding);
      if (jumps) continue;
      // A step of the sampling is 0.05 at most, a slope of the samples some ten.
      constexpr double missed = 0.25;
      EXPECT_GE(within.least, least - missed);
      EXPECT_LE(within.most, most + missed);
      EXPECT_GE(within.below, below - missed);
      EXPECT_LE(within.above, above + missed);
    }
  }
}

// What only touches a triangle is not in it.
TEST(BoundsInATriangle, OfOneCellAreItsValue) {
  const VaryingNumber cells = rough_cells();
  const tables::Samples& raster = *cells.samples;
  for (const std::size_t i : {std::size_t{0}, raster.columns + 1, raster.values.size() - 1}) {
    const auto x = raster.ends_of_cell(0, i % raster.columns);
    const auto y = raster.ends_of_cell(1, i / raster.columns);
    const mesh::Point low(std::max(x[0], -2.0), std::max(y[0], -2.0));
    const mesh::Point high(std::min(x[1], 2.0), std::min(y[1], 2.0));
    const auto within = ground::number_within(cells, {low, mesh::Point(high.x(), low.y()), high});
    EXPECT_EQ(within.least, raster.values[i]);
    EXPECT_EQ(within.most, raster.values[i]);
    EXPECT_EQ(within.above, 0.0);
  }
}

// The strength that stands for a triangle's is no more, or no less, than it is at any place and any
// pressure, and divides with it.
TEST(ASoilInATriangle, IsBoundedByTheOneThatStandsForIt) {
  for (int trial = 0; trial < 40; ++trial) {
    problem::Soil soil;
    const VaryingNumber cohesion = trial % 2 == 0 ? rough_raster() : rough_table();
    const VaryingNumber friction =
        trial % 3 == 0 ? VaryingNumber(20.0, {0, 0}, {5.0, -4.0}) : rough_raster().scaled(10.0);
    soil.variation = std::make_shared<const ground::GroundVariation>(cohesion, friction);
    soil.variation_length = 0.5;
    soil.variation_stress = 3.0;
    soil.divisor = trial % 4 == 0 ? 1.7 : 1.0;
    std::array<mesh::Point, 3> corners;
    for (mesh::Point& corner : corners) corner = {any(-2, 2), any(-2, 2)};
    const auto lower = problem::soil_within(soil, corners, problem::Bound::lower);
    const auto upper = problem::soil_within(soil, corners, problem::Bound::upper);
    for (int sample = 0; sample < 200; ++sample) {
      double a = any(0, 1), b = any(0, 1);
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      const mesh::Point at = a * corners[0] + b * corners[1] + (1.0 - a - b) * corners[2];
      const double c =
          cohesion.at_place(std::array{0.5 * at.x(), 0.5 * at.y()}) / 3.0 / soil.divisor;
      const double phi =
          std::atan(std::tan(friction.at_place(std::array{0.5 * at.x(), 0.5 * at.y()}) * degree) /
                    soil.divisor);
      const double p = -any(-1, 20);  // mean stress, tension positive
      const double strength = c * std::cos(phi) - p * std::sin(phi);
      const auto of = [&](const problem::Soil& one) {
        return one.cohesion_at(at) * std::cos(one.friction_angle) -
               p * std::sin(one.friction_angle);
      };
      constexpr double rounding = 1e-9;
      // Beyond the apex there is none, whatever the formula says.
      if (of(lower) > 0.0) {
        EXPECT_LE(of(lower), strength + rounding);
      }
      if (strength > 0.0) {
        EXPECT_GE(of(upper), strength - rounding);
      }
    }
  }
}

bracket::Solution solved(const problem::Cases& cases, double gap) {
  bracket::BracketOptions options;
  options.gap = gap;
  return bracket::solution_of(cases.associated, options, {});
}

// A strip on clay whose strength grows with depth: told linearly, by a table with more lines than
// it wants, and by a raster, it is one and the same.
TEST(AStripOnStrengthThatGrows, IsTheSameByATableAndByARaster) {
  const auto bearing = [](const std::string& cohesion) {
    const auto cases = shipped("strength_with_depth", {"material.0.cohesion=" + cohesion});
    EXPECT_TRUE(cases);
    return solved(*cases, 0.02);
  };
  const auto linear = bearing("{ at = [0, 0], value = 10e3, gradient = [0, -20e3] }");
  const auto table =
      bearing("{ below = 0.0, table = [[0, 10e3], [0.37, 17.4e3], [1.1, 32e3], [2, 50e3]] }");
  const auto raster = bearing(
      "{ raster = [[10e3, 10e3], [30e3, 30e3], [50e3, 50e3]], lower = [-1, -2], step = [5, 1] }");
  ASSERT_TRUE(linear.lower && linear.upper);
  // The same programme but for rounding, and the solver's share of what it leaves.
  constexpr double solver = 1e-4;
  for (const bracket::Solution* other : {&table, &raster}) {
    ASSERT_TRUE(other->lower && other->upper);
    EXPECT_NEAR(*other->lower / *linear.lower, 1.0, solver);
    EXPECT_NEAR(*other->upper / *linear.upper, 1.0, solver);
  }
}

void expect_bracketed(const bracket::Solution& found, double exact, double gap) {
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(*found.lower, exact * (1.0 + 1e-9));
  EXPECT_GE(*found.upper, exact * (1.0 - 1e-9));
  EXPECT_LE(found.gap(), gap);
}

// Of a block between smooth platens that has weight, the fibre at x bears at the height y the
// pressure q of the platen and gamma(x) (h - y), by twice its cohesion. Where that is just what it
// has everywhere, (q + gamma(x) (h - y)) / 2, all fibres yield at once, and the block spreads
// evenly: q is exact. The cohesion is bilinear, as a raster is.
TEST(ABlockBetweenPlatens, OfWeightThatChangesAcrossBearsWhatItsFibresDo) {
  const auto cases = shipped(
      "smooth_platens",
      {"material.0.friction_angle=0",
       "material.0.unit_weight={ at = [0, 0], value = 1e5, gradient = [2e6, 0] }",
       "material.0.cohesion={ raster = [[15e3, 15e3], [20e3, 25e3]], lower = [0, 0], step = [0.05, "
       "0.1] }"});
  ASSERT_TRUE(cases);
  expect_bracketed(solved(*cases, 0.01), 30e3, 0.01);
}

// The same by depth d: the weight is 100 + 2000 d kN/m3 and the cohesion 15 + 50 d + 500 d^2 kPa,
// of which a table has chords, which are more: the even spreading is then an upper bound by their
// mean, twice that less what the weight does, 25 / 3 kPa.
TEST(ABlockBetweenPlatens, OfWeightThatGrowsWithDepthBearsWhatItsFibresDo) {
  std::string lines;
  constexpr int count = 20;
  double mean = 0.0;
  for (int i = 0; i <= count; ++i) {
    const double d = 0.1 * i / count, c = 15e3 + 50e3 * d + 500e3 * d * d;
    lines += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", d, c);
    mean += (i == 0 || i == count ? 0.5 : 1.0) * c / count;
  }
  const auto cases =
      shipped("smooth_platens",
              {"material.0.friction_angle=0",
               "material.0.unit_weight={ at = [0, 0.1], value = 1e5, gradient = [0, -2e6] }",
               "material.0.cohesion={ below = 0.1, table = [" + lines + "] }"});
  ASSERT_TRUE(cases);
  const auto found = solved(*cases, 0.01);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_GE(*found.upper, 30e3 * (1.0 - 1e-9));
  EXPECT_LE(*found.lower, 2.0 * mean - 25e3 / 3.0);
  EXPECT_LE(found.gap(), 0.01);
}

// By the nearest of four points, or the cells of a raster, as two columns of two weights, 200 below
// 100 and 400 below 300 kN/m3, beside the cohesion that they want, with which all of it spreads at
// once.
class ABlockOfWeights : public ::testing::TestWithParam<const char*> {};

TEST_P(ABlockOfWeights, BearsBetweenPlatensWhatItsFibresDo) {
  const auto column = [](const char* name, double left, double kink, double below) {
    return fmt::format(
        "[[material]]\nname = \"{0}\"\nfriction_angle = 0\nunit_weight = {5}\n"
        "cohesion = {{ along = \"y\", table = [[0, {3}], [0.06, {2}], [0.1, 15e3]] }}\n"
        "[[region]]\nmaterial = \"{0}\"\n"
        "outline = [[{1}, 0], [{4}, 0], [{4}, 0.1], [{1}, 0.1]]\n",
        name, left, kink, below, left + 0.025, GetParam());
  };
  const auto cases =
      case_of("[load]\nsought = \"footing\"\n" + column("left", 0.0, 17e3, 23e3) +
              column("right", 0.025, 21e3, 33e3) +
              "[[side]]\nname = \"platen\"\nkind = \"footing\"\nalong = [[0, 0.1], [0.05, 0.1]]\n"
              "base = \"smooth\"\n[[side]]\nname = \"free side\"\nkind = \"free\"\n"
              "along = [[0.05, 0], [0.05, 0.1]]\n[[side]]\nname = \"axes\"\nkind = \"symmetry\"\n"
              "along = [[0, 0.1], [0, 0], [0.05, 0]]\n");
  ASSERT_TRUE(cases);
  expect_bracketed(solved(*cases, 0.01), 30e3, 0.01);
}

INSTANTIATE_TEST_SUITE_P(
    Samples, ABlockOfWeights,
    ::testing::Values("{ points = [[0.0125, 0.03, 2e5], [0.0125, 0.09, 1e5], [0.0375, 0.03, 4e5], "
                      "[0.0375, 0.09, 3e5]] }",
                      "{ raster = [[1e5, 3e5], [2e5, 4e5]], lower = [0.0125, 0.03], step = [0.025, "
                      "0.06], nearest = true }"));

// Wherever they are: a cut of one weight, by points of which all have it.
TEST(AVerticalCut, OfAWeightByPointsThatAreAllAlikeFailsAsOneOfOneWeightDoes) {
  const auto even = case_of(cut);
  const auto points = case_of(
      cut, {"material.0.unit_weight={ points = [[-0.3, 0.2, 1], [0.4, 0.9, 1], [-1, -0.6, 1], "
            "[0.7, -0.2, 1], [-0.9, 0.8, 1]] }"});
  ASSERT_TRUE(even && points);
  EXPECT_GE(points->associated.lower.soils.size(), 5U);
  const auto one = solved(*even, 0.05), many = solved(*points, 0.05);
  ASSERT_TRUE(one.lower && one.upper && many.lower && many.upper);
  EXPECT_LE(*many.lower, *one.upper);
  EXPECT_LE(*one.lower, *many.upper);
  EXPECT_LE(many.gap(), 0.05);
}

// Between smooth platens each fibre bears 2 c tan(45 + phi / 2) by itself, and spreads by itself:
// the mean over phi from one to other of the tangent is -2 ln(cos(u)) / (other - one) between both
// u = 45 + phi / 2. Bounds of a friction angle close in proportion to the triangles.
TEST(ABlockBetweenPlatens, OfFrictionThatChangesAcrossBearsTheMeanOfItsFibres) {
  const double one = 18.0 * degree, other = 22.0 * degree;
  const auto primitive = [](double phi) {
    return -2.0 * std::log(std::cos(std::numbers::pi / 4.0 + phi / 2.0));
  };
  const double exact = 2.0 * 15e3 * (primitive(other) - primitive(one)) / (other - one);
  for (const char* friction : {"{ at = [0, 0], value = 18, gradient = [80, 0] }",
                               "{ along = \"x\", table = [[0, 18], [0.05, 22]] }",
                               "{ raster = [[18, 22]], lower = [0, 0.05], step = [0.05, 0.2] }"}) {
    const auto cases =
        shipped("smooth_platens", {std::string("material.0.friction_angle=") + friction});
    ASSERT_TRUE(cases);
    EXPECT_FALSE(cases->davis);
    expect_bracketed(solved(*cases, 0.05), exact, 0.05);
  }
}

// Under a footing on level ground weight does no work, however it grows with depth: Prandtl's load.
TEST(AStripOnClay, BearsPrandtlsLoadWhateverTheWeightBelow) {
  const double exact = 2.0 + std::numbers::pi;
  for (const char* weight : {"{ at = [0, 0], value = 1, gradient = [0, -0.8] }",
                             "{ below = 0.0, table = [[0, 1], [0.6, 2.5], [2, 1.5]] }"}) {
    const auto cases = case_of(layered, {"material.0.cohesion=1.0", "material.1.cohesion=1.0",
                                         std::string("material.0.unit_weight=") + weight,
                                         std::string("material.1.unit_weight=") + weight});
    ASSERT_TRUE(cases);
    expect_bracketed(solved(*cases, 0.03), exact, 0.03);
  }
}

// A weight that hardly changes takes quadratic stresses for linear ones, which are among them.
TEST(AVerticalCut, OfAWeightThatHardlyChangesFailsAsOneOfOneWeightDoes) {
  const auto even = case_of(cut),
             uneven = case_of(
                 cut,
                 {"material.0.unit_weight={ at = [0, 0], value = 1, gradient = [1e-9, -1e-9] }"});
  ASSERT_TRUE(even && uneven);
  const auto linear = solved(*even, 0.05), quadratic = solved(*uneven, 0.05);
  ASSERT_TRUE(linear.lower && linear.upper && quadratic.lower && quadratic.upper);
  EXPECT_LE(*quadratic.lower, *linear.upper);
  EXPECT_LE(*linear.lower, *quadratic.upper);
  EXPECT_LE(quadratic.gap(), 0.05);
}

// Strength reduction divides what samples tell.
TEST(ASlope, WhoseStrengthIsToldBySamplesThatAreAllAlikeHasTheFactorOfOneStrength) {
  const auto factor = [](const std::vector<std::string>& settings) {
    const auto cases = shipped("slope_safety", settings);
    EXPECT_TRUE(cases);
    return solved(*cases, 0.08);
  };
  const auto one = factor({});
  const auto same = factor(
      {"material.0.cohesion={ points = [[0, 0, 15e3], [5, 5, 15e3]] }",
       "material.0.friction_angle={ raster = [[20, 20]], lower = [-5, 1], step = [40, 40] }"});
  ASSERT_TRUE(one.lower && one.upper && same.lower && same.upper);
  EXPECT_LE(*same.lower, *one.upper);
  EXPECT_LE(*one.lower, *same.upper);
  EXPECT_LE(same.gap(), 0.08);
}

std::string complaint(const std::vector<std::string>& settings) {
  return read(layered, settings).errors;
}

TEST(SamplesOfTheGround, ThatDoNotDoAreRefusedByTheirKey) {
  EXPECT_THAT(
      complaint({"material.0.unit_weight={ raster = [[1, 2]], lower = [0, 0], step = [9, 9] }"}),
      AllOf(HasSubstr("material.0.unit_weight: found a raster"),
            HasSubstr("allowed is one value in each cell, { raster = ..., nearest = true }")));
  std::string cells;
  for (int i = 0; i <= 1000; ++i) cells += i == 0 ? "1" : ", 1";
  EXPECT_THAT(complaint({"material.0.unit_weight={ raster = [[" + cells +
                         "]], lower = [0, 0], step = [1e-3, 9], nearest = true }"}),
              HasSubstr("material.0.unit_weight: found 1001 cells over the material"));
  std::string many;
  for (int i = 0; i <= 1000; ++i) many += fmt::format("{}[0, {}, 1]", i == 0 ? "" : ", ", i);
  EXPECT_THAT(complaint({"material.0.unit_weight={ points = [" + many + "] }"}),
              HasSubstr("material.0.unit_weight: found 1001 points"));
  EXPECT_THAT(complaint({"material.1.cohesion={ along = \"y\", table = [[-2, 1], [-1.5, 2]] }"}),
              AllOf(HasSubstr("material.1.cohesion: found values from y = -2 to -1.5"),
                    HasSubstr("region soft reaches")));
  EXPECT_THAT(complaint({"material.1.cohesion={ points = [[0, 0, 1], [1, 0, 0]] }"}),
              HasSubstr("0 at ("));
  EXPECT_THAT(
      complaint({"material.1.friction_angle={ at = [0, 0], value = 10, gradient = [0, 5] }"}),
      HasSubstr("material.1.friction_angle: 0 at ("));
  EXPECT_THAT(
      complaint({"material.1.cohesion=0.0",
                 "material.1.friction_angle={ at = [0, 0], value = 10, gradient = [0, -5] }"}),
      HasSubstr("material.1.cohesion: found 0, with a friction angle that changes"));
  EXPECT_THAT(complaint({"material.1.cohesion={ points = \"nowhere.csv\" }"}),
              AllOf(HasSubstr("material.1.cohesion: nowhere.csv: "),
                    HasSubstr("its path from the scene's folder")));
}

}  // namespace

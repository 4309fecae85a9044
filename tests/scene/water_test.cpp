// Pore water in scenes: its pressure, its force on a cell, the stress it leaves, and what is
// refused.
#include "scene/water.hpp"

#include <gmock/gmock.h>

#include "scene/derived.hpp"
#include "scene/geostatic.hpp"
#include "scene/reader.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rounding = 1e-12;

// A level box 4 m wide and 2 m deep.
const std::string box = R"([geometry]
dimension = 2
min = [0.0, -2.0]
max = [4.0, 0.0]
spacing = 0.1
[[material]]
name = "sand"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.25
cohesion = 1e3
friction_angle = 30
dilation_angle = 0
unit_weight = 17e3
saturated_unit_weight = 20e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
)";
const std::string geostatic = "[initial_stress]\nkind = \"geostatic\"\n";

std::string table(const std::string& points) {
  return "[water]\nunit_weight = 10e3\ntable = " + points + "\n";
}

SceneReading read(const std::string& text, const std::vector<std::string>& settings = {}) {
  return parse_scene(text, "s.toml", settings);
}

std::vector<std::string> texts(const std::vector<tables::Complaint>& complaints) {
  std::vector<std::string> all;
  for (const auto& complaint : complaints) all.push_back(complaint.text());
  return all;
}

TEST(PoreWater, ThatGrowsUpwardsOrHasAWeightOfNoEffectIsWarnedOf) {
  const std::string told = "[water]\npore_pressure = { at = [0, -2], value = 0, gradient = [0, ";
  const auto slipped = read(box + told + "10e3] }\nunit_weight = 10e3\n");
  ASSERT_TRUE(slipped.scene) << texts(slipped.errors)[0];
  EXPECT_THAT(
      texts(slipped.warnings),
      ElementsAre(HasSubstr("water.unit_weight: found 10000 beside pore_pressure; it has no "
                            "effect"),
                  HasSubstr("water.pore_pressure: found a pressure that grows upwards "
                            "wherever there is any")));
  const std::string right = "[water]\npore_pressure = { at = [0, 0], value = 0, gradient = [0, ";
  EXPECT_THAT(texts(read(box + right + "-10e3] }\n").warnings), IsEmpty());
}

TEST(PoreWater, IsHydrostaticBelowItsTable) {
  // It falls by 1 m over the left half and goes on level.
  const auto reading = read(box + table("[[0, 0], [2, -1], [4, -1]]"));
  ASSERT_TRUE(reading.scene) << texts(reading.errors)[0];
  const PoreWater water(*reading.scene);
  const auto at = [&](double x, double y) {
    const Point place{x, y};
    return water.pressure_at(place);
  };
  EXPECT_NEAR(at(1.0, -0.75), 10e3 * 0.25, rounding * 1e4);
  EXPECT_NEAR(at(3.0, -1.5), 10e3 * 0.5, rounding * 1e4);
  EXPECT_EQ(at(1.0, -0.25), 0.0);
  // A cell that the table leaves through its middle, one whole below it, one around its kink.
  const auto aslant = water.in_cell({0.9, -0.55}, {1.1, -0.45}, {1.0, -0.5});
  EXPECT_NEAR(aslant.wet, 0.5, rounding);
  EXPECT_NEAR(aslant.force.x(), 0.5 * 10e3 * 0.5, rounding * 1e4);
  EXPECT_NEAR(aslant.force.y(), 0.5 * 10e3, rounding * 1e4);
  const auto whole = water.in_cell({3.0, -1.6}, {3.1, -1.5}, {3.05, -1.55});
  EXPECT_EQ(whole.wet, 1.0);
  EXPECT_NEAR(whole.force.y(), 10e3, rounding * 1e4);
  // A triangle of 0.1 by 0.05 above the level half and half the cell below it.
  const auto kink = water.in_cell({1.9, -1.1}, {2.1, -0.9}, {2.0, -1.0});
  EXPECT_NEAR(kink.wet, 0.5 + 0.5 * 0.1 * 0.05 / 0.04, rounding);
  const auto dry = water.in_cell({0.9, -0.3}, {1.1, -0.1}, {1.0, -0.2});
  EXPECT_EQ(dry.wet, 0.0);
  EXPECT_EQ(dry.force.norm(), 0.0);
}

// Effective: 17 kN/m3 above the table, 20 - 10 below, whatever stands above the ground.
TEST(PoreWater, LightensGeostaticGround) {
  const auto stress_at = [](const std::string& points, double depth) {
    const auto reading = read(box + table(points) + geostatic);
    EXPECT_TRUE(reading.scene) << texts(reading.errors)[0];
    const Point place{1.0, -depth};
    return geostatic_stress(*reading.scene, place);
  };
  EXPECT_NEAR(stress_at("[[0, -0.53], [4, -0.53]]", 0.4), -17e3 * 0.4, rounding * 1e5);
  EXPECT_NEAR(stress_at("[[0, -0.53], [4, -0.53]]", 1.73), -(17e3 * 0.53 + 10e3 * 1.2),
              rounding * 1e5);
  EXPECT_EQ(stress_at("[[0, 0], [4, 0]]", 0.0), 0.0);
  for (const char* flooded : {"[[0, 0], [4, 0]]", "[[0, 7], [4, 7]]"}) {
    EXPECT_NEAR(stress_at(flooded, 1.73), -10e3 * 1.73, rounding * 1e5) << flooded;
  }
  EXPECT_NEAR(stress_at("[[0, -3], [4, -3]]", 1.73), -17e3 * 1.73, rounding * 1e5);
}

// A share of the weight above: 0.3 times 20 kN/m3 below a face of 1 : 2.
const std::string slope = R"([geometry]
spacing = 0.1
[[material]]
name = "sand"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.25
cohesion = 1e3
friction_angle = 30
dilation_angle = 0
unit_weight = 20e3
[[region]]
material = "sand"
outline = [[0, 0], [4, 0], [4, 1], [2, 2], [0, 2]]
[[side]]
name = "surface"
kind = "free"
along = [[4, 1], [2, 2], [0, 2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, 2], [0, 0], [4, 0], [4, 1]]
)";

TEST(PoreWater, IsAShareOfTheOverburden) {
  const auto reading = read(slope + "[water]\nr_u = 0.3\n[load]\nkv = 0.2\n");
  ASSERT_TRUE(reading.scene) << texts(reading.errors)[0];
  const PoreWater water(*reading.scene);
  const Point place{3.0, 0.5};
  // Of the weight at rest: an earthquake that lifts a fifth of it changes nothing.
  EXPECT_NEAR(water.pressure_at(place), 0.3 * 20e3 * 1.0, rounding * 1e5);
  const auto cell = water.in_cell({2.95, 0.45}, {3.05, 0.55}, {3.0, 0.5});
  EXPECT_NEAR(cell.force.x(), 0.3 * 20e3 * 0.5, rounding * 1e5);
  EXPECT_NEAR(cell.force.y(), 0.3 * 20e3, rounding * 1e5);
  EXPECT_EQ(cell.wet, 0.0) << "the unit weight is that of the ground with its water";
}

std::string told(const std::string& pressure) {
  return "[water]\npore_pressure = " + pressure + "\n";
}

// A pressure that is that below a table does to cells what the table does.
TEST(PoreWater, ThatIsToldIsWhatATableOfItIs) {
  const auto by_table = read(box + table("[[0, -0.2], [4, -1]]"));
  const PoreWater hydrostatic(*by_table.scene);
  for (const char* pressure :
       {"{ at = [0, -0.2], value = 0, gradient = [-2e3, -10e3] }",
        "{ points = [[0, 0, -2e3], [4, 0, -10e3], [0, -2, 18e3], [4, -2, 10e3], [1, -1, 6e3]] }",
        "{ raster = [[-2e3, -6e3, -10e3], [8e3, 4e3, 0], [18e3, 14e3, 10e3]], lower = [0, -2], "
        "step = [2, 1] }"}) {
    const auto reading = read(box + told(pressure));
    ASSERT_TRUE(reading.scene) << texts(reading.errors)[0];
    EXPECT_THAT(texts(reading.warnings), IsEmpty());
    const PoreWater water(*reading.scene);
    for (const auto& [x, y] : {std::pair{0.9, -0.45}, {2.1, -0.7}, {3.5, -1.9}, {0.1, -0.15}}) {
      const Point place{x, y};
      EXPECT_NEAR(water.pressure_at(place), hydrostatic.pressure_at(place), rounding * 1e5);
      const shape::Point lower(x - 0.1, y - 0.1), upper(x + 0.1, y + 0.1);
      const auto one = water.in_cell(lower, upper, {x, y});
      const auto other = hydrostatic.in_cell(lower, upper, {x, y});
      EXPECT_NEAR(one.wet, other.wet, rounding * 1e2) << pressure;
      EXPECT_LT((one.force - other.force).norm(), rounding * 1e6) << pressure;
    }
  }
}

// 20 kN/m3 and water that rises by a gradient of 0.4: 20 - 10 - 4 below a level of zero pressure.
TEST(PoreWater, ThatRisesLightensGeostaticGround) {
  for (const char* pressure : {"{ at = [0, -0.53], value = 0, gradient = [0, -14e3] }",
                               "{ along = \"y\", table = [[-2, 20.58e3], [-0.53, 0], [0, 0]] }"}) {
    const auto reading = read(box + told(pressure) + geostatic);
    ASSERT_TRUE(reading.scene) << texts(reading.errors)[0];
    const Point place{1.0, -1.73};
    EXPECT_NEAR(geostatic_stress(*reading.scene, place), -(17e3 * 0.53 + 6e3 * 1.2),
                rounding * 1e5);
  }
}

TEST(PoreWater, ThatIsToldAndIsNoneIsRefusedInWords) {
  const auto errors = [](const std::string& text, const std::vector<std::string>& settings = {}) {
    return texts(read(text, settings).errors);
  };
  const std::string artesian = told("{ at = [0, 0], value = 0, gradient = [0, -14e3] }");
  EXPECT_THAT(errors(box + artesian + "table = [[0, 0], [4, 0]]\n"),
              ElementsAre("s.toml:21:17: water.pore_pressure: found beside a table; the pressure "
                          "is what one of them says: leave the other out"));
  EXPECT_THAT(errors(slope + artesian, {"water.r_u=0.2"}),
              ElementsAre(HasSubstr("water.pore_pressure: found beside r_u; the pressure is")));
  EXPECT_THAT(errors(box + told("{ points = [[0, 0, 0], [4, 0, 0], [0, -2, 2e4]] }")),
              ElementsAre(HasSubstr("water.pore_pressure: told of nothing at (4, -2), a corner of "
                                    "the ground")));
  EXPECT_THAT(errors(box + told("{ points = [[0, 0, 0], [2, -1, 0], [4, -2, 2e4]] }")),
              ElementsAre(HasSubstr("found points on one line, or less than three")));
  EXPECT_THAT(errors(box + told("{ at = [0, 0], value = 0, gradient = [0, 10e3] }")),
              ElementsAre(HasSubstr("found nothing above zero, but -20000; water presses with more "
                                    "than zero")));
  EXPECT_THAT(errors(box + told("{ points = \"none.csv\" }")),
              ElementsAre(HasSubstr("water.pore_pressure: none.csv: ")));
  EXPECT_THAT(errors(box + artesian, {"gravity.acceleration=[0.0, 0.0]"}),
              ElementsAre(HasSubstr("water.pore_pressure: found in ground without weight")));
  EXPECT_THAT(errors(box + told("{ at = [0, 0], value = 0, gradient = [1e3, -14e3] }") + geostatic),
              ElementsAre(HasSubstr("found a pressure that is not level with a geostatic initial "
                                    "stress; water that seeps aside leaves no geostatic stress")));
}

TEST(PoreWater, ThatLiftsGeostaticGroundIsSaid) {
  const auto reading =
      read(box + told("{ at = [0, 0], value = 0, gradient = [0, -21e3] }") + geostatic);
  ASSERT_TRUE(reading.scene);
  EXPECT_THAT(texts(reading.warnings),
              ElementsAre(HasSubstr("water.pore_pressure: lifts the material \"sand\" with 2000 Pa "
                                    "more than there is above y = -2; its geostatic stress is a "
                                    "tension")));
}

TEST(PoreWater, ThatIsNoneIsRefusedInWords) {
  const auto errors = [](const std::string& text, const std::vector<std::string>& settings = {}) {
    return texts(read(text, settings).errors);
  };
  EXPECT_THAT(errors(box + table("[[0, 0], [3, 0]]")),
              ElementsAre("s.toml:22:9: water.table: found a table from x = 0 to 3; allowed is one "
                          "over all of the ground, from 0 or less to 4 or more"));
  EXPECT_THAT(errors(box + table("[[0, 0], [3, 0], [3, -1], [4, -1]]")),
              ElementsAre("s.toml:22:9: water.table: found x = 3 after 3; allowed are points from "
                          "left to right, no two above each other"));
  EXPECT_THAT(errors(box + table("[[0, 0], [4, -1]]") + geostatic),
              ElementsAre("s.toml:22:9: water.table: found levels from -1 to 0 with a geostatic "
                          "initial stress; water that seeps leaves no geostatic stress: kind = "
                          "\"gravity\", or a level table"));
  EXPECT_THAT(errors(box + table("[[0, 0], [4, 0]]"), {"water.r_u=0.2"}),
              ElementsAre(HasSubstr("water.r_u: found 0.2, and a table; the pressure is what one "
                                    "of them says: leave the other out")));
  EXPECT_THAT(errors(box, {"water.r_u=0.2"}),
              ElementsAre(HasSubstr("water.r_u: found 0.2 in a box; it belongs to a body of "
                                    "[[region]]s; in a box give a table")));
  EXPECT_THAT(errors(box, {"water.r_u=1.0"}),
              ElementsAre(HasSubstr("water.r_u: found 1.0; allowed is a number 0 <= value < 1")));
  EXPECT_THAT(errors(box + table("[[0, 0], [4, 0]]"), {"gravity.acceleration=[0.0, 0.0]"}),
              ElementsAre(HasSubstr(
                  "water.table: found in ground without weight along -y; give materials a "
                  "unit_weight, or gravity.acceleration downwards")));
  std::string solid = box + table("[[0, 0], [4, 0]]");
  for (const auto& [plane, space] : {std::pair("dimension = 2", "dimension = 3"),
                                     std::pair("min = [0.0, -2.0]", "min = [0.0, -2.0, 0.0]"),
                                     std::pair("max = [4.0, 0.0]", "max = [4.0, 0.0, 1.0]")}) {
    ASSERT_NE(solid.find(plane), std::string::npos) << plane;
    solid.replace(solid.find(plane), std::string_view(plane).size(), space);
  }
  EXPECT_THAT(errors(solid, {"gravity.acceleration=[0.0, -9.81, 1.0]"}),
              ElementsAre(HasSubstr("water.table: found in ground whose weight acts along z")));
  std::string weightless = box;
  weightless.erase(weightless.find("unit_weight = 17e3\n"), 19);
  EXPECT_THAT(
      errors(weightless),
      ElementsAre(HasSubstr("material.0.saturated_unit_weight: found 20000 without a "
                            "unit_weight; give the unit_weight above the water table, too")));
  std::string cut = slope;
  cut.replace(cut.find("[4, 1], [2, 2]"), 14, "[4, 1], [2, 1], [2, 2]");
  cut.replace(cut.find("[4, 1], [2, 2]"), 14, "[4, 1], [2, 1], [2, 2]");
  EXPECT_THAT(errors(cut + "[water]\nr_u = 0.3\n"),
              ElementsAre(HasSubstr("water.r_u: the weight above jumps by 20000 Pa below the "
                                    "upright face at x = 2")));
}

TEST(PoreWater, ThatMakesGroundFloatOrDoesNothingIsSaid) {
  const auto warnings = [](const std::string& text, const std::vector<std::string>& settings) {
    const auto reading = read(text, settings);
    EXPECT_TRUE(reading.scene);
    return texts(reading.warnings);
  };
  const std::string flooded = box + table("[[0, 0], [4, 0]]");
  EXPECT_THAT(warnings(flooded, {}), IsEmpty());
  EXPECT_THAT(warnings(flooded, {"material.0.saturated_unit_weight=9e3"}),
              ElementsAre(HasSubstr("found 9000, less than the water's 10000; it floats below the "
                                    "water table")));
  EXPECT_THAT(warnings(box, {}),
              ElementsAre(HasSubstr("material.0.saturated_unit_weight: found 20000 without a water "
                                    "table; it has no effect")));
}

}  // namespace
}  // namespace scene

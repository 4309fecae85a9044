// Where water stands on a body, and what it presses with.
#include "model/standing_water.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

template <int Dim = 2>
std::vector<StandingWater<Dim>> standing_on(const std::string& text) {
  const auto reading = scene::parse_scene(text, "scene", {});
  if (!reading.scene) throw std::invalid_argument(reading.errors.front().text());
  return standing_water(*reading.scene, build_model<Dim>(*reading.scene));
}

const std::string soil = R"(
[[material]]
name = "fill"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.25
unit_weight = 20e3
)";

// A dam of 5 m between 4 m and 1 m of water.
std::string dam(const std::string& water) {
  return R"([geometry]
spacing = 0.25
[[region]]
material = "fill"
outline = [[0, 0], [8, 0], [5, 5], [3, 5]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [8, 0]]
[[side]]
name = "downstream"
kind = "free"
along = [[8, 0], [5, 5], [3, 5]]
[[side]]
name = "upstream"
kind = "free"
along = [[3, 5], [0, 0]]
)" + soil +
         "[water]\nunit_weight = 10e3\n" + water;
}

constexpr double round_off = 1e-6;  // of tens of kN

TEST(StandingWater, PressesAsItStandsOnEachSide) {
  const auto found = standing_on(dam("table = [[0, 4], [2.4, 4], [7.4, 1], [8, 1]]\n"));
  ASSERT_EQ(found.size(), 2U);
  for (const StandingWater<2>& water : found) {
    const bool up = water.on == "the side \"upstream\"";
    EXPECT_TRUE(up || water.on == "the side \"downstream\"") << water.on;
    const double h = up ? 4.0 : 1.0;
    EXPECT_NEAR(water.pressure, 10e3 * h, round_off);
    EXPECT_NEAR(water.at.x(), up ? 0.0 : 8.0, round_off);
    EXPECT_NEAR(water.at.y(), 0.0, round_off);
    // Trapezoids of a piece that the table cuts are off by less than a spacing's share.
    EXPECT_NEAR(water.force.x(), (up ? 1.0 : -1.0) * 10e3 * h * h / 2.0, 10e3 * 0.25 * 0.25);
    EXPECT_NEAR(water.force.y(), -10e3 * h * (0.6 * h) / 2.0, 10e3 * 0.25 * 0.25);
  }
}

TEST(StandingWater, IsNoneWhereTheTableIsInTheGroundOrAtItsSurface) {
  EXPECT_TRUE(standing_on(dam("table = [[0, 0], [3, 0], [8, 0]]\n")).empty());
  EXPECT_TRUE(standing_on(dam("r_u = 0.3\n")).empty());
  std::string dry = dam("");
  dry.erase(dry.find("[water]"));
  EXPECT_TRUE(standing_on(dry).empty());
}

// Of a box its faces; those that are held, or that a plate moves, are no news.
void expect_on_top(const std::string& right) {
  const auto found =
      standing_on("[geometry]\nmin = [0, 0]\nmax = [4, 2]\nspacing = 0.25\n" + soil +
                  "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\n"
                  "[[support]]\nname = \"left\"\nside = \"left\"\ndirections = [\"x\"]\n" +
                  right + "[water]\nunit_weight = 10e3\ntable = [[0, 3], [4, 3]]\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().on, "the face \"top\"");
  EXPECT_NEAR(found.front().pressure, 10e3, round_off);
  EXPECT_NEAR(found.front().force.x(), 0.0, round_off);
  EXPECT_NEAR(found.front().force.y(), -4.0 * 10e3, round_off);
}

TEST(StandingWater, IsOnFacesThatNothingHolds) {
  expect_on_top("[[support]]\nname = \"right\"\nside = \"right\"\ndirections = [\"x\"]\n");
}

TEST(StandingWater, IsNotOnAFaceThatThePlateOfADriveMoves) {
  expect_on_top(
      "[drive]\nkind = \"displacement\"\nside = \"right\"\ndirection = [-1, 0]\n"
      "target = 0.01\nwidth = 2\n");
}

// Of a prism as of its section, times its length; of a box in space its faces.
TEST(StandingWater, StandsInSpaceAsInThePlane) {
  std::string prism = dam("table = [[0, 4], [2.4, 4], [7.4, 1], [8, 1]]\n");
  prism.insert(prism.find("spacing"), "dimension = 3\ndepth = [0, 2]\n");
  const std::string ends =
      "[[support]]\nname = \"front\"\nside = \"front\"\ndirections = [\"z\"]\n"
      "[[support]]\nname = \"back\"\nside = \"back\"\ndirections = [\"z\"]\n";
  const auto found = standing_on<3>(prism + ends);
  ASSERT_EQ(found.size(), 2U);
  for (const StandingWater<3>& water : found) {
    const bool up = water.on == "the side \"upstream\"";
    const double h = up ? 4.0 : 1.0;
    EXPECT_LT(water.pressure, 10e3 * h);  // in the middle of the lowest piece
    EXPECT_GT(water.pressure, 10e3 * (h - 0.25));
    EXPECT_NEAR(water.force.x(), 2.0 * (up ? 1.0 : -1.0) * 10e3 * h * h / 2.0, 10e3 * 0.25 * 0.25);
    EXPECT_NEAR(water.force.z(), 0.0, round_off);
  }
  const auto box = standing_on<3>(
      "[geometry]\ndimension = 3\nmin = [0, 0, 0]\nmax = [2, 1, 1]\nspacing = 0.25\n" + soil +
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\n" + ends +
      "[[support]]\nname = \"left\"\nside = \"left\"\ndirections = [\"x\"]\n"
      "[[support]]\nname = \"right\"\nside = \"right\"\ndirections = [\"x\"]\n"
      "[water]\nunit_weight = 10e3\ntable = [[0, 3], [2, 3]]\n");
  ASSERT_EQ(box.size(), 1U);
  EXPECT_EQ(box.front().on, "the face \"top\"");
  EXPECT_NEAR(box.front().force.y(), -2.0 * 1.0 * 20e3, round_off);
}

}  // namespace
}  // namespace model

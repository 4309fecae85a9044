// Pore water: effective stresses under a table.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_water.hpp"
#include "limit/ground/water_scenes.hpp"
#include "shape/outline.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;

using told::degree;
using told::run;
using told::slope;
using told::solution;
constexpr double of_water = 10e3;

std::string water(const std::string& table) {
  return "[water]\nunit_weight = 10e3\ntable = " + table + "\n";
}

// A strip on level ground, one half.
std::string footing(double unit_weight, const std::string& more) {
  return more +
         fmt::format(
             "[load]\nsought = \"footing\"\n[[material]]\nname = \"soil\"\n"
             "cohesion = 2e3\nfriction_angle = 25\nunit_weight = {}\n",
             unit_weight) +
         R"([[region]]
material = "soil"
outline = [[0, -2], [5, -2], [5, 0], [1, 0], [0, 0]]
[[side]]
name = "base"
kind = "footing"
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [5, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, -2], [5, -2], [5, 0]]
)";
}

// Level ground under water, however deep, is ground of the buoyant weight.
TEST(Water, MakesLevelGroundAsLightAsItIsUnderWater) {
  const bracket::Solution dry = solution(footing(20e3 - of_water, ""));
  for (const char* table : {"[[0, 0], [5, 0]]", "[[-1, 7], [2.5, 7], [9, 7]]"}) {
    const bracket::Solution wet = solution(footing(20e3, water(table)));
    ASSERT_TRUE(dry.lower && dry.upper && wet.lower && wet.upper);
    EXPECT_LE(*dry.lower, *wet.upper) << table;
    EXPECT_LE(*wet.lower, *dry.upper) << table;
    EXPECT_TRUE(wet.bracket.reached);
  }
}

// Below the base of the ground it is as if there were none.
TEST(Water, ThatIsBelowTheGroundDoesNotMatter) {
  const bracket::Solution dry = solution(footing(20e3, ""));
  const bracket::Solution wet = solution(footing(20e3, water("[[0, -3], [5, -2.5]]")));
  ASSERT_TRUE(dry.lower && dry.upper && wet.lower && wet.upper);
  constexpr double solver = 1e-4;
  EXPECT_NEAR(*wet.lower / *dry.lower, 1.0, solver);
  EXPECT_NEAR(*wet.upper / *dry.upper, 1.0, solver);
}

// A face of 20 degrees in sand with the table along it: a skin slides at tan(phi) / tan(beta)
// (1 - r_u / cos(beta)^2), r_u being the weight of water over the soil's.
std::string along_the_face() {
  return water(fmt::format("[[-10, 10], [0, 10], [{}, 0], [{}, 0]]", run, run + 10.0));
}

TEST(Water, ThatSeepsAlongAFaceLetsItsSkinSlide) {
  const auto problem = case_of(slope(0.0, along_the_face()));
  ASSERT_TRUE(problem && problem->associated.known_upper);
  const double tangent = std::tan(35 * degree) / std::tan(20 * degree);
  const double ratio = of_water / 20e3, cosine = std::cos(20 * degree);
  EXPECT_NEAR(*problem->associated.known_upper, tangent * (1.0 - ratio / (cosine * cosine)), 1e-9);
  EXPECT_FALSE(problem->associated.known_lower);
  // Which stresses come up to.
  const bracket::Solution found = solution(slope(0.0, along_the_face()));
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(*found.lower, *problem->associated.known_upper);
  EXPECT_LE(found.gap(), 0.07);
}

// With a little cohesion both bounds are there: above the skin's factor, and below that of dry
// ground by about what the water takes.
TEST(Water, WeakensASlope) {
  const bracket::Solution wet = solution(slope(1e3, along_the_face()));
  const bracket::Solution dry = solution(slope(1e3, ""));
  const bracket::Solution flooded = solution(slope(1e3, water("[[-10, 12], [60, 12]]")));
  ASSERT_TRUE(wet.lower && wet.upper && dry.lower && dry.upper && flooded.lower && flooded.upper);
  const double ratio = of_water / 20e3, cosine = std::cos(20 * degree);
  const double skin =
      std::tan(35 * degree) / std::tan(20 * degree) * (1.0 - ratio / (cosine * cosine));
  EXPECT_GT(*wet.upper, skin);
  EXPECT_LT(*wet.upper, *dry.lower);
  // Half the weight, the same cohesion: stronger than dry.
  EXPECT_GT(*flooded.lower, *dry.upper);
}

bracket::Solution solution_of_shipped(const char* scene, const std::vector<std::string>& settings) {
  const auto problem = shipped(scene, settings);
  EXPECT_TRUE(problem);
  bracket::BracketOptions options;
  options.gap = 0.07;
  return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
}

// The reservoir presses on the face as the pore water does in it: what is left is the buoyant
// weight. Emptied at once, with the pore water where it was, the slope is weaker than it is dry.
TEST(Water, OfAReservoirHoldsASlopeUntilItIsDrawnDown) {
  const std::string none = "water.table=[[-20, -6], [35, -6]]";
  const bracket::Solution full = solution_of_shipped("drawdown_full", {});
  const bracket::Solution light =
      solution_of_shipped("drawdown_full", {none, "material.soil.unit_weight=10190"});
  ASSERT_TRUE(full.lower && full.upper && light.lower && light.upper);
  EXPECT_LE(*full.lower, *light.upper);
  EXPECT_LE(*light.lower, *full.upper);
  const bracket::Solution dry = solution_of_shipped("drawdown_full", {none});
  const bracket::Solution rapid = solution_of_shipped("drawdown_rapid", {});
  ASSERT_TRUE(dry.lower && dry.upper && rapid.lower && rapid.upper);
  EXPECT_LT(*dry.upper, *full.lower);
  EXPECT_LT(*rapid.upper, *dry.lower);
}

// A share of the overburden is the pressure of seepage along the face: the same known factor, and
// the same force everywhere.
TEST(Water, IsAShareOfTheOverburdenAsWell) {
  const std::string share = "[water]\nr_u = 0.5\n";
  const auto skin = case_of(slope(0.0, share)), of_table = case_of(slope(0.0, along_the_face()));
  ASSERT_TRUE(skin && skin->associated.known_upper && of_table);
  EXPECT_NEAR(*skin->associated.known_upper, *of_table->associated.known_upper, 1e-9);
  const auto wet_scene = [](const std::string& text) {
    tables::Diagnosis diagnosis("scene");
    std::optional<tables::Complaint> unreadable;
    auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
    ground::wet(*scene, diagnosis);
    return *scene;
  };
  const ground::GroundScene shared = wet_scene(slope(1e3, share));
  const ground::GroundScene seeping = wet_scene(slope(1e3, along_the_face()));
  const auto force_at = [](const ground::GroundScene& scene, const mesh::Point& place) {
    for (const ground::GroundRegion& region : scene.regions) {
      if (shape::is_inside(region.outline, place)) {
        return scene.materials[region.material].soil.seepage;
      }
    }
    return mesh::Point(NAN, NAN);
  };
  for (const mesh::Point& place : {mesh::Point(-5.0, 3.0), mesh::Point(9.0, 2.0),
                                   mesh::Point(20.0, -1.0), mesh::Point(32.0, -2.0)}) {
    EXPECT_LT((force_at(shared, place) - force_at(seeping, place)).norm(), 1e-6) << place.x();
  }
}

// Where weights are sought, their share grows with them: the same loads in proportion as where the
// strength is, in which everything is.
TEST(Water, ThatIsAShareOfTheOverburdenGrowsWithIt) {
  const std::string share = "[water]\nr_u = 0.5\n";
  std::string heavier = slope(1e3, share);
  heavier.replace(heavier.find("\"strength\""), 10, "\"gravity\"");
  const auto weights = case_of(heavier), strength = case_of(slope(1e3, share));
  ASSERT_TRUE(weights && strength);
  const auto &grown = weights->associated.lower.soils, &all = strength->associated.lower.soils;
  ASSERT_EQ(grown.size(), all.size());
  double most = 0.0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    EXPECT_EQ(grown[s].live_seepage, all[s].live_seepage);
    EXPECT_EQ(grown[s].live_unit_weight, all[s].live_unit_weight);
    EXPECT_TRUE(grown[s].seepage.isZero(0.0));
    most = std::max(most, grown[s].live_seepage.norm());
  }
  EXPECT_GT(most, 0.4 * 20e3);
}

std::string complaint_of(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

std::string complaint(const std::string& table) {
  return complaint_of(footing(20e3, water(table)));
}

TEST(Water, WhoseTableIsNoneIsRefusedInWords) {
  EXPECT_THAT(
      complaint("[[0, 0], [4, 0]]"),
      AllOf(HasSubstr("water.table"), HasSubstr("from x = 0 to 4"), HasSubstr("5 or more")));
  EXPECT_THAT(complaint("[[0, 0], [3, 0], [3, -1], [5, 0]]"), HasSubstr("x = 3 after 3"));
  EXPECT_THAT(complaint("[[0, 0]]"), HasSubstr("over all of the ground"));
}

TEST(Water, WhoseShareIsNoneIsRefusedInWords) {
  const std::string share = "[water]\nr_u = 0.5\n";
  EXPECT_THAT(complaint_of(footing(20e3, share + "table = [[0, 0], [5, 0]]\n")),
              HasSubstr("water.r_u: found 0.5, and a table"));
  std::string heavier = slope(1e3, share);
  heavier.replace(heavier.find("\"strength\""), 10, "\"gravity\"");
  heavier.replace(heavier.find("unit_weight = 20e3"), 18, "unit_weight = 20e3\ngrows = false");
  EXPECT_THAT(
      complaint_of(heavier),
      HasSubstr("water.r_u: found 0.5, with gravity sought, and the weight of sand does not "
                "grow; a share of the weight above grows with all of it"));
  // The face made upright.
  std::string cut = slope(1e3, share);
  const std::string toe = fmt::format("[{}, 0], [0, 10]", 10.0 / std::tan(20.0 * degree));
  cut.replace(cut.find(toe), toe.size(), "[0, 0], [0, 10]");
  const std::string back = fmt::format("[0, 10], [{}, 0]", 10.0 / std::tan(20.0 * degree));
  cut.replace(cut.find(back), back.size(), "[0, 10], [0, 0]");
  EXPECT_THAT(complaint_of(cut), HasSubstr("water.r_u: the weight above jumps by 200000 Pa below "
                                           "the upright face at x = 0"));
}

}  // namespace

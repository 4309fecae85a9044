// A scene that both programs read.
#include "limit/ground/ground_of_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace {

using namespace limit;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string both = R"(
[geometry]
spacing = 0.1
[[material]]
name = "clay"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 5e3
unit_weight = 17e3
[[material]]
name = "sand"
model = "drucker_prager"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 1e3
friction_angle = 30
dilation_angle = 10
unit_weight = 19e3
[[region]]
material = "sand"
outline = [[0, 0], [3, 0], [3, 1], [0, 1]]
[[region]]
name = "crust"
material = "clay"
outline = [[0, 1], [3, 1], [2, 2], [0, 2]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 2], [0, 0]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, 0], [3, 0], [3, 1]]
[[side]]
name = "slope"
kind = "loaded"
pressure = 100
along = [[3, 1], [2, 2]]
[[side]]
name = "top"
kind = "free"
along = [[2, 2], [0.5, 2]]
[[side]]
name = "strip"
kind = "footing"
base = "smooth"
along = [[0.5, 2], [0, 2]]
[drive]
kind = "displacement"
target = 0.01
)";

std::optional<ground::GroundScene> ground_of(const std::string& text,
                                             std::vector<std::string>* errors = nullptr) {
  tables::Diagnosis diagnosis("both.toml");
  std::optional<tables::Complaint> unreadable;
  const auto scene = scene::parse_scene(text, {}, diagnosis, unreadable);
  std::optional<ground::GroundScene> ground;
  if (scene) ground = ground::ground_of_scene(*scene, diagnosis);
  if (errors != nullptr) {
    for (const auto& error : diagnosis.errors()) errors->push_back(error.text());
  }
  return ground;
}

TEST(SceneOfBoth, IsTheSameGround) {
  EXPECT_TRUE(ground::is_scene_of_both(both));
  EXPECT_FALSE(ground::is_scene_of_both(both.substr(both.find("[[material]]"))));
  const auto ground = ground_of(both);
  ASSERT_TRUE(ground);
  ASSERT_EQ(ground->materials.size(), 2U);
  EXPECT_EQ(ground->materials[0].soil.cohesion, 5e3);
  EXPECT_EQ(ground->materials[0].soil.friction_angle, 0.0);
  EXPECT_NEAR(ground->materials[0].soil.unit_weight, 17e3, 1e-9);
  EXPECT_DOUBLE_EQ(ground->materials[1].soil.friction_angle, std::numbers::pi / 6.0);
  EXPECT_DOUBLE_EQ(ground->materials[1].dilation_angle, std::numbers::pi / 18.0);
  ASSERT_EQ(ground->regions.size(), 2U);
  EXPECT_EQ(ground->regions[0].material, 1U);
  EXPECT_EQ(ground->regions[1].name, "crust");
  ASSERT_EQ(ground->sides.size(), 5U);
  EXPECT_EQ(ground->sides[0].kind, ground::SideKind::roller);
  EXPECT_EQ(ground->sides[1].kind, ground::SideKind::fixed);
  EXPECT_EQ(ground->sides[2].pressure, 100.0);
  EXPECT_EQ(ground->sides[4].kind, ground::SideKind::footing);
  EXPECT_EQ(ground->sides[4].base, ground::BaseKind::smooth);
  EXPECT_EQ(ground->load.sought, ground::Sought::footing);
  // The plate of a run neither turns nor moves along itself.
  EXPECT_EQ(ground->load.guided, true);
}

// Behind a mirror an earthquake would be aslant the other way.
TEST(SceneOfBoth, SeeksWhatItSays) {
  std::string whole = both;
  whole.replace(whole.find("symmetry"), 8, "roller");
  const auto sought = ground_of(whole + "[load]\nsought = \"strength\"\nkh = 0.1\nkv = -0.1\n");
  ASSERT_TRUE(sought);
  EXPECT_EQ(sought->load.sought, ground::Sought::strength);
  EXPECT_NEAR(sought->load.kh, 0.1, 1e-12);
  EXPECT_EQ(sought->load.kv, -0.1);
  EXPECT_NEAR(sought->materials[1].soil.unit_weight, 19e3, 1e-9);
}

std::string with(const std::string& what, const std::string& instead) {
  std::string text = both;
  return text.replace(text.find(what), what.size(), instead);
}

TEST(SceneOfBoth, HasTheSameWater) {
  const auto ground =
      ground_of(with("unit_weight = 19e3", "unit_weight = 19e3\nsaturated_unit_weight = 21e3") +
                "[water]\nunit_weight = 10e3\ntable = [[-1, 1.5], [2, 1], [4, 1]]\n");
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->water.unit_weight, 10e3);
  ASSERT_EQ(ground->water.table.size(), 3U);
  EXPECT_EQ(ground->water.table[0], mesh::Point(-1.0, 1.5));
  EXPECT_NEAR(ground->materials[1].saturated_unit_weight.value_or(0.0).value, 21e3, 1e-9);
  EXPECT_FALSE(ground->materials[0].saturated_unit_weight);
  const auto share = ground_of(both + "[water]\nr_u = 0.3\n");
  ASSERT_TRUE(share);
  EXPECT_EQ(share->water.r_u, 0.3);
  EXPECT_TRUE(share->water.is_there());
}

TEST(SceneOfBoth, HasTheSameCohesionThatVaries) {
  std::vector<std::string> errors;
  const auto ground = ground_of(
      with("cohesion = 5e3", "cohesion = { at = [0, 2], value = 5e3, gradient = [0, -1e3] }"),
      &errors);
  ASSERT_TRUE(ground) << errors.front();
  EXPECT_NEAR(ground->materials[0].soil.cohesion_at({1.0, 1.25}), 5.75e3, 1e-9);
  // Zero in a corner will do for fpm-run, whose particles are within.
  EXPECT_FALSE(ground_of(
      with("cohesion = 5e3", "cohesion = { at = [0, 2], value = 0, gradient = [0, -1e3] }"),
      &errors));
  EXPECT_THAT(errors, ElementsAre(HasSubstr("material.0.cohesion: 0 at (2, 2), in region crust")));
}

// In plane strain a cylinder, or a cone matched there, cut off in tension is Mohr and Coulomb's
// soil cut off: the stress across the plane can always be the mean one or, under friction, less,
// which is no larger than the principal stresses that are cut off.
TEST(SceneOfBoth, CutsOffTheTensionOfCylindersAndCones) {
  std::vector<std::string> errors;
  std::string text = with("unit_weight = 19e3", "unit_weight = 19e3\ntension_cutoff = 0");
  const auto sand = ground_of(text, &errors);
  ASSERT_TRUE(sand) << errors.front();
  EXPECT_EQ(sand->materials[1].soil.tension, 0.0);
  EXPECT_FALSE(sand->materials[0].soil.cuts_tension());
  const auto clay =
      ground_of(with("cohesion = 5e3", "cohesion = 5e3\ntension_cutoff = 1e3"), &errors);
  ASSERT_TRUE(clay) << errors.front();
  EXPECT_EQ(clay->materials[0].soil.tension, 1e3);
}

TEST(SceneOfBoth, SaysWhatFpmLimitDoesNotBracket) {
  std::vector<std::string> errors;
  EXPECT_FALSE(ground_of(both + "[[cutout]]\nname = \"tunnel\"\ncentre = [1, 0.5]\nradius = 0.2\n"
                                "[[support]]\nname = \"post\"\nat = [1, 1]\ndirections = [\"x\"]\n",
                         &errors));
  EXPECT_THAT(errors, ElementsAre(HasSubstr("cutout: the ground has cutouts"),
                                  HasSubstr("it holds something else than a side does")));
  errors.clear();
  std::string heavier = with("kind = \"displacement\"\ntarget = 0.01",
                             "kind = \"load\"\nscales = [\"gravity\"]\n[programme]\nsteps = 2");
  heavier.replace(heavier.find("kind = \"footing\"\nbase = \"smooth\""), 32, "kind = \"free\"");
  heavier += "[water]\ntable = [[0, 1], [3, 1]]\n";
  EXPECT_FALSE(ground_of(heavier, &errors));
  EXPECT_THAT(errors, ElementsAre(HasSubstr("drive.scales: found gravity, in ground under water")));
  errors.clear();
  std::string some = with("kind = \"displacement\"\ntarget = 0.01",
                          "kind = \"load\"\nscales = [\"traction\"]\nloads = [\"slope\"]\n"
                          "[programme]\nsteps = 2");
  some.replace(some.find("kind = \"footing\"\nbase = \"smooth\""), 32, "kind = \"free\"");
  some.replace(some.find("pressure = 100"), 14, "live_pressure = 100");
  EXPECT_FALSE(ground_of(some, &errors));
  EXPECT_THAT(errors, ElementsAre(HasSubstr("drive.loads: only some loads grow")));
  errors.clear();
  std::string rock = with(
      "model = \"von_mises\"",
      "model = \"hoek_brown\"\nintact_strength = 20e6\nm_i = 10\ngsi = 45\ndilation_ratio = 1\n"
      "tension_cutoff = 1e3");
  rock.erase(rock.find("cohesion = 5e3\n"), 15);
  EXPECT_FALSE(ground_of(rock, &errors));
  EXPECT_THAT(errors, ElementsAre(HasSubstr("material.0.tension_cutoff: it is given for a "
                                            "curved envelope")));
}

}  // namespace

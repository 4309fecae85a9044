// Bodies of regions in scenes: what is refused, what is read, and what it comes to.
#include "scene/ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;

const std::string base =
    "[geometry]\nspacing = 0.1\n"
    "[[material]]\nname = \"clay\"\nmodel = \"von_mises\"\nyoungs_modulus = 1e6\n"
    "poissons_ratio = 0.3\ncohesion = 1e3\n"
    "[[material]]\nname = \"rock\"\nmodel = \"elastic\"\nyoungs_modulus = 1e9\n"
    "poissons_ratio = 0.3\n";
const std::string layers =
    "[[region]]\nmaterial = \"rock\"\noutline = [[0, 0], [2.05, 0], [2.05, 0.5], [0, 0.3]]\n"
    "[[region]]\nmaterial = \"clay\"\noutline = [[0, 0.3], [2.05, 0.5], [1.2, 1], [0, 1]]\n";

std::string side(const std::string& name, const std::string& kind, const std::string& along) {
  return "[[side]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\nalong = " + along + "\n";
}

const std::string around = side("left", "symmetry", "[[0, 1], [0, 0]]") +
                           side("rigid", "fixed", "[[0, 0], [2.05, 0], [2.05, 0.5]]") +
                           side("slope", "free", "[[2.05, 0.5], [1.2, 1], [0.5, 1]]") +
                           side("strip", "footing", "[[0, 1], [0.5, 1]]");
const std::string pressed = "[drive]\nkind = \"displacement\"\ntarget = 0.01\n";

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const auto& error : parse_scene(text, "s.toml").errors) errors.push_back(error.text());
  return errors;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error(what + " is not in the scene");
  return text.replace(at, what.size(), by);
}

TEST(GroundScene, SaysWhatItsSidesComeTo) {
  const auto reading = parse_scene(base + layers + around + pressed, "s.toml");
  ASSERT_TRUE(reading.scene) << errors_of(base + layers + around + pressed)[0];
  const Scene& scene = *reading.scene;
  EXPECT_THAT(scene.geometry.min, ElementsAre(0.0, 0.0));
  // A whole number of spacings; what is right of the regions is cut away.
  EXPECT_NEAR(scene.geometry.max[0], 2.1, 1e-15);
  EXPECT_EQ(scene.geometry.max[1], 1.0);
  EXPECT_NEAR(body_of(scene).area(), 2.05 - 0.5 * 0.85 * 0.5, 1e-14);
  // The right side is not on the box, so that the particles are tied to it.
  ASSERT_EQ(scene.support.size(), 1U);
  EXPECT_EQ(scene.support[0].name, "rigid bottom");
  EXPECT_EQ(scene.support[0].side, Side::bottom);
  EXPECT_THAT(scene.support[0].directions, ElementsAre(Axis::x, Axis::y));
  EXPECT_THAT(tied_surfaces(scene), ElementsAre("rigid"));
  ASSERT_EQ(scene.symmetry.size(), 1U);
  EXPECT_EQ(scene.symmetry[0].axis, Axis::x);
  EXPECT_EQ(scene.drive.side, Side::top);
  EXPECT_THAT(scene.drive.range_min, ElementsAre(0.0));
  EXPECT_THAT(scene.drive.range_max, ElementsAre(0.5));
  EXPECT_THAT(scene.drive.direction, ElementsAre(0.0, -1.0));
  EXPECT_EQ(scene.drive.width, 0.5);
  const Point in_clay{0.1, 0.9}, in_rock{1.9, 0.1};
  EXPECT_EQ(material_at(scene, in_clay), 0U);
  EXPECT_EQ(material_at(scene, in_rock), 1U);
}

TEST(GroundScene, IsPrintedAndReadAgain) {
  for (const std::string& text :
       {base + layers + around + pressed, base + layers + replaced(around, "footing", "loaded") +
                                              "[load]\nsought = \"traction\"\nkh = 0.1\n"}) {
    const auto reading = parse_scene(text, "s.toml");
    ASSERT_TRUE(reading.scene);
    const auto again = parse_scene(effective_toml(*reading.scene), "again.toml");
    ASSERT_TRUE(again.scene);
    EXPECT_EQ(*again.scene, *reading.scene);
  }
}

// A face that is held in part only is held by springs, where it is.
TEST(GroundScene, HoldsFacesAsAWholeOrByTheirPoints) {
  const auto reading =
      parse_scene(base + layers + side("left", "roller", "[[0, 0.5], [0, 0]]") +
                      side("wall", "free", "[[0, 0.5], [0, 1]]") +
                      around.substr(around.find("[[side]]\nname = \"rigid\"")) + pressed,
                  "s.toml");
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->support.size(), 1U);
  EXPECT_THAT(tied_surfaces(*reading.scene), ::testing::UnorderedElementsAre("left", "rigid"));
}

TEST(GroundScene, TakesWeightsAndEarthquakes) {
  const std::string heavy =
      replaced(replaced(base, "cohesion = 1e3\n", "cohesion = 1e3\nunit_weight = 18e3\n"),
               "youngs_modulus = 1e9\n", "youngs_modulus = 1e9\nunit_weight = 25e3\n") +
      layers + around + pressed;
  const auto still = parse_scene(heavy, "s.toml");
  ASSERT_TRUE(still.scene);
  EXPECT_THAT(still.scene->gravity.acceleration, ElementsAre(0.0, -9.81));
  EXPECT_DOUBLE_EQ(still.scene->material[0].density, 18e3 / 9.81);
  const auto shaken = parse_scene(heavy + "[load]\nkh = -0.2\nkv = 0.1\n", "s.toml");
  ASSERT_TRUE(shaken.scene);
  const Point& acceleration = shaken.scene->gravity.acceleration;
  const double density = shaken.scene->material[1].density;
  EXPECT_NEAR(density * acceleration[0], -0.2 * 25e3, 1e-9);
  EXPECT_NEAR(density * acceleration[1], -0.9 * 25e3, 1e-9);
  EXPECT_THAT(
      errors_of(replaced(heavy, "unit_weight = 18e3\n", "unit_weight = 18e3\ndensity = 1800.0\n")),
      ElementsAre("s.toml:9:15: material.0.unit_weight: found 18000, and a density of 1800; "
                  "it would be 17658 with gravity's 9.81 m/s2: give one of them"));
}

struct Bad {
  std::string text, message;
};

TEST(GroundScene, ThatIsNoGroundIsRefused) {
  const std::string good = base + layers + around + pressed;
  const Bad all[] = {
      {replaced(good, "material = \"rock\"", "material = \"rocks\""),
       "s.toml:15:12: region.0.material: found \"rocks\"; materials are clay, rock; did you mean "
       "\"rock\"?"},
      {replaced(good, "[1.2, 1], [0, 1]]", "[0, 1], [1.2, 1]]"),
       "s.toml:19:11: region.1.outline: the polygon crosses itself at (0.846192, 0.793612); an "
       "outline passes no place twice"},
      {replaced(good, "[2.05, 0.5], [0, 0.3]]", "[2.05, 0.5], [0, 0.6]]"),
       "s.toml:19:11: region.1.outline: \"region 0\" and \"region 1\" overlap at (1.025, 0.55); "
       "regions share sides at most"},
      {replaced(good, "[[2.05, 0.5], [1.2, 1], [0.5, 1]]", "[[2.05, 0.5], [1.2, 1]]"),
       "s.toml:19:11: region.1.outline: no [[side]] names the outline (1.2, 1) - (0.5, 1); every "
       "part of the outline belongs to a side"},
      {replaced(good, "[[0, 1], [0.5, 1]]", "[[0, 1], [0.5, 1.2]]"),
       "s.toml:35:9: side.3.along: (0, 1) - (0.5, 1.2) lies off the ground's outline; a side "
       "follows "
       "the outline of the regions together"},
      {replaced(good, "kind = \"displacement\"\ntarget = 0.01\n", "kind = \"none\"\n"),
       "s.toml:34:8: side.3.kind: found a footing that nothing moves or loads; a footing wants "
       "[drive] kind = \"displacement\", or \"load\" with plate among its scales"},
      {replaced(good, "kind = \"free\"", "kind = \"loaded\"\nlive_pressure = 1.0"),
       "s.toml:31:17: side.2.live_pressure: found 1, which nothing lets grow; it grows in a drive "
       "of "
       "kind load with traction among its scales; what is there from the start is pressure or "
       "shear"},
      {replaced(good, "kind = \"free\"", "kind = \"free\"\npressure = 1.0"),
       "s.toml:31:12: side.2.pressure: given for a side of kind free; it belongs to kind loaded"},
      {replaced(good, "spacing = 0.1", "spacing = 0.1\nmin = [0.1, 0.0]"),
       "s.toml:3:7: geometry.min: regions reach beyond it, to 0 along x; the box holds all "
       "regions: "
       "leave it out"},
      {replaced(good, "spacing = 0.1", "spacing = 0.1\ndimension = 3"),
       "s.toml:3:13: geometry.dimension: found 3 with a [[region]]; only plane bodies have "
       "regions"},
      {base + "[geometry2]\n", "s.toml:14:2: geometry2: no such table; "},
      {replaced(good, layers, ""),
       "s.toml:14:1: side.0: found without a [[region]]; sides are parts of the outline of "
       "regions; "
       "the faces of a box are left, right, bottom, top"},
      {replaced(good, "cohesion = 1e3\n", "cohesion = 1e3\nregion_min = [0, 0]\n"),
       "s.toml:9:14: material.0.region_min: found in a body of regions; a [[region]] says where "
       "its "
       "material is"},
      {good + "[initial_stress]\nkind = \"geostatic\"\n",
       "s.toml:40:8: initial_stress.kind: found geostatic in a body of regions; it is the stress "
       "under a level surface: under any other it is kind = \"gravity\""},
  };
  for (const char* key : {"K0", "surface", "surcharge"}) {
    EXPECT_THAT(
        errors_of(replaced(good, "cohesion = 1e3\n", "cohesion = 1e3\nunit_weight = 1e4\n") +
                  "[initial_stress]\nkind = \"gravity\"\n" + key + " = 1.0\n"),
        ::testing::Contains(
            ::testing::HasSubstr(std::string("initial_stress.") + key +
                                 ": found with kind = \"gravity\"; it belongs to geostatic")));
  }
  for (const Bad& bad : all) {
    const auto errors = errors_of(bad.text);
    ASSERT_FALSE(errors.empty()) << bad.message;
    EXPECT_THAT(errors[0], ::testing::StartsWith(bad.message));
  }
}

}  // namespace
}  // namespace scene

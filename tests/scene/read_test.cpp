#include <gmock/gmock.h>

#include <filesystem>

#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "support/sample_scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;

std::string with_tail(const std::string& tail) {
  return std::string(support::sample_scene) + tail;
}

std::vector<std::string> texts(const std::vector<tables::Complaint>& complaints) {
  std::vector<std::string> all;
  for (const tables::Complaint& complaint : complaints) all.push_back(complaint.text());
  return all;
}

TEST(SceneReader, FillsEveryKindOfValue) {
  const auto reading =
      parse_scene(with_tail("[programme]\nsteps = 7\nstop_at_failure = false\n"), "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  const Scene& scene = *reading.scene;
  EXPECT_EQ(scene.title, "sample");
  EXPECT_EQ(scene.geometry.dimension, 2);
  EXPECT_THAT(scene.geometry.min, ElementsAre(0.0, -1.0));
  EXPECT_EQ(scene.geometry.spacing, 0.1);
  ASSERT_EQ(scene.material.size(), 1U);
  EXPECT_EQ(scene.material[0].model, "drucker_prager");
  EXPECT_EQ(scene.material[0].cohesion, 2.5e3);
  ASSERT_EQ(scene.support.size(), 1U);
  EXPECT_EQ(scene.support[0].side, Side::bottom);
  EXPECT_THAT(scene.support[0].directions, ElementsAre(Axis::x, Axis::y));
  EXPECT_EQ(scene.programme.steps, 7);
  EXPECT_FALSE(scene.programme.stop_at_failure);
}

TEST(SceneReader, LeavesAbsentKeysAtTheirDefaults) {
  const auto reading = parse_scene(support::sample_scene, "s.toml");
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->solver, Solver{});
  EXPECT_EQ(reading.scene->re_search, ReSearch{});
  EXPECT_EQ(reading.scene->output, Output{});
  EXPECT_FALSE(reading.scene->initial_stress.K0);
}

TEST(SceneReader, TakesOneNumberForAListOfOne) {
  const auto one = parse_scene(support::sample_scene, "s.toml");
  const auto list =
      parse_scene(support::sample_with("range_max = 0.5", "range_max = [0.5]"), "s.toml");
  ASSERT_TRUE(one.scene && list.scene);
  EXPECT_EQ(*one.scene, *list.scene);
}

TEST(SceneReader, ReadsEverySceneThatIsShippedWithoutAWarning) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FPM_SHARE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const auto reading = read_scene(entry.path());
    EXPECT_TRUE(reading.scene) << entry.path() << ": " << texts(reading.errors).front();
    EXPECT_THAT(texts(reading.warnings), ElementsAre()) << entry.path();
    ++scenes;
  }
  EXPECT_GE(scenes, 6);
}

TEST(SceneReader, WarnsOfABodyThatNothingHolds) {
  const auto reading =
      parse_scene(support::sample_with("directions = [\"x\", \"y\"]", "directions = \"x\"") +
                      "lateral = \"free\"\n",
                  "s.toml");
  ASSERT_TRUE(reading.scene);
  EXPECT_THAT(texts(reading.warnings), ElementsAre());  // the drive holds y, the mirror x
  auto loose = support::sample_with(
      "[[support]]\nname = \"base\"\nside = \"bottom\"\n"
      "directions = [\"x\", \"y\"]\n",
      "");
  loose.replace(loose.find("kind = \"displacement\""), std::string::npos, "kind = \"none\"\n");
  const auto without = parse_scene(loose, "s.toml");
  ASSERT_TRUE(without.scene) << texts(without.errors).front();
  EXPECT_THAT(texts(without.warnings),
              ElementsAre("s.toml: support: nothing holds the body along y; without a support, a "
                          "symmetry or a fixed drive it moves freely"));
}

// What slides is right to the tolerance of all forces, the weight's too: 15 % of a push of 3 % of
// it.
TEST(SceneReader, WarnsOfABodyThatFrictionAloneHolds) {
  auto loose = support::sample_with(
      "side = \"bottom\"\ndirections = [\"x\", \"y\"]\n",
      "side = \"right\"\ndirections = [\"x\"]\nmethod = \"contact\"\nadhesion = 10.0\n");
  loose.replace(loose.find("kind = \"displacement\""), std::string::npos, "kind = \"none\"\n");
  const auto reading = parse_scene(loose, "s.toml");
  ASSERT_TRUE(reading.scene) << texts(reading.errors).front();
  EXPECT_THAT(texts(reading.warnings),
              ElementsAre(::testing::HasSubstr(
                  "only friction holds the body along y; where it slides, the forces along it are "
                  "right to solver.tolerance of the largest there are")));
}

TEST(SceneReader, WarnsOfAStrengthWithoutEffect) {
  const auto reading = parse_scene(support::sample_with("\"drucker_prager\"", "\"von_mises\""),
                                   "s.toml", std::vector<std::string>{"initial_stress.K0=1.0"});
  ASSERT_TRUE(reading.scene);
  EXPECT_THAT(texts(reading.warnings),
              ElementsAre("s.toml:13:18: material.0.friction_angle: found 20.0; it has no effect "
                          "on the model von_mises",
                          "s.toml:14:18: material.0.dilation_angle: found 10.0; it has no effect "
                          "on the model von_mises"));
}

// The same body in 3D; front and back have no support.
std::string in_3d() {
  std::string text = support::sample_with("dimension = 2", "dimension = 3");
  const auto replace = [&](const std::string& what, const std::string& instead) {
    ASSERT_NE(text.find(what), std::string::npos) << what;
    text.replace(text.find(what), what.size(), instead);
  };
  replace("min = [0.0, -1.0]", "min = [0.0, -1.0, 0.0]");
  replace("max = [2.0, 0.0]", "max = [2.0, 0.0, 0.5]");
  replace("directions = [\"x\", \"y\"]", "directions = [\"x\", \"y\", \"z\"]");
  replace("[0.0, -9.81]", "[0.0, -9.81, 0.0]");
  replace("range_min = 0.0", "range_min = [0.0, 0.0]");
  replace("range_max = 0.5", "range_max = [0.5, 0.5]");
  replace("direction = [0.0, -1.0]", "direction = [0.0, -1.0, 0.0]");
  replace("density = 1850.0", "density = 1850.0\nmatch = \"compression_cone\"");
  return text;
}

TEST(SceneReader, ReadsAThreeDimensionalScene) {
  const auto reading = parse_scene(in_3d(), "s.toml");
  ASSERT_TRUE(reading.scene) << texts(reading.errors).front();
  EXPECT_THAT(reading.scene->drive.range_max, ElementsAre(0.5, 0.5));
}

TEST(SceneReader, RefusesThePlaneStrainMatchIn3D) {
  std::string text = in_3d();
  const std::string match = "\nmatch = \"compression_cone\"";
  text.erase(text.find(match), match.size());
  EXPECT_THAT(texts(parse_scene(text, "s.toml").errors),
              ElementsAre("s.toml:7:1: material.0.match: found plane_strain in 3D; the plane "
                          "strain match holds in 2D only: use match = \"compression_cone\" or "
                          "model = \"mohr_coulomb\""));
}

TEST(SceneReader, AcceptsSubPointsWhereverSomethingYields) {
  const std::string mixed = "[hourglass]\ncontrol = \"mixed\"\n";
  EXPECT_TRUE(parse_scene(in_3d() + mixed, "s.toml").errors.empty());
  std::string corners = in_3d();
  const std::string cone = "drucker_prager", match = "\nmatch = \"compression_cone\"";
  corners.erase(corners.find(match), match.size());
  corners.replace(corners.find(cone), cone.size(), "mohr_coulomb");
  EXPECT_TRUE(parse_scene(corners + mixed, "s.toml").errors.empty());
}

TEST(SceneReader, StaysSilentOnRulesWhoseKeysAreAlreadyBad) {
  // Without a dimension nothing can be said about the length of any vector.
  const auto reading =
      parse_scene(support::sample_with("dimension = 2", "dimension = 7"), "s.toml");
  EXPECT_EQ(reading.errors.size(), 1U);
}

TEST(SceneReader, NeverCrashesOnATruncatedScene) {
  for (std::size_t length = 0; length < support::sample_scene.size(); ++length) {
    const auto reading = parse_scene(support::sample_scene.substr(0, length), "s.toml");
    EXPECT_EQ(reading.scene != nullptr, reading.errors.empty());
  }
}

}  // namespace
}  // namespace scene

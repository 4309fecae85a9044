#include <gmock/gmock.h>

#include "scene/changes.hpp"
#include "scene/derived.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "support/sample_scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;

SceneReading with(const std::vector<std::string>& settings) {
  return parse_scene(support::sample_scene, "s.toml", settings);
}

std::string only_error(const std::vector<std::string>& settings) {
  const auto reading = with(settings);
  return reading.errors.size() == 1 ? reading.errors[0].text() : "not one error";
}

TEST(SceneSettings, OverrideWhatTheFileSays) {
  const auto reading = with({"geometry.spacing=0.05", "title=\"finer\"", "drive.lateral=free"});
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->geometry.spacing, 0.05);
  EXPECT_EQ(reading.scene->title, "finer");
  EXPECT_EQ(reading.scene->drive.lateral, Lateral::free);
}

TEST(SceneSettings, ReachTablesTheFileDoesNotHave) {
  const auto reading = with({"re_search.enabled=true", "solver.tolerance=1e-4"});
  ASSERT_TRUE(reading.scene);
  EXPECT_TRUE(reading.scene->re_search.enabled);
  EXPECT_EQ(reading.scene->solver.tolerance, 1e-4);
}

TEST(SceneSettings, ReachEntriesByNumberAndByName) {
  const auto by_number = with({"material.0.cohesion=3e3", "support.0.directions=[\"y\"]"});
  const auto by_name = with({"material.soil.cohesion=3e3", "support.base.directions=y"});
  ASSERT_TRUE(by_number.scene && by_name.scene);
  EXPECT_EQ(by_number.scene->material[0].cohesion, 3e3);
  EXPECT_EQ(*by_number.scene, *by_name.scene);
}

TEST(SceneSettings, ApplyInOrderTheLastWins) {
  const auto reading = with({"drive.target=0.02", "drive.target=0.03"});
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->drive.target, 0.03);
}

TEST(SceneSettings, AllowSpacesAndBareWords) {
  const auto reading = with({" hourglass.control = incremental "});
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->hourglass.control, HourglassControl::incremental);
}

TEST(SceneSettings, RepairAFaultOfTheFile) {
  const std::vector<std::string> settings{"geometry.spacing=0.1"};
  const auto reading =
      parse_scene(support::sample_with("spacing = 0.1", "spacing = 0.3"), "s.toml", settings);
  EXPECT_TRUE(reading.scene);
}

TEST(SceneSettings, AreNamedInTheirErrors) {
  EXPECT_EQ(only_error({"geometry.spacing=-1"}),
            "--set geometry.spacing=-1: geometry.spacing: found -1; allowed is a number > 0 [m]");
  EXPECT_EQ(only_error({"material.soil.friction_angle=5"}),
            "s.toml:14:18: material.0.dilation_angle: found 10; it must not exceed the friction "
            "angle, 5");
  EXPECT_EQ(only_error({"geometry.spacing=fine"}),
            "--set geometry.spacing=fine: geometry.spacing: found `fine`, which is no TOML value; "
            "allowed is a number > 0 [m]");
  EXPECT_EQ(only_error({"geometry.spacing="}),
            "--set geometry.spacing=: geometry.spacing: found ``, which is no TOML value; allowed "
            "is a number > 0 [m]");
}

TEST(SceneSettings, OfferTheNearestName) {
  EXPECT_EQ(only_error({"geometry.spacin=1"}),
            "--set geometry.spacin=1: geometry.spacin: no such key; keys of [geometry] are "
            "dimension, min, max, depth, spacing, layout, jitter, seed; did you mean \"spacing\"?");
  EXPECT_THAT(only_error({"geometri.spacing=1"}),
              ::testing::EndsWith("; did you mean \"geometry\"?"));
  EXPECT_EQ(only_error({"material.sol.cohesion=1"}),
            "--set material.sol.cohesion=1: material.sol.cohesion: no entry sol in [[material]]; "
            "entries are 0 (soil); did you mean \"soil\"?");
}

TEST(SceneSettings, RefuseWhatNamesNoKey) {
  EXPECT_EQ(only_error({"spacing"}),
            "--set spacing: spacing: names no key and value; the form is table.key=value");
  EXPECT_EQ(only_error({"=1"}),
            "--set =1: =1: names no key and value; the form is table.key=value");
  EXPECT_EQ(only_error({"geometry=1"}),
            "--set geometry=1: geometry: names no key; the form is geometry.key=value");
  EXPECT_EQ(only_error({"material.cohesion=1"}),
            "--set material.cohesion=1: material.cohesion: names no key; the form is "
            "material.0.key=value or material.NAME.key=value");
  EXPECT_EQ(only_error({"material.3.cohesion=1"}),
            "--set material.3.cohesion=1: material.3.cohesion: no entry 3 in [[material]]; entries "
            "are 0 (soil)");
  EXPECT_EQ(only_error({"traction.0.value=[0.0, 1.0]"}),
            "--set traction.0.value=[0.0, 1.0]: traction.0.value: no entry 0 in [[traction]]; "
            "there is none");
}

TEST(SceneSettings, TakeTheFormerNameOfATableWithALineOfAdvice) {
  const auto now =
      parse_scene(std::string(support::sample_scene) + "[re_search]\ntrigger = 0.1\n", "s.toml");
  const auto former =
      parse_scene(std::string(support::sample_scene) + "[research]\ntrigger = 0.1\n", "s.toml");
  const auto set = with({"research.trigger=0.1"});
  ASSERT_TRUE(now.scene && former.scene && set.scene);
  EXPECT_TRUE(now.warnings.empty());
  EXPECT_EQ(now.scene->re_search.trigger, 0.1);
  EXPECT_EQ(*former.scene, *now.scene);
  EXPECT_EQ(*set.scene, *now.scene);
  ASSERT_EQ(former.warnings.size(), 1U);
  EXPECT_EQ(former.warnings[0].text(),
            "s.toml:34:1: research: found by its former name; write [re_search]");
  ASSERT_EQ(set.warnings.size(), 1U);
  EXPECT_EQ(set.warnings[0].text(),
            "--set research.trigger=0.1: research.trigger: found by its former name; write "
            "re_search.trigger");
  EXPECT_EQ(only_error({"research.trigger=-1"}),
            "--set research.trigger=-1: re_search.trigger: found -1; allowed is a number > 0");
  const auto both =
      parse_scene(std::string(support::sample_scene) + "[research]\n[re_search]\n", "s.toml");
  ASSERT_EQ(both.errors.size(), 1U);
  EXPECT_EQ(both.errors[0].text(),
            "s.toml:34:1: research: found beside [re_search]; it is the former name of re_search: "
            "keep one");
}

TEST(SceneSettings, CannotSmuggleFurtherKeysIn) {
  EXPECT_FALSE(with({"drive.target=0.02\ndirection = [1.0, 0.0]"}).scene);
  EXPECT_FALSE(with({"title=\"a\"\n[re_search]\nenabled = true"}).scene);
}

// The measure of a stage's drive follows from how far all stages go, those to come among them.
// Of a thousand points one may differ.
TEST(SceneChanges, OfALongListAreShownWhereItChanges) {
  Scene before, after;
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 1000; ++i) points.push_back({0.25 * i, i % 2 * 2.0, 1000.0 + i});
  before.water.pore_pressure = tables::VaryingNumber(tables::point_samples(points));
  points[500][2] = 7.5;
  after.water.pore_pressure = tables::VaryingNumber(tables::point_samples(points));
  const auto changes = scene_changes(before, after, 0);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].key, "water.pore_pressure");
  EXPECT_LT(changes[0].text().size(), 320U);
  EXPECT_THAT(changes[0].before, testing::HasSubstr("[125.0, 0.0, 1500.0], [125.25"));
  EXPECT_THAT(changes[0].after, testing::HasSubstr("[125.0, 0.0, 7.5], [125.25"));
  EXPECT_THAT(changes[0].after, testing::HasSubstr(" characters)"));
}

TEST(SceneChanges, OfAStageToComeMayReachFarther) {
  const std::string text = support::sample_with(
      "kind = \"displacement\"\nrange_min = 0.0\nrange_max = 0.5\ndirection = [0.0, -1.0]\n"
      "target = 0.05\nwidth = 0.5\n",
      R"([[stage]]
name = "there"
to = 0.05
drive = { kind = "displacement", range_max = 0.5, range_min = 0.0, direction = [0.0, -1.0], width = 0.5 }
[[stage]]
name = "on"
to = 0.08
)");
  const auto changes = [&](const std::string& first, const std::string& setting) {
    const auto before = parse_scene(text, "s.toml", std::vector<std::string>{first});
    const auto after = parse_scene(text, "s.toml", std::vector<std::string>{first, setting});
    EXPECT_TRUE(before.scene && after.scene);
    return scene_changes(*before.scene, *after.scene, 0);
  };
  EXPECT_THAT(changes("title=a", "stage.1.to=0.1"),
              ElementsAre(SceneChange{"stage.0.drive.target", "0.08", "0.1", true},
                          SceneChange{"stage.1.to", "0.08", "0.1", true}));
  // Of the stage that has begun nothing may change.
  EXPECT_THAT(changes("title=a", "stage.0.to=0.04"),
              ElementsAre(SceneChange{"stage.0.to", "0.05", "0.04", false}));
}

// What a stage to come is now to do would change the control of the whole run, whose state it is
// of.
TEST(SceneChanges, OfAStageToComeKeepTheControlOfTheRun) {
  for (const char* model : {"von_mises", "mohr_coulomb"}) {
    Scene before;
    before.geometry.dimension = 2;
    before.material.emplace_back().model = model;
    before.stage.resize(2);
    before.stage[0].hold = {"strut"};
    Scene after = before;
    after.stage[1].kh = 0.1;
    ASSERT_NE(resolve_stiffness_ratio(after) * static_cast<int>(resolve_control(after)),
              resolve_stiffness_ratio(before) * static_cast<int>(resolve_control(before)));
    keep_methods(before, after);
    EXPECT_EQ(resolve_control(after), resolve_control(before)) << model;
    EXPECT_EQ(resolve_stiffness_ratio(after), resolve_stiffness_ratio(before)) << model;
    for (const SceneChange& change : scene_changes(before, after, 0)) {
      EXPECT_EQ(change.key, "stage.1.kh");
    }
  }
}

}  // namespace
}  // namespace scene

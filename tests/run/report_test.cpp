// What a run says at its end.
#include "run/report.hpp"

#include <gmock/gmock.h>

#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "support/sample_scene.hpp"
#include "support/temporary_folder.hpp"

namespace run {
namespace {

// A plate is pressed and then held while nothing else moves: what bears on it is what the curve
// has.
TEST(EndReport, SaysWhatIsHeldWhenNothingMovesAnyMore) {
  const auto reading = scene::parse_scene(R"(
[geometry]
min = [0, 0]
max = [2, 1]
spacing = 0.25
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[traction]]
name = "q"
side = "right"
value = [-1e3, 0.0]
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
width = 2.0
reference_length = 0.5
[[stage]]
name = "press"
to = 0.01
[[stage]]
name = "push"
steps = 1
drive = { name = "side", kind = "load", scales = ["traction"] }
)",
                                          "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  record::CurveRow row;
  row.step = 2;
  row.load_parameter = 1.0;
  row.settlement = 0.01;
  row.settlement_over_B = 0.02;
  row.mean_pressure = 54321.0;
  const support::TemporaryFolder folder;
  const record::RunFolder place(folder / "run");
  const std::string text =
      end_report(scene::scene_of_stage(*reading.scene, 1), {}, {row}, 1.0, place, "checkpoint");
  EXPECT_THAT(text, ::testing::HasSubstr("settlement 0.01 m, d/B 0.02"));
  EXPECT_THAT(text, ::testing::HasSubstr("54321 Pa mean"));
}

// Loads that grow may end in a collapse or not; only the run knows.
TEST(ControlNote, IsForLoadsBorneToTheEndByGroundThatYields) {
  const auto scene_of = [](const std::string& more) {
    const auto reading =
        scene::parse_scene(std::string(support::pressed_block) + "steps = 1\n" + more, "s.toml");
    return *reading.scene;
  };
  record::CurveRow yields, stays_elastic;
  yields.max_plastic_strain = 1e-3;
  EXPECT_THAT(control_note(scene_of(""), yields), ::testing::HasSubstr("stiffness_ratio = 0.1"));
  EXPECT_EQ(control_note(scene_of(""), stays_elastic), "");
  EXPECT_EQ(control_note(scene_of("[hourglass]\nstiffness_ratio = 0.001\n"), yields), "");
}

}  // namespace
}  // namespace run

// What a run says at its end.
#include "run/report.hpp"

#include <gmock/gmock.h>

#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "stepping/settle.hpp"
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

// A square between smooth mirrors and pressures that are alike: at rest the stress is, too,
// whatever K0 is asked for.
TEST(LateralNotes, AreOfAStressThatFacesDecide) {
  const auto notes = [](const std::string& initial) {
    const auto reading = scene::parse_scene(R"(
[geometry]
dimension = 2
spacing = 0.5
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e9
poissons_ratio = 0.3
[[region]]
name = "block"
material = "rock"
outline = [[0, 0], [4, 0], [4, 4], [0, 4]]
[[side]]
name = "inside"
along = [[0, 4], [0, 0], [4, 0]]
kind = "symmetry"
[[side]]
name = "outside"
along = [[4, 0], [4, 4], [0, 4]]
kind = "loaded"
pressure = 1e6
live_pressure = 1e5
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 1
)" + initial,
                                            "s.toml");
    EXPECT_TRUE(reading.scene) << reading.errors.front().text();
    return lateral_notes(*reading.scene, stepping::model_at_rest<2>(*reading.scene));
  };
  EXPECT_THAT(notes("[initial_stress]\nkind = \"gravity\"\nK0 = 0.5\n"),
              ::testing::ElementsAre(::testing::HasSubstr("K0 asks for 0.5; at rest the ground has "
                                                          "1 times its vertical stress")));
  EXPECT_THAT(notes("[initial_stress]\nkind = \"gravity\"\nK0 = 1.0\n"), ::testing::IsEmpty());
  EXPECT_THAT(notes("[initial_stress]\nkind = \"gravity\"\n"), ::testing::IsEmpty());
}

}  // namespace
}  // namespace run

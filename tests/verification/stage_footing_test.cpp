// Rough footings that stages drive, let go and drive again.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "staged_run.hpp"

namespace verification {
namespace {

// The solver leaves 1e-9 of forces; stresses are worse by the condition.
constexpr double of_solver = 1e-6;

// A rough footing beside a slope, at the lower end of it or level with its top: on no face of the
// box, or on one.
std::string footing_on(double rise) {
  const double top = 2.0 + rise;
  return fmt::format(R"(
[geometry]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[region]]
name = "ground"
material = "m"
outline = [[0, 0], [4, 0], [4, {0}], [2, {0}], [1.5, 2], [1, 2], [0, 2]]
[[side]]
name = "foot"
kind = "footing"
base = "rough"
along = [[1, 2], [0, 2]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [4, 0]]
[[side]]
name = "middle"
kind = "symmetry"
along = [[0, 2], [0, 0]]
[[side]]
name = "far"
kind = "roller"
along = [[4, 0], [4, {0}]]
[[side]]
name = "open"
kind = "free"
along = [[4, {0}], [2, {0}], [1.5, 2], [1, 2]]
[solver]
tolerance = 1e-9
)",
                     top);
}

// Whoever drives it in the first stage, a rough footing holds the ground.
TEST(StageFootings, HoldTheGroundWhoeverDrivesThemInTheFirstStage) {
  StagedRun usual(scene_of(footing_on(0.0) + R"(
[drive]
kind = "displacement"
[[stage]]
name = "press"
to = 0.01
steps = 1
)"));
  StagedRun own(scene_of(footing_on(0.0) + R"(
[[stage]]
name = "press"
steps = 1
drive = { kind = "displacement", target = 0.01 }
)"));
  ASSERT_TRUE(usual.complete_stage());
  ASSERT_TRUE(own.complete_stage());
  EXPECT_GT(usual.state.stress.cwiseAbs().maxCoeff(), 1e4);
  EXPECT_EQ(own.state.stress, usual.state.stress);
}

// Elastic ground that was pressed, let go and pressed again bears what it bore: a footing that
// comes back holds it likewise both times, be it on a face of the box or not.
TEST(StageFootings, PressAgainWhatTheyLetGo) {
  for (const double rise : {0.0, 0.5}) {
    StagedRun run(scene_of(footing_on(rise) + R"(
[drive]
kind = "displacement"
[[stage]]
name = "press"
to = 0.01
steps = 1
[[stage]]
name = "let go"
release = ["drive"]
steps = 1
[[stage]]
name = "again"
drive.name = "drive"
to = 0.01
steps = 1
)"));
    ASSERT_TRUE(run.complete_stage());
    const auto pressed = run.state.stress;
    const double size = pressed.cwiseAbs().maxCoeff();
    EXPECT_GT(size, 1e4);
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage());
    EXPECT_LT(run.state.stress.cwiseAbs().maxCoeff(), of_solver * size);
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage());
    EXPECT_LT((run.state.stress - pressed).cwiseAbs().maxCoeff(), of_solver * size) << rise;
  }
}

}  // namespace
}  // namespace verification

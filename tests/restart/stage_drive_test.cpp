// Runs whose stages have drives of their own, and switch supports of every method, are resumed
// inside and between them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "record/curve_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::Contains;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Weight; a strip pressed into the ground; a load beside it under a prop of springs; the strip once
// more, with a wall that only touches in place of the prop; half of the load and the strip taken
// back. Rows are searched anew all along.
const std::string driven = R"(
title = "small stages with drives of their own"
[geometry]
min = [0.0, 0.0]
max = [4.0, 2.0]
spacing = 0.25
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 2e6
poissons_ratio = 0.3
cohesion = 20e3
friction_angle = 20.0
dilation_angle = 5.0
unit_weight = 18e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "prop"
side = "right"
directions = ["x"]
method = "penalty"
[[support]]
name = "wall"
side = "right"
directions = ["x"]
method = "contact"
friction_angle = 10.0
[[traction]]
name = "q"
side = "top"
range_min = [2.0]
range_max = [4.0]
value = [0.0, -20e3]
[drive]
name = "weight"
kind = "load"
scales = ["gravity"]
[re_search]
enabled = true
trigger = 0.005
[[stage]]
name = "weigh"
to = 1.0
steps = 2
[[stage]]
name = "press"
steps = 5
[stage.drive]
name = "strip"
kind = "displacement"
side = "top"
range_min = [0.0]
range_max = [1.0]
direction = [0.0, -1.0]
target = 0.1
width = 1.0
[[stage]]
name = "beside"
hold = ["prop"]
steps = 3
drive = { name = "q", kind = "load", scales = ["traction"] }
[[stage]]
name = "press on"
release = ["prop"]
hold = ["wall"]
drive.name = "strip"
to = 0.14
steps = 3
[[stage]]
name = "off"
release = ["strip"]
drive.name = "q"
to = 0.5
steps = 3
[output]
frames_every = 0
checkpoints_every = 1
checkpoints_kept = 100
)";

TEST(StagesWithDrives, AreResumedAtEveryStepBitByBit) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole";
  const auto outcome = fpm_run_in(whole, driven, {"--threads", "1"});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  const auto rows = record::read_curve(whole / "curve.csv");
  const auto last = static_cast<int>(rows.back().step);
  ASSERT_GE(last, 16);
  EXPECT_GT(column_sum_after(whole, "researched_rows", 0), 0.0);
  for (int step = 1; step < last; ++step) {
    const auto resumed = folder / ("from " + std::to_string(step));
    const auto again = fpm_run_in(
        resumed, driven, {"--threads", "1", "--resume=" + checkpoint_of(whole, step).string()});
    ASSERT_EQ(again.code, program::ExitCode::done) << again.err;
    EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(resumed)), IsEmpty())
        << "from step " << step;
    EXPECT_EQ(curve_without_wall(resumed), curve_without_wall(whole)) << "from step " << step;
  }
}

TEST(StagesWithDrives, SayInTheCurveWhereEachDriveIs) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole";
  ASSERT_EQ(fpm_run_in(whole, driven).code, program::ExitCode::done);
  const auto columns = record::read_curve_columns(whole / "curve.csv").measures;
  ASSERT_GE(columns.size(), 4U);
  EXPECT_EQ(columns[0], "stage");
  EXPECT_EQ(columns[1], "weight_load_parameter");
  EXPECT_EQ(columns[2], "strip_moved_m");
  EXPECT_EQ(columns[3], "q_load_parameter");
  EXPECT_THAT(columns, Contains("strip_Ry_N_per_m"));
  double settlement = 0.0;
  for (const auto& row : record::read_curve(whole / "curve.csv")) {
    const double stage = row.measures[0];
    EXPECT_DOUBLE_EQ(row.measures[1], stage > 1.0 ? 1.0 : row.load_parameter);
    // What is held stays; what was released is gone.
    if (stage == 3.0) {
      EXPECT_DOUBLE_EQ(row.settlement, 0.1);
      EXPECT_THAT(row.reaction, Gt(0.0));
    }
    if (stage == 5.0) {
      EXPECT_EQ(row.measures[2], 0.0);
    }
    if (stage == 4.0) settlement = row.settlement;
  }
  EXPECT_DOUBLE_EQ(settlement, 0.14);
}

// What a drive has begun with does not change; one that is yet to come may.
TEST(StagesWithDrives, ThatHaveNotBegunMayChangeTheirs) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", branch = folder / "branch";
  ASSERT_EQ(fpm_run_in(whole, driven).code, program::ExitCode::done);
  const auto allowed = fpm_run_in(branch, driven,
                                  {"--resume=" + whole.string(), "--from-stage", "press", "--set",
                                   "stage.press.drive.target=0.05", "--set", "stage.3.to=0.08"});
  EXPECT_EQ(allowed.code, program::ExitCode::done) << allowed.err;
  const auto late = fpm_run_in(
      branch, driven,
      {"--resume=" + last_checkpoint(whole).string(), "--set", "stage.press.drive.target=0.05"});
  EXPECT_EQ(late.code, program::ExitCode::input_refused);
  EXPECT_THAT(late.err,
              HasSubstr("stage.1.drive.target: the checkpoint has 0.1, the scene 0.05; it "
                        "may not change"));
}

}  // namespace
}  // namespace restart

// A run that is killed inside a stage that changes the ground goes on as if it had not been.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "faulty_system.hpp"
#include "record/checkpoint_name.hpp"
#include "record/curve_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::IsEmpty;

// A pit is dug, a fill put down, water drawn down, a bench improved and a strength lost.
const std::string changed_ground = R"(
title = "small changed ground"
[geometry]
spacing = 0.25
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 2e6
poissons_ratio = 0.3
cohesion = 5e3
friction_angle = 20.0
dilation_angle = 5.0
unit_weight = 18e3
saturated_unit_weight = 20e3
[[material]]
name = "improved"
model = "drucker_prager"
youngs_modulus = 5e6
poissons_ratio = 0.2
cohesion = 20e3
friction_angle = 30.0
dilation_angle = 5.0
unit_weight = 20e3
[water]
table = [[0, 0.8], [4, 0.8]]
[[region]]
name = "ground"
material = "soil"
outline = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[region]]
name = "pit"
material = "soil"
outline = [[0, 1], [1.5, 1], [1.5, 1.75], [0, 1.75]]
[[region]]
name = "bench"
material = "soil"
outline = [[1.5, 1], [4, 1], [4, 1.75], [1.5, 1.75]]
[[region]]
name = "fill"
material = "soil"
outline = [[2, 1.75], [4, 1.75], [4, 2.5], [2.5, 2.5]]
[[side]]
name = "left"
kind = "symmetry"
along = [[0, 1.75], [0, 0]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [4, 0]]
[[side]]
name = "right"
kind = "roller"
along = [[4, 0], [4, 2.5]]
[[side]]
name = "surface"
kind = "free"
along = [[4, 2.5], [2.5, 2.5], [2, 1.75], [0, 1.75]]
[initial_stress]
kind = "gravity"
[[stage]]
name = "dig"
remove = ["pit"]
steps = 3
[[stage]]
name = "fill"
place = ["fill"]
steps = 3
[[stage]]
name = "drain"
water_table = [[0, 0.3], [4, 0.3]]
steps = 3
[[stage]]
name = "improve"
regions = ["bench"]
become = ["improved"]
steps = 3
[[stage]]
name = "soften"
materials = ["soil"]
cohesion = [3e3]
steps = 3
[output]
frames_every = 0
checkpoints_every = 1
checkpoints_kept = 100
)";

// The same, rows being searched anew where it yields.
const std::string searched_ground = changed_ground + R"(
[re_search]
enabled = true
trigger = 0.0005
)";

// In a child process, which is killed when the checkpoint of a step is about to get its name.
bool killed_at(const std::filesystem::path& run, const std::string& scene, int step,
               const std::vector<std::string>& arguments) {
  const std::string name = record::checkpoint_name(step);
  const pid_t child = ::fork();
  if (child == 0) {
    const files::SystemCalls system = faulty_system([&](std::int64_t, const Call& call) {
      if (call.name == "rename" && call.path.ends_with(name)) ::kill(::getpid(), SIGKILL);
      return Fault{};
    });
    (void)fpm_run_in(run, scene, arguments, system);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

void expect_the_same_after_kills(const std::string& scene) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", killed = folder / "killed";
  const auto outcome = fpm_run_in(whole, scene, {"--threads", "1"});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  // Inside each stage: the last step but one is lost.
  const auto rows = record::read_curve(whole / "curve.csv");
  std::vector<int> lost;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const auto stage = [&](std::size_t row) { return rows[row].measures[0]; };
    const bool is_last = i + 2 == rows.size() || stage(i + 2) != stage(i);
    if (is_last && stage(i + 1) == stage(i)) lost.push_back(static_cast<int>(rows[i].step));
  }
  ASSERT_EQ(lost.size(), 5U);
  std::vector<std::string> arguments{"--threads", "1"};
  for (const int step : lost) {
    ASSERT_TRUE(killed_at(killed, scene, step, arguments)) << "step " << step;
    EXPECT_EQ(last_checkpoint(killed), checkpoint_of(killed, step - 1));
    arguments = {"--threads", "1", "--resume"};
  }
  ASSERT_EQ(fpm_run_in(killed, scene, arguments).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(killed)), IsEmpty());
  EXPECT_EQ(curve_without_wall(killed), curve_without_wall(whole));
}

TEST(StagesThatChangeTheGround, AreGoneOnWithBitByBitAfterAKillInsideEach) {
  expect_the_same_after_kills(changed_ground);
}

TEST(StagesThatChangeTheGround, AreGoneOnWithBitByBitWithRowsSearchedAnew) {
  expect_the_same_after_kills(searched_ground);
  const support::TemporaryFolder folder;
  ASSERT_EQ(fpm_run_in(folder / "run", searched_ground).code, program::ExitCode::done);
  EXPECT_GT(column_sum_after(folder / "run", "researched_rows", 0), 0.0);
}

// A lift of one row, put down in the second stage, has no rows for the face that the scene gives
// it.
TEST(StagesThatChangeTheGround, AreRefusedBeforeTheRunBeginsWhereOneToComeCannotBe) {
  std::string text = R"([geometry]
spacing = 0.1
[gravity]
acceleration = [0, -10]
[[region]]
name = "ground"
material = "soil"
outline = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[region]]
name = "lift"
material = "fill"
outline = [[0, 1], [2, 1], [2, 1.1], [0, 1.1]]
[[interface]]
between = ["soil", "fill"]
kind = "contact"
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [2, 0]]
[[side]]
name = "rest"
kind = "free"
along = [[2, 0], [2, 1.1], [0, 1.1], [0, 0]]
[[stage]]
name = "shake"
kh = 0.01
steps = 1
[[stage]]
name = "fill"
place = ["lift"]
steps = 1
)";
  for (const char* name : {"soil", "fill"}) {
    text += std::string("[[material]]\nname = \"") + name +
            "\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\ndensity = 2e3\n";
  }
  const support::TemporaryFolder folder;
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--check"}, std::vector<std::string>{}}) {
    const Outcome outcome = fpm_run_in(folder / "run", text, arguments);
    EXPECT_EQ(outcome.code, program::ExitCode::input_refused);
    EXPECT_THAT(outcome.err,
                ::testing::HasSubstr("interface.0.kind: \"fill\" is less than three particles"));
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  }
}

}  // namespace
}  // namespace restart

// The output folder: nothing doubled, nothing missing, nothing lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <fstream>

#include "files/durable_file.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/checkpoint_name.hpp"
#include "record/curve_file.hpp"
#include "record/frame_series.hpp"
#include "record/run_folder.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> frames_listed(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  const double all = 1e300;
  const record::FrameSeries series = record::FrameSeries::resume(folder / "run.hdf.series", all);
  for (const auto& entry : series.entries()) {
    names.push_back(std::filesystem::path(entry.name).filename().string());
  }
  return names;
}

TEST(OutputFolder, OfAResumedRunHoldsEveryStepAndFrameOnce) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, footing).code, program::ExitCode::done);
  const auto curve = curve_without_wall(run);
  const auto frames = frames_listed(run);
  EXPECT_EQ(names_in(run / "frames"), frames);
  ASSERT_GE(frames.size(), 6U);
  ASSERT_EQ(fpm_run_in(run, footing, {"--resume=" + checkpoint_of(run, 9).string()}).code,
            program::ExitCode::done);
  EXPECT_EQ(curve_without_wall(run), curve);
  EXPECT_EQ(frames_listed(run), frames);
  EXPECT_EQ(names_in(run / "frames"), frames);
}

TEST(OutputFolder, KeepsLaterCheckpointsOfACourseThatIsGivenUpUnderAnotherName) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, block).code, program::ExitCode::done);
  const std::string from = "--resume=" + checkpoint_of(run, 2).string();
  ASSERT_EQ(fpm_run_in(run, block, {from, "--max-wall", "0.000000001s"}).code,
            program::ExitCode::interrupted);
  EXPECT_EQ(last_checkpoint(run), checkpoint_of(run, 2));
  EXPECT_THAT(names_in(run / "checkpoints"),
              ElementsAre("step-000000.hdf", "step-000001.hdf", "step-000002.hdf",
                          "step-000003.hdf.set-aside", "step-000004.hdf.set-aside",
                          "step-000005.hdf.set-aside", "step-000006.hdf.set-aside"));
}

TEST(OutputFolder, ThatLostItsCurveGetsItBackFromTheCheckpoint) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, footing).code, program::ExitCode::done);
  const auto curve = curve_without_wall(run);
  std::filesystem::remove(run / "curve.csv");
  std::filesystem::remove_all(run / "frames");
  ASSERT_EQ(fpm_run_in(run, footing, {"--resume=" + checkpoint_of(run, 15).string()}).code,
            program::ExitCode::done);
  EXPECT_EQ(curve_without_wall(run), curve);
}

TEST(OutputFolder, KeepsResultsOfAnEarlierRunWhenResumeWasForgotten) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, block).code, program::ExitCode::done);
  const std::string checkpoint = bytes_of_file(last_checkpoint(run));
  const std::string curve = bytes_of_file(run / "curve.csv");
  const Outcome again = fpm_run_in(run, block);
  ASSERT_EQ(again.code, program::ExitCode::done);
  EXPECT_THAT(again.out, HasSubstr("results of an earlier run are now in "));
  EXPECT_EQ(bytes_of_file(last_checkpoint(run / "previous-1")), checkpoint);
  EXPECT_EQ(bytes_of_file(run / "previous-1" / "curve.csv"), curve);
}

TEST(OutputFolder, KeepsTheNewestCheckpointsOnly) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(
      fpm_run_in(run, block,
                 {"--set", "output.checkpoints_every=2", "--set", "output.checkpoints_kept=2"})
          .code,
      program::ExitCode::done);
  EXPECT_THAT(names_in(run / "checkpoints"), ElementsAre("step-000004.hdf", "step-000006.hdf"));
}

TEST(OutputFolder, KeepsTheFirstCheckpointOfEveryStretchForGood) {
  const support::TemporaryFolder folder;
  const auto stays = [&](std::vector<int> steps, const record::Retention& retention) {
    std::vector<int> left;
    for (const int step : steps) {
      std::ofstream(folder / record::checkpoint_name(step)) << "x";
      record::remove_older(folder.path(), step, retention);
    }
    for (const auto& path : record::list_checkpoints(folder.path())) {
      left.insert(left.begin(), static_cast<int>(*record::step_of(path)));
      std::filesystem::remove(path);
    }
    return left;
  };
  const std::vector<int> steps{0, 10, 20, 30, 40, 50, 60, 70};
  EXPECT_EQ(stays(steps, {.newest = 2}), (std::vector{60, 70}));
  EXPECT_EQ(stays(steps, {.newest = 2, .every = 20}), (std::vector{0, 20, 40, 60, 70}));
  // 50 comes before 75 and 75 itself never comes: the first after each multiple of 25.
  EXPECT_EQ(stays(steps, {.newest = 1, .every = 25}), (std::vector{0, 30, 50, 70}));
  EXPECT_EQ(stays({0, 7, 31, 33, 64}, {.newest = 1, .every = 30}), (std::vector{0, 31, 64}));
}

TEST(OutputFolder, HasACheckpointBeforeTheFirstStep) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(fpm_run_in(folder / "run", block).code, program::ExitCode::done);
  EXPECT_TRUE(std::filesystem::exists(checkpoint_of(folder / "run", 0)));
}

TEST(OutputFolder, HasCheckpointsByTimeToo) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  const std::string at_once = "output.checkpoints_every_minutes=1e-9";
  ASSERT_EQ(fpm_run_in(run, block, {"--set", "output.checkpoints_every=0", "--set", at_once}).code,
            program::ExitCode::done);
  for (int step = 0; step <= 6; ++step) {
    EXPECT_TRUE(std::filesystem::exists(checkpoint_of(run, step))) << step;
  }
}

TEST(OutputFolder, IsRefusedToASecondRun) {
  const support::TemporaryFolder folder;
  const record::RunFolder held(folder / "run");
  const Outcome second = fpm_run_in(folder / "run", block);
  EXPECT_EQ(second.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(second.err, HasSubstr("another run is writing here (process " +
                                    std::to_string(::getpid()) + " on "));
  EXPECT_EQ(fpm_run_in(folder / "run", block, {"--resume"}).err, second.err);
}

// A process that takes the lock of a folder and is killed.
void die_in(const std::filesystem::path& folder) {
  const pid_t child = ::fork();
  if (child == 0) {
    const record::RunFolder held(folder);
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
}

TEST(OutputFolder, OfADeadOwnerIsTakenAndTheOwnerNamed) {
  const support::TemporaryFolder folder;
  die_in(folder / "run");
  const std::string owner = bytes_of_file(folder / "run" / "run.lock");
  EXPECT_THAT(owner, ContainsRegex("^process [0-9]+ on .* since 2[0-9-]*T[0-9:]*Z\n$"));
  const Outcome outcome = fpm_run_in(folder / "run", block);
  EXPECT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("the last run here (" + owner.substr(0, owner.size() - 1) +
                                     ") ended without a word"));
  // Whoever ends in good order leaves no such trace.
  EXPECT_EQ(bytes_of_file(folder / "run" / "run.lock"), "");
}

// Some network disks have no locks.
TEST(OutputFolder, WithoutLocksIsHeldByTheWordOfAnOwnerWhoMayLive) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  files::SystemCalls without = files::system_calls();
  without.flock = [](int, int) {
    errno = ENOLCK;
    return -1;
  };
  files::create_folder(run);
  const auto refused = [&] {
    try {
      const record::RunFolder held(run, without);
      return std::string();
    } catch (const files::FileError& failure) {
      return failure.reason();
    }
  };
  std::ofstream(run / "run.lock") << "process 1 on another-host since 2024-05-17T08:30:00Z\n";
  EXPECT_THAT(refused(), HasSubstr("(process 1 on another-host since 2024-05-17T08:30:00Z)"));
  EXPECT_THAT(refused(), HasSubstr("or remove run.lock if that run is gone"));
  die_in(run);
  EXPECT_EQ(refused(), "");
  EXPECT_EQ(refused(), "");  // given back
}

TEST(OutputFolder, LosesTemporaryFilesOfAKilledRun) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  files::create_folder(run / "checkpoints");
  const auto left = run / "checkpoints" / "step-000007.hdf.tmp-123";
  std::ofstream(left) << "half";
  ASSERT_EQ(fpm_run_in(run, block).code, program::ExitCode::done);
  EXPECT_FALSE(std::filesystem::exists(left));
}

TEST(CheckpointName, IsReadBackAndOthersAreNot) {
  EXPECT_EQ(record::checkpoint_name(120), "step-000120.hdf");
  EXPECT_EQ(record::step_of("a/step-000120.hdf"), 120);
  EXPECT_EQ(record::step_of(record::checkpoint_name(12345678)), 12345678);
  for (const char* other : {"step-.hdf", "step-1x.hdf", "step-000120.hdf.set-aside",
                            "step--00001.hdf", "frame-000120.hdf"}) {
    EXPECT_EQ(record::step_of(other), std::nullopt) << other;
  }
}

TEST(Checkpoint, OfAStepComesBeforeThatOfTenTimesTheStep) {
  const support::TemporaryFolder folder;
  for (const int step : {999999, 1000000, 20}) {
    std::ofstream(folder / record::checkpoint_name(step)) << "x";
  }
  const auto found = record::list_checkpoints(folder.path());
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(record::step_of(found[0]), 1000000);
  EXPECT_EQ(record::step_of(found[2]), 20);
}

}  // namespace
}  // namespace restart

// Runs in stages are resumed inside and between them, and branch from the end of any.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "record/curve_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The last step of each stage, by the curve.
std::vector<std::int64_t> ends_of(const std::filesystem::path& folder) {
  std::vector<std::int64_t> ends;
  const auto rows = record::read_curve(folder / "curve.csv");
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (i + 1 == rows.size() || rows[i].measures[0] != rows[i + 1].measures[0]) {
      ends.push_back(rows[i].step);
    }
  }
  return ends;
}

TEST(Stages, AreResumedAtEachBoundaryBitByBit) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole";
  ASSERT_EQ(fpm_run_in(whole, staged).code, program::ExitCode::done);
  const auto ends = ends_of(whole);
  ASSERT_EQ(ends.size(), 3U);
  for (const std::int64_t end : ends) {
    for (const int step : {static_cast<int>(end) - 1, static_cast<int>(end)}) {
      if (end == ends.back() && step == end) continue;
      const auto resumed = folder / ("from " + std::to_string(step));
      const auto outcome =
          fpm_run_in(resumed, staged, {"--resume=" + checkpoint_of(whole, step).string()});
      ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
      EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(resumed)), IsEmpty());
      EXPECT_EQ(curve_without_wall(resumed), curve_without_wall(whole));
    }
  }
}

TEST(Stages, OfACurveGoBackAndForth) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole";
  ASSERT_EQ(fpm_run_in(whole, staged).code, program::ExitCode::done);
  const auto rows = record::read_curve(whole / "curve.csv");
  const auto ends = ends_of(whole);
  ASSERT_EQ(ends.size(), 3U);
  EXPECT_EQ(record::read_curve_columns(whole / "curve.csv").measures.front(), "stage");
  const auto settlement_at = [&](std::int64_t step) {
    return rows[static_cast<std::size_t>(step)].settlement;
  };
  EXPECT_DOUBLE_EQ(settlement_at(ends[0]), 0.1);
  EXPECT_DOUBLE_EQ(settlement_at(ends[1]), 0.08);
  EXPECT_DOUBLE_EQ(settlement_at(ends[2]), 0.15);
  EXPECT_LT(rows[static_cast<std::size_t>(ends[0]) + 1].increment, 0.0);
}

// Their ends stay for good, however few checkpoints do.
TEST(Stages, AreGoneOnWithByName) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", branch = folder / "branch";
  ASSERT_EQ(fpm_run_in(whole, staged, {"--set", "output.checkpoints_kept=1"}).code,
            program::ExitCode::done);
  for (const std::string name : {"back", "on"}) {
    const auto outcome =
        fpm_run_in(branch, staged, {"--resume=" + whole.string(), "--from-stage", name});
    ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
    EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(branch)), IsEmpty());
    EXPECT_EQ(curve_without_wall(branch), curve_without_wall(whole));
  }
  // In the same folder, too.
  ASSERT_EQ(fpm_run_in(whole, staged, {"--from-stage", "on"}).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(branch), last_checkpoint(whole)), IsEmpty());
}

TEST(Stages, ThatHaveNotBegunMayChange) {
  const support::TemporaryFolder folder;
  const auto first = folder / "first", branch = folder / "branch", other = folder / "other";
  const std::vector<std::string> change{"--set", "stage.2.to=0.12", "--set", "stage.2.steps=3"};
  const auto with_change = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), change.begin(), change.end());
    return arguments;
  };
  ASSERT_EQ(fpm_run_in(first, staged).code, program::ExitCode::done);
  ASSERT_EQ(fpm_run_in(other, staged, change).code, program::ExitCode::done);
  const auto outcome =
      fpm_run_in(branch, staged, with_change({"--resume=" + first.string(), "--from-stage", "on"}));
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  EXPECT_THAT(differing_fields(last_checkpoint(other), last_checkpoint(branch)), IsEmpty());
  EXPECT_EQ(curve_without_wall(branch), curve_without_wall(other));

  const auto late =
      fpm_run_in(branch, staged, with_change({"--resume=" + last_checkpoint(first).string()}));
  EXPECT_EQ(late.code, program::ExitCode::input_refused);
  EXPECT_THAT(late.err, HasSubstr("stage.2.to: the checkpoint has 0.15, the scene 0.12; it may not "
                                  "change"));
}

TEST(Stages, ThatAreNoneOrNotReachedAreRefusedByName) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  const auto misspelt = fpm_run_in(run, staged, {"--from-stage", "bakc"});
  EXPECT_EQ(misspelt.code, program::ExitCode::input_refused);
  EXPECT_THAT(misspelt.err, HasSubstr("--from-stage: found \"bakc\"; stages are there, back, on"));
  const auto first = fpm_run_in(run, staged, {"--from-stage", "there"});
  EXPECT_EQ(first.code, program::ExitCode::input_refused);
  EXPECT_THAT(first.err, HasSubstr("with the first stage a run begins"));
  ASSERT_EQ(fpm_run_in(run, staged, {"--max-wall", "0.000000001s"}).code,
            program::ExitCode::interrupted);
  const auto early = fpm_run_in(run, staged, {"--from-stage", "on"});
  EXPECT_EQ(early.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(early.err, HasSubstr("stage 2 of the run is not at its end"));
}

}  // namespace
}  // namespace restart

#include "program/progress.hpp"

#include <gmock/gmock.h>

#include <sstream>

namespace program {
namespace {

ProgressStatus sample() {
  ProgressStatus status;
  status.step = 40;
  status.fraction = 0.25;
  status.settlement_over_B = 0.0375;
  status.mean_pressure = 61234.0;
  status.newton_iterations = 3;
  status.evaluations = 47;
  status.residual_ratio = 8.7e-4;
  status.cuts = 2;
  status.yielding_share = 0.31;
  status.re_searched_rows = 12;
  status.elapsed = 30.0;
  return status;
}

TEST(ProgressLine, SaysAllWhenThereIsRoom) {
  EXPECT_EQ(progress_line(sample(), 200),
            " 25.0 % | step 40 | d/B 3.75 % | p 61.23 kPa | Newton 3 evals 47 | res 8.7e-04 | "
            "cuts 2 | yielding 31 % | re-searched 12 | 1 min 30 s left");
}

TEST(ProgressLine, LeavesOutTheLeastUrgentFirst) {
  EXPECT_EQ(progress_line(sample(), 79),
            " 25.0 % | step 40 | d/B 3.75 % | p 61.23 kPa | cuts 2 | 1 min 30 s left");
  EXPECT_EQ(progress_line(sample(), 40), " 25.0 % | d/B 3.75 % | p 61.23 kPa");
  for (std::size_t width = 1; width < 150; ++width) {
    EXPECT_LE(progress_line(sample(), width).size(), width);
  }
}

TEST(ProgressLine, HasNoSettlementWithoutADrivenPlate) {
  ProgressStatus status;
  status.step = 1;
  EXPECT_EQ(progress_line(status, 200),
            "  0.0 % | step 1 | Newton 0 evals 0 | res 0.0e+00 | yielding 0 %");
}

TEST(TimeLeft, FollowsThePaceAndIsSilentAtFirst) {
  EXPECT_EQ(time_left(sample()), 90.0);
  ProgressStatus early = sample();
  early.fraction = 0.001;
  EXPECT_FALSE(time_left(early));
  early = sample();
  early.elapsed = 0.5;
  EXPECT_FALSE(time_left(early));
  ProgressStatus done = sample();
  done.fraction = 1.0;
  EXPECT_EQ(time_left(done), 0.0);
}

TEST(Duration, IsSaidAsPeopleDo) {
  EXPECT_EQ(duration_text(8.4), "8 s");
  EXPECT_EQ(duration_text(59.6), "1 min 00 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(duration_text(7800), "2 h 10 min");
  EXPECT_EQ(duration_text(-1), "0 s");
}

TEST(Progress, RewritesOneLineOnATerminal) {
  std::ostringstream out;
  Progress progress(out, ProgressMode::live, 80);
  progress.update(sample());
  ProgressStatus later = sample();
  later.elapsed += 1.0;
  progress.update(later);
  EXPECT_THAT(out.str(), ::testing::Not(::testing::HasSubstr("\n")));
  progress.finish();
  EXPECT_THAT(out.str(), ::testing::EndsWith("\n"));
}

TEST(Progress, WritesPlainLinesNoFasterThanItsIntervalAndTheLastOneAlways) {
  std::ostringstream out;
  Progress progress(out, ProgressMode::lines, 80, 2.0);
  for (int i = 0; i <= 10; ++i) {
    ProgressStatus status = sample();
    status.step = i;
    status.elapsed = 0.5 * i;  // 0 .. 5 s
    progress.update(status);
  }
  progress.finish();
  progress.finish();
  std::vector<std::string> steps;
  std::istringstream lines(out.str());
  for (std::string line; std::getline(lines, line);) {
    steps.push_back(line.substr(line.find("step"), 7));
  }
  EXPECT_THAT(steps, ::testing::ElementsAre("step 0 ", "step 4 ", "step 8 ", "step 10"));
}

TEST(Progress, KeepsMessagesClearOfTheLiveLine) {
  std::ostringstream out;
  Progress progress(out, ProgressMode::live, 80);
  progress.update(sample());
  progress.say("checkpoint written");
  EXPECT_THAT(out.str(), ::testing::EndsWith("\r\x1b[Kcheckpoint written\n"));
}

TEST(Progress, SaysNothingWhenQuiet) {
  std::ostringstream out;
  Progress progress(out, ProgressMode::none);
  progress.update(sample());
  progress.say("checkpoint written");
  progress.finish();
  EXPECT_EQ(out.str(), "");
  EXPECT_EQ(progress_mode(true), ProgressMode::none);
}

}  // namespace
}  // namespace program

#include "campaign/campaign.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include "campaign/word.hpp"
#include "files/file_error.hpp"
#include "support/temporary_folder.hpp"

namespace campaign {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using Stage = Status::Stage;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// What stands for fpm-run: it notes its arguments and does what the scene, a line of shell, says.
constexpr const char* stand_in = R"(#!/bin/sh
if [ "$2" = --check ]; then
  grep -q refuse "$1" && { echo 'error: refused so'; exit 2; }
  printf 'x: no errors\n  memory       3.5 MiB, much\n  steps        7 planned\n'
  exit 0
fi
HERE=$(dirname "$0")
echo "$*" >> "$HERE/log"
mkdir -p "$3"
. "$1"
)";

class ACampaign : public ::testing::Test {
 protected:
  ACampaign() {
    std::ofstream(program()) << stand_in;
    std::filesystem::permissions(program(), std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::filesystem::path program() const { return folder_ / "stand-in"; }
  [[nodiscard]] std::vector<Status> made(const std::vector<Task>& tasks, int jobs = 1) const {
    Campaign campaign(tasks, {program(), folder_ / "runs", jobs, 1});
    campaign.run([](const auto&) { return true; });
    return campaign.status();
  }
  /// How often the program was started in earnest.
  [[nodiscard]] std::ptrdiff_t starts() const {
    return std::ranges::count(text_of(folder_ / "log"), '\n');
  }
  support::TemporaryFolder folder_;
};

TEST_F(ACampaign, MakesEachRunOnce) {
  const std::vector<Task> tasks{{"a", ": a\n"}, {"b", ": b\n"}};
  EXPECT_THAT(made(tasks), Each(Field(&Status::stage, Stage::finished)));
  EXPECT_EQ(starts(), 2);
  const std::vector<Status> again = made(tasks);
  EXPECT_THAT(again, Each(Field(&Status::stage, Stage::finished)));
  EXPECT_THAT(again, Each(Field(&Status::was_there, true)));
  EXPECT_EQ(starts(), 2);
  EXPECT_GT(again[0].outcome.cost.wall, 0.0) << "the cost is kept as well";
  EXPECT_GT(again[0].outcome.cost.peak_bytes, 0);
}

TEST_F(ACampaign, MakesARunAnewWhenItsSceneOrTheProgramIsAnother) {
  (void)made({{"a", ": a\n"}});
  (void)made({{"a", ": A\n"}});
  EXPECT_EQ(starts(), 2);
  std::ofstream(program(), std::ios::app) << "# another version\n";
  (void)made({{"a", ": a\n"}});
  EXPECT_EQ(starts(), 3);
}

TEST_F(ACampaign, TakesNoConvergenceForAnEndButNotABugOrAKill) {
  const std::vector<Task> tasks{{"no convergence", "echo 'error: stuck'; exit 3\n"},
                                {"bug", "exit 1\n"},
                                {"killed", "kill -9 $$\n"}};
  const std::vector<Status> first = made(tasks);
  EXPECT_THAT(first, Each(Field(&Status::stage, Stage::failed)));
  EXPECT_EQ(first[0].complaint, "error: stuck");
  EXPECT_EQ(first[2].outcome.exit_code, 128 + SIGKILL);
  EXPECT_EQ(starts(), 3);
  const std::vector<Status> again = made(tasks);
  EXPECT_EQ(starts(), 5) << "the second and the third are tried again";
  EXPECT_EQ(again[0].complaint, "error: stuck") << "said again";
}

TEST_F(ACampaign, RunsAsManyAtATimeAsItIsAllowed) {
  // Each waits until two have begun: one at a time would never end.
  const std::string waits = "while [ $(wc -l < \"$HERE/log\") -lt 2 ]; do sleep 0.01; done\n";
  EXPECT_THAT(made({{"a", waits + ": a\n"}, {"b", waits + ": b\n"}}, 2),
              Each(Field(&Status::stage, Stage::finished)));
  std::size_t most = 0;
  Campaign campaign({{"c", "sleep 0.05\n: c\n"}, {"d", "sleep 0.05\n: d\n"}, {"e", "sleep 0.05\n"}},
                    {program(), folder_ / "runs", 2, 1});
  campaign.run([&](const std::vector<Status>& all) {
    most = std::max(
        most, static_cast<std::size_t>(std::ranges::count(all, Stage::running, &Status::stage)));
    return true;
  });
  EXPECT_EQ(most, 2U);
}

TEST_F(ACampaign, ThatIsStoppedInterruptsItsRunsAndGoesOnLater) {
  const std::string waits =
      "[ -e \"$HERE/go\" ] && exit 0\n"
      "trap 'exit 75' TERM; echo begun >> \"$HERE/begun\"; while :; do sleep 0.01; done\n";
  const std::vector<Task> tasks{{"long", waits}};
  Campaign campaign(tasks, {program(), folder_ / "runs", 1, 1});
  campaign.run([&](const auto&) { return !std::filesystem::exists(folder_ / "begun"); });
  EXPECT_EQ(campaign.status()[0].stage, Stage::waiting);
  EXPECT_EQ(campaign.status()[0].outcome.exit_code, 75);
  EXPECT_TRUE(campaign.status()[0].outcome.cost.complete);
  const double before = campaign.status()[0].outcome.cost.wall;
  std::ofstream(folder_ / "go") << '\n';
  campaign.run([](const auto&) { return true; });
  EXPECT_EQ(campaign.status()[0].stage, Stage::finished);
  EXPECT_GT(campaign.status()[0].outcome.cost.wall, before) << "of both parts together";
}

TEST_F(ACampaign, SaysThatTheCostOfARunIsNotKnownIfItWasKilledItself) {
  const Task task{"a", ": a\n"};
  (void)made({task});
  const std::string digest = digest_of(task.scene, program());
  const auto file = folder_ / "runs" / digest / "outcome.json";
  Outcome outcome = read_outcome(file, digest).value();
  EXPECT_TRUE(outcome.finished());
  outcome.exit_code.reset();  // as it is while the run is at work
  outcome.at_work = true;
  write_outcome(file, outcome);
  const std::vector<Status> again = made({task});
  EXPECT_EQ(again[0].stage, Stage::finished);
  EXPECT_FALSE(again[0].outcome.cost.complete);
}

TEST_F(ACampaign, MakesARunAnewWhoseRecordIsDamaged) {
  const Task task{"a", ": a\n"};
  (void)made({task});
  std::ofstream(folder_ / "runs" / digest_of(task.scene, program()) / "outcome.json") << "{ \"dig";
  (void)made({task});
  EXPECT_EQ(starts(), 2);
}

TEST_F(ACampaign, HasItsFolderForItself) {
  const Campaign campaign({}, {program(), folder_ / "runs", 1, 1});
  EXPECT_THROW(Campaign({}, {program(), folder_ / "runs", 1, 1}), files::FileError);
}

TEST_F(ACampaign, LearnsFromTheCheckWhatRunsNeedAndWhichAreRefused) {
  Campaign campaign({{"good", ": good\n"}, {"bad", ": refuse\n"}},
                    {program(), folder_ / "runs", 1, 1});
  EXPECT_FALSE(campaign.check());
  EXPECT_EQ(campaign.status()[0].bytes, 7 * 512 * 1024);  // 3.5 MiB
  EXPECT_EQ(campaign.status()[0].steps, 7);
  EXPECT_EQ(campaign.status()[1].complaint, "error: refused so");
}

TEST(TimeLeft, IsByThePaceOfWhatHasEndedAndWhatIsUnderWay) {
  Status ended, running, waiting;
  ended.stage = Stage::finished;
  ended.outcome.cost.wall = 10.0;
  running.stage = Stage::running;
  running.elapsed = 6.0;
  running.fraction = 0.6;
  for (Status* one : {&ended, &running, &waiting}) one->bytes = one->steps = 100;
  // 4 s of the one under way and, at 10 s a run, 10 of the one that waits.
  EXPECT_NEAR(time_left({ended, running, waiting}, 1).value(), 14.0, 1e-9);
  EXPECT_NEAR(time_left({ended, running, waiting}, 2).value(), 7.0, 1e-9);
  EXPECT_FALSE(time_left({waiting}, 1).has_value()) << "no pace yet";
  EXPECT_EQ(time_left({ended}, 1).value(), 0.0);
}

TEST(FractionReached, IsOfTheLastWholeLine) {
  const support::TemporaryFolder folder;
  const auto file = folder / "curve.csv";
  EXPECT_EQ(fraction_reached(file), 0.0);
  std::ofstream(file) << "step,load_parameter,x\n";
  EXPECT_EQ(fraction_reached(file), 0.0);
  std::ofstream(file) << "step,load_parameter,x\n0,0,1\n1,0.25,2\n2,0.5";
  EXPECT_EQ(fraction_reached(file), 0.25);
}

}  // namespace
}  // namespace campaign

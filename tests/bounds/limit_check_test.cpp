// fpm-limit beside a run: a script stands for it here, the program itself in tests/cli.
#include "bounds/limit_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <thread>

#include "bounds/limit_bracket.hpp"
#include "scene/scene.hpp"
#include "support/temporary_folder.hpp"

namespace bounds {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* bracket_json =
    R"({"lower_bound": 98.0, "upper_bound": 102.0, "status": "reached", "gap_wanted": 0.02,)"
    R"( "davis_reduced": {"lower_bound": 90.0, "upper_bound": null}})";

class LimitCheckTest : public ::testing::Test {
 protected:
  LimitCheckTest() : run_(folder_ / "run") {
    scene_.limit.check = true;
    scene_.drive.width = 1.0;
  }

  /// A program of a few shell commands; its arguments are $1 ..., the JSON file is "$json".
  std::filesystem::path program(const std::string& commands) const {
    const auto file = folder_ / "fpm-limit";
    std::ofstream(file) << "#!/bin/sh\nscene=$1\njson=$7\n" << commands << '\n';
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }
  std::filesystem::path answering(const std::string& json) const {
    std::ofstream(folder_ / "answer.json") << json;
    return program("cp \"$(dirname \"$0\")/answer.json\" \"$json\"");
  }

  static std::vector<std::string> all_news(LimitCheck& check) {
    std::vector<std::string> all = check.news();
    while (check.pending()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    for (std::string& line : check.news()) all.push_back(std::move(line));
    return all;
  }

  static std::vector<record::CurveRow> plateau_at(double pressure) {
    std::vector<record::CurveRow> rows(3);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].settlement = 0.1 * static_cast<double>(i);
      rows[i].mean_pressure = i == 0 ? 0.0 : pressure;
    }
    return rows;
  }

  support::TemporaryFolder folder_;
  record::RunFolder run_;
  scene::Scene scene_;
};

TEST_F(LimitCheckTest, DoesNothingUnlessAskedFor) {
  scene_.limit.check = false;
  LimitCheck check(scene_, run_, program("exit 1"));
  EXPECT_THAT(all_news(check), IsEmpty());
  EXPECT_EQ(check.verdict(plateau_at(1.0)), "");
  EXPECT_FALSE(std::filesystem::exists(run_.limit()));
}

TEST_F(LimitCheckTest, StartsTheProgramAndHoldsThePlateauAgainstItsBracket) {
  LimitCheck check(scene_, run_, answering(bracket_json));
  EXPECT_EQ(check.verdict({}), "");
  EXPECT_THAT(all_news(check),
              ElementsAre(HasSubstr("meanwhile"),
                          "collapse load: 98 .. 102 Pa (certified, gap 4.00 %); with Davis' "
                          "strength, no bounds: 90 .. none Pa"));
  EXPECT_THAT(check.verdict(plateau_at(100.0)), HasSubstr("inside the bracket"));
  EXPECT_THAT(check.verdict(plateau_at(204.0)), HasSubstr("100.0 % above the upper bound"));
  EXPECT_THAT(check.verdict(plateau_at(49.0)), HasSubstr("50.0 % below the lower bound"));
}

TEST_F(LimitCheckTest, GivesTheProgramTheSceneInForce) {
  scene_.title = "what is in force";
  LimitCheck check(scene_, run_, program("cat \"$scene\"; echo \"$2 $3 $4 $5\""));
  (void)all_news(check);
  std::ifstream log(run_.limit() / "fpm-limit.log");
  const std::string text{std::istreambuf_iterator<char>(log), {}};
  EXPECT_THAT(text, HasSubstr("title = \"what is in force\""));
  EXPECT_THAT(text, HasSubstr("--gap 0.02 --max-seconds 120"));
}

TEST_F(LimitCheckTest, IsKeptByAResumedRunUnlessAnotherGapIsAskedFor) {
  {
    LimitCheck check(scene_, run_, answering(bracket_json));
    (void)all_news(check);
  }
  LimitCheck again(scene_, run_, program("exit 1"));
  EXPECT_FALSE(again.pending());
  EXPECT_THAT(again.news(), ElementsAre(HasSubstr("as computed before")));
  EXPECT_THAT(again.verdict(plateau_at(100.0)), HasSubstr("inside the bracket"));

  scene_.limit.gap = 0.01;
  LimitCheck sharper(scene_, run_, program("exit 1"));
  EXPECT_EQ(sharper.verdict(plateau_at(100.0)), "");
  EXPECT_THAT(all_news(sharper),
              ElementsAre(HasSubstr("meanwhile"), HasSubstr("ended with code 1")));
}

TEST_F(LimitCheckTest, SaysWhyThereIsNoBracket) {
  LimitCheck refused(scene_, run_, program("echo 'error: no footing'; echo Try; exit 2"));
  EXPECT_THAT(all_news(refused), ElementsAre(HasSubstr("meanwhile"),
                                             "limit.check: fpm-limit ended with code 2: error: no "
                                             "footing"));
  LimitCheck killed(scene_, run_, program("kill -9 $$"));
  EXPECT_THAT(all_news(killed).back(), HasSubstr("ended with code 137"));
  LimitCheck absent(scene_, run_, folder_ / "nowhere");
  EXPECT_THAT(all_news(absent), ElementsAre(HasSubstr("cannot be started")));
  LimitCheck garbled(scene_, run_, answering("{}"));
  EXPECT_THAT(all_news(garbled).back(), HasSubstr("ended with code 0"));
}

TEST_F(LimitCheckTest, EndsTheProgramWithTheRunAndLeavesItNoLock) {
  const auto pid_file = folder_ / "pid";
  pid_t process = 0;
  {
    LimitCheck check(scene_, run_,
                     program("ls -l /proc/$$/fd > \"$(dirname \"$0\")/files\"\n"
                             "echo $$ > \"$(dirname \"$0\")/pid.new\"\n"
                             "mv \"$(dirname \"$0\")/pid.new\" \"$(dirname \"$0\")/pid\"\n"
                             "exec sleep 600"));
    while (!std::filesystem::exists(pid_file)) {
      ASSERT_TRUE(check.pending());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::ifstream(pid_file) >> process;
    ASSERT_EQ(::kill(process, 0), 0);
  }
  EXPECT_EQ(::kill(process, 0), -1);
  EXPECT_EQ(errno, ESRCH);
  std::ifstream files(folder_ / "files");
  const std::string text{std::istreambuf_iterator<char>(files), {}};
  EXPECT_THAT(text, HasSubstr("fpm-limit.log"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("run.lock")));
}

}  // namespace
}  // namespace bounds

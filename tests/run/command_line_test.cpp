#include "run/command_line.hpp"

#include <gmock/gmock.h>

#include <new>
#include <sstream>

#include "files/durable_file.hpp"
#include "program/version.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace run {
namespace {

using ::testing::HasSubstr;

const std::string footing = FPM_SHARE_DIR "/scenes/footing.toml";

// The program with a runner that only remembers what it was asked for.
struct Called {
  program::ExitCode code = program::ExitCode::bug;
  std::string out;
  std::string err;
  std::optional<RunRequest> request;
};

Called call(const std::vector<std::string>& arguments,
            program::ExitCode answer = program::ExitCode::done) {
  Called called;
  std::ostringstream out, err;
  called.code = fpm_run(arguments, out, err, [&](const RunRequest& request) {
    called.request = request;
    return answer;
  });
  called.out = out.str();
  called.err = err.str();
  return called;
}

TEST(FpmRun, HandsTheSceneToTheRunnerAndPassesItsExitCodeOn) {
  const Called called = call({footing}, program::ExitCode::not_converged);
  EXPECT_EQ(called.code, program::ExitCode::not_converged);
  ASSERT_TRUE(called.request);
  EXPECT_EQ(*called.request->scene, *scene::read_scene(footing).scene);
  EXPECT_EQ(called.request->scene_file.string(), footing);
  EXPECT_EQ(called.request->directory.string(), "out/footing");
  EXPECT_FALSE(called.request->resume);
  EXPECT_FALSE(called.request->check_only);
  EXPECT_EQ(called.request->threads, 0);
  EXPECT_FALSE(called.request->max_wall_s);
  EXPECT_EQ(called.out, "");
  EXPECT_EQ(called.err, "");
}

TEST(FpmRun, TakesEveryOption) {
  const Called called =
      call({footing, "--set", "geometry.spacing=0.02", "--set", "material.soil.cohesion=3e3",
            "--out", "some where", "--threads", "2", "--max-wall", "1h30m", "--quiet"});
  ASSERT_TRUE(called.request) << called.err;
  EXPECT_EQ(called.request->scene->geometry.spacing, 0.02);
  EXPECT_EQ(called.request->scene->material[0].cohesion, 3e3);
  EXPECT_EQ(called.request->settings.size(), 2U);
  EXPECT_EQ(called.request->directory.string(), "some where");
  EXPECT_EQ(called.request->threads, 2);
  EXPECT_EQ(called.request->max_wall_s, 5400.0);
  EXPECT_TRUE(called.request->quiet);
}

TEST(FpmRun, TakesTheOutputFolderFromCommandLineThenSceneThenName) {
  const std::string set = "output.directory=\"from scene\"";
  const Called by_scene = call({footing, "--set", set});
  const Called by_option = call({footing, "--set", set, "--out", "d"});
  ASSERT_TRUE(by_scene.request && by_option.request);
  EXPECT_EQ(by_scene.request->directory.string(), "from scene");
  EXPECT_EQ(by_option.request->directory.string(), "d");
}

TEST(FpmRun, ResumesFromTheNewestOrANamedCheckpoint) {
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{footing, "--resume"}, ""},
      {{"--resume", footing}, ""},
      {{footing, "--resume", "--quiet"}, ""},
      {{"--resume", footing, "--out", "d"}, ""},
      {{footing, "--resume", "a/step-000120.hdf"}, "a/step-000120.hdf"},
      {{footing, "--resume=b.hdf"}, "b.hdf"},
  };
  for (const auto& [arguments, checkpoint] : cases) {
    const Called called = call(arguments);
    ASSERT_TRUE(called.request) << called.err;
    ASSERT_TRUE(called.request->resume);
    EXPECT_EQ(called.request->resume->checkpoint.string(), checkpoint);
    EXPECT_EQ(called.request->scene_file.string(), footing);
  }
}

TEST(FpmRun, ChecksWithASummaryAndACheckOnlyRequest) {
  const Called called = call({footing, "--check"});
  EXPECT_EQ(called.code, program::ExitCode::done);
  ASSERT_TRUE(called.request);
  EXPECT_TRUE(called.request->check_only);
  EXPECT_THAT(called.out, HasSubstr("7260 (110 x 66, spacing 0.01 m)"));
  EXPECT_THAT(called.out, HasSubstr("mixed, stiffness ratio 0.01"));
}

TEST(FpmRun, DrawsInsteadOfRunning) {
  const Called called = call({footing, "--draw", "scene.svg"});
  ASSERT_TRUE(called.request);
  EXPECT_TRUE(called.request->check_only);
  EXPECT_EQ(called.request->drawing, "scene.svg");
}

TEST(FpmRun, PrintsTheEffectiveSceneWithoutRunning) {
  const Called called = call({footing, "--print-effective", "--set", "re_search.enabled=false"});
  EXPECT_EQ(called.code, program::ExitCode::done);
  EXPECT_FALSE(called.request);
  scene::Scene scene = *scene::read_scene(footing).scene;
  scene.re_search.enabled = false;
  EXPECT_EQ(*scene::parse_scene(called.out, "printed").scene, scene);
}

TEST(FpmRun, AnswersHelpVersionAndReferenceWithoutAScene) {
  EXPECT_THAT(call({"--help"}).out, HasSubstr("--max-wall"));
  EXPECT_EQ(call({"--version"}).out, "fpm-run " + std::string(program::version) + "\n");
  EXPECT_EQ(call({"--scene-reference"}).out, scene::scene_reference());
}

TEST(FpmRun, RefusesABadCommandLineWithAHint) {
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{}, "error: SCENE is missing\n"},
      {{footing, footing}, "error: " + footing + ": one SCENE at a time\n"},
      {{footing, "--chekc"}, "error: --chekc: no such option; did you mean \"--check\"?\n"},
      {{footing, "--thread", "2"},
       "error: --thread: no such option; did you mean \"--threads\"?\n"},
      {{footing, "--threads", "0"},
       "error: --threads: found 0; allowed is a whole number 1 .. 4096\n"},
      {{footing, "--threads", "two"},
       "error: the argument ('two') for option '--threads' is invalid\n"},
      {{footing, "--max-wall", "5"},
       "error: --max-wall: found 5; allowed is a time such as 5h, 30m, 90s, 1h30m\n"},
      {{footing, "--set"}, "error: the required argument for option '--set' is missing\n"},
  };
  for (const auto& [arguments, message] : cases) {
    const Called called = call(arguments);
    EXPECT_EQ(called.code, program::ExitCode::input_refused);
    EXPECT_EQ(called.err, message + "Try fpm-run --help.\n");
    EXPECT_FALSE(called.request);
  }
}

TEST(FpmRun, RefusesABadSceneWithEveryMessage) {
  const Called called =
      call({footing, "--set", "geometry.spacing=-1", "--set", "drive.width=0", "--check"});
  EXPECT_EQ(called.code, program::ExitCode::input_refused);
  EXPECT_FALSE(called.request);
  EXPECT_EQ(called.err,
            "error: --set geometry.spacing=-1: geometry.spacing: found -1; allowed is a number > 0 "
            "[m]\n"
            "error: --set drive.width=0: drive.width: found 0; allowed is a number > 0 [m]\n");
  EXPECT_EQ(called.out, "");
}

TEST(FpmRun, TurnsExceptionsIntoOneMessageAndACode) {
  const auto code_of = [](auto thrown, std::string& message) {
    std::ostringstream out, err;
    const std::vector<std::string> arguments{footing};
    const program::ExitCode code =
        fpm_run(arguments, out, err, [&](const RunRequest&) -> program::ExitCode { throw thrown; });
    message = err.str();
    return code;
  };
  std::string message;
  EXPECT_EQ(code_of(files::FileError("a/step.hdf", "is no whole HDF5 file"), message),
            program::ExitCode::checkpoint_unusable);
  EXPECT_EQ(message, "error: a/step.hdf: is no whole HDF5 file\n");
  EXPECT_EQ(code_of(std::logic_error("sizes 3 and 4"), message), program::ExitCode::bug);
  EXPECT_THAT(message, HasSubstr("internal error: sizes 3 and 4"));
  EXPECT_EQ(code_of(std::bad_alloc(), message), program::ExitCode::bug);
  EXPECT_THAT(message, HasSubstr("out of memory"));
}

TEST(Duration, IsANumberWithItsUnitOrASumOfThem) {
  EXPECT_EQ(parse_duration("5h"), 18000.0);
  EXPECT_EQ(parse_duration("30m"), 1800.0);
  EXPECT_EQ(parse_duration("90s"), 90.0);
  EXPECT_EQ(parse_duration("1h30m"), 5400.0);
  EXPECT_EQ(parse_duration("0.5h"), 1800.0);
  for (const char* bad :
       {"", "5", "h", "-5h", "5d", "30m1h", "5h5h", "0s", "5 h", "infs", "nanh"}) {
    EXPECT_FALSE(parse_duration(bad)) << bad;
  }
}

}  // namespace
}  // namespace run

// Every call by which a run writes fails once, falls short, or is the last one before a kill.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <map>
#include <set>

#include "faulty_system.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/curve_file.hpp"
#include "record/run_folder.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Two steps, one checkpoint kept: whatever goes wrong, an old one has just gone or is about to.
const std::vector<std::string> short_run{
    "--set", "programme.steps=2", "--set", "output.checkpoints_kept=1", "--threads", "1"};

std::vector<std::string> resumed(std::vector<std::string> arguments) {
  arguments.emplace_back("--resume");
  return arguments;
}

enum class Extent { kinds, all };

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    calls_ = calls_of([&](const files::SystemCalls& system) {
      ASSERT_EQ(fpm_run_in(whole(), block, short_run, system).code, program::ExitCode::done);
    });
    curve_ = curve_without_wall(whole());
  }

  [[nodiscard]] std::filesystem::path whole() const { return folder_ / "whole"; }
  void expect_loss_of_nothing_when_one_fails(Extent extent);
  void expect_loss_of_nothing_when_killed(Extent extent);

  /// The numbers of all calls, or of the first and last of each kind of call to each kind of file.
  [[nodiscard]] std::vector<std::int64_t> chosen(Extent extent) const {
    std::map<std::string, std::pair<std::int64_t, std::int64_t>> kinds;
    std::set<std::int64_t> numbers;
    for (std::int64_t at = 0; at < calls(); ++at) {
      const Call& call = calls_[static_cast<std::size_t>(at)];
      std::string kind = call.name + call.path;
      std::erase_if(kind, [](unsigned char c) { return std::isdigit(c) != 0; });
      kinds.try_emplace(kind, at, at).first->second.second = at;
      if (extent == Extent::all) numbers.insert(at);
    }
    for (const auto& [kind, at] : kinds) numbers.insert({at.first, at.second});
    return {numbers.begin(), numbers.end()};
  }

  [[nodiscard]] std::int64_t calls() const { return static_cast<std::int64_t>(calls_.size()); }

  /// The first call that writes to a checkpoint: before it nothing can be resumed.
  [[nodiscard]] std::int64_t first_checkpoint_ends() const {
    const auto renamed = std::ranges::find_if(calls_, [](const Call& call) {
      return call.name == "rename" && call.path.ends_with("step-000000.hdf");
    });
    return renamed - calls_.begin();
  }

  /// Goes on in a folder where a run came to grief, and expects the uninterrupted run.
  void expect_whole_after(const std::filesystem::path& run, const std::string& what) {
    // Before the first checkpoint there is nothing to go on from, and it is said so.
    Outcome outcome = fpm_run_in(run, block, resumed(short_run));
    if (record::list_checkpoints(run / "checkpoints").empty()) {
      ASSERT_EQ(outcome.code, program::ExitCode::checkpoint_unusable) << what;
      ASSERT_THAT(outcome.err, HasSubstr("there is no checkpoint to resume from")) << what;
      outcome = fpm_run_in(run, block, short_run);
    }
    ASSERT_EQ(outcome.code, program::ExitCode::done) << what << ": " << outcome.err;
    ASSERT_THAT(differing_fields(last_checkpoint(whole()), last_checkpoint(run)), IsEmpty())
        << what;
    ASSERT_EQ(curve_without_wall(run), curve_) << what;
  }

  support::TemporaryFolder folder_;
  std::vector<Call> calls_;
  std::vector<std::string> curve_;
};

std::string text_of(std::int64_t number, const Call& call) {
  return "call " + std::to_string(number) + ", " + call.name + " of " + call.path;
}

// What does no harm if it fails: the words in a lock, an old checkpoint that stays, closing what
// was only read or is already forced to disk, and HDF5's question whether a file exists, which it
// asks by opening it twice.
bool may_fail_unseen(const Call& call, const Call& next) {
  const bool asked = call.name == "open" && next.name == "open" && call.path == next.path;
  return call.name == "unlink" || call.name == "close" || call.path.ends_with("run.lock") || asked;
}

void Faults::expect_loss_of_nothing_when_one_fails(Extent extent) {
  int stopped = 0;
  for (const std::int64_t at : chosen(extent)) {
    const Call& call = calls_[static_cast<std::size_t>(at)];
    const int number = call.name == "pwrite" ? ENOSPC : EIO;
    const auto run = folder_ / "run";
    const files::SystemCalls system = faulty_system([&](std::int64_t i, const Call&) {
      return i == at ? Fault{Fault::Kind::fails, number} : Fault{};
    });
    const Outcome outcome = fpm_run_in(run, block, short_run, system);
    const std::string what = text_of(at, call);
    if (outcome.code != program::ExitCode::done) {
      ++stopped;
      ASSERT_EQ(outcome.code, program::ExitCode::checkpoint_unusable) << what;
      ASSERT_THAT(outcome.err, HasSubstr(std::strerror(number))) << what;
      ASSERT_THAT(outcome.err, HasSubstr("fpm t\u00e9st")) << what;
      if (at > first_checkpoint_ends() + 2) {
        ASSERT_THAT(outcome.err, HasSubstr("the last good checkpoint is ")) << what;
      }
    } else {
      const auto next = static_cast<std::size_t>(std::min(at + 1, calls() - 1));
      ASSERT_TRUE(may_fail_unseen(call, calls_[next])) << what;
    }
    expect_whole_after(run, what);
    std::filesystem::remove_all(run);
  }
  EXPECT_GT(stopped, static_cast<int>(chosen(extent).size()) / 2);
}

TEST_F(Faults, OfACallEndTheRunWithAMessageAndLoseNothing) {
  expect_loss_of_nothing_when_one_fails(Extent::kinds);
}

TEST_F(Faults, OfEveryWriteEndTheRunWithAMessageAndLoseNothing) {
  expect_loss_of_nothing_when_one_fails(Extent::all);
}

TEST_F(Faults, ThatLastAsAFullDiskDoesLoseNothing) {
  for (std::int64_t from = 0; from < calls(); from += 43) {
    const auto run = folder_ / "run";
    const files::SystemCalls system = faulty_system([&](std::int64_t i, const Call& call) {
      const bool full = i >= from && call.name == "pwrite";
      return full ? Fault{Fault::Kind::fails, ENOSPC} : Fault{};
    });
    const Outcome outcome = fpm_run_in(run, block, short_run, system);
    const std::string what = "full from call " + std::to_string(from);
    ASSERT_THAT(outcome.code,
                AnyOf(program::ExitCode::checkpoint_unusable, program::ExitCode::done))
        << what;
    expect_whole_after(run, what);
    std::filesystem::remove_all(run);
  }
}

TEST_F(Faults, ThatAreShortWritesAreMadeUpFor) {
  const auto run = folder_ / "run";
  const files::SystemCalls system = faulty_system([](std::int64_t, const Call&) {
    return Fault{Fault::Kind::falls_short, 0};
  });
  ASSERT_EQ(fpm_run_in(run, block, short_run, system).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole()), last_checkpoint(run)), IsEmpty());
  EXPECT_EQ(curve_without_wall(run), curve_);
}

TEST_F(Faults, ThatAreAClockThatGoesBackwardsChangeNothing) {
  const auto run = folder_ / "run";
  files::SystemCalls system = files::system_calls();
  std::time_t now = 1700000000;
  system.time = [&now] { return now -= 100000; };
  ASSERT_EQ(
      fpm_run_in(run, block, {"--max-wall", "0.000000001s", "--set", "programme.steps=2"}, system)
          .code,
      program::ExitCode::interrupted);
  ASSERT_EQ(fpm_run_in(run, block, resumed(short_run), system).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole()), last_checkpoint(run)), IsEmpty());
  EXPECT_EQ(curve_without_wall(run), curve_);
}

/// Runs a scene in a child process that is killed when it is about to make a call.
/// @return whether it came to that call
bool killed_at(const std::filesystem::path& run, std::int64_t at,
               const std::vector<std::string>& arguments) {
  const pid_t child = ::fork();
  if (child == 0) {
    const files::SystemCalls system = faulty_system([at](std::int64_t i, const Call&) {
      if (i == at) ::kill(::getpid(), SIGKILL);
      return Fault{};
    });
    (void)fpm_run_in(run, block, arguments, system);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
}

void Faults::expect_loss_of_nothing_when_killed(Extent extent) {
  for (const std::int64_t at : chosen(extent)) {
    const auto run = folder_ / "run";
    const std::string what = "killed before " + text_of(at, calls_[static_cast<std::size_t>(at)]);
    ASSERT_TRUE(killed_at(run, at, short_run)) << what;
    expect_whole_after(run, what);
    std::filesystem::remove_all(run);
  }
}

TEST_F(Faults, ThatAreAKillBeforeACallLoseNothing) {
  expect_loss_of_nothing_when_killed(Extent::kinds);
}

TEST_F(Faults, ThatAreAKillBeforeEveryWriteLoseNothing) {
  expect_loss_of_nothing_when_killed(Extent::all);
}

// Each run gets somewhat further than the last, and all are killed.
TEST_F(Faults, ThatAreKillsOneAfterTheOtherLoseNothing) {
  const auto run = folder_ / "run";
  ASSERT_TRUE(killed_at(run, first_checkpoint_ends() + 20, short_run));
  int kills = 1;
  for (std::int64_t at = 3; killed_at(run, at, resumed(short_run)); at += 37) ++kills;
  EXPECT_GT(kills, 3);
  expect_whole_after(run, "killed " + std::to_string(kills) + " times");
}

// The order that makes it safe: a checkpoint is whole and on the disk under its name before an
// older one goes.
TEST_F(Faults, CannotMeetAMomentWithoutACheckpoint) {
  const auto position = [&](const std::string& name, const std::string& ending) {
    const auto found = std::ranges::find_if(
        calls_, [&](const Call& call) { return call.name == name && call.path.ends_with(ending); });
    EXPECT_NE(found, calls_.end()) << name << " " << ending;
    return found - calls_.begin();
  };
  const std::string temporary = "step-000001.hdf.tmp-" + std::to_string(::getpid());
  const auto synced = position("fsync", temporary);
  const auto renamed = position("rename", "step-000001.hdf");
  const auto removed = position("unlink", "step-000000.hdf");
  EXPECT_LT(position("pwrite", temporary), synced);
  EXPECT_LT(synced, renamed);
  EXPECT_LT(renamed, removed);
  bool folder_synced = false;
  for (auto i = renamed; i < removed; ++i) {
    const Call& call = calls_[static_cast<std::size_t>(i)];
    folder_synced |= call.name == "fsync" && call.path.ends_with("/checkpoints");
  }
  EXPECT_TRUE(folder_synced);
  // Rows that a checkpoint counts on are on the disk before it is.
  EXPECT_LT(position("fsync", "curve.csv"), renamed);
}

TEST(FileSizeLimit, IsAnErrorOfTheWriteAndNotTheEnd) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", run = folder / "run";
  ASSERT_EQ(fpm_run_in(whole, block).code, program::ExitCode::done);
  // The curve fits, and no checkpoint does.
  rlimit former{};
  ::getrlimit(RLIMIT_FSIZE, &former);
  const rlimit tight{20000, former.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &tight);
  const Outcome outcome = fpm_run_in(run, block);
  ::setrlimit(RLIMIT_FSIZE, &former);
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("step-000000.hdf.tmp-"));
  EXPECT_THAT(outcome.err, HasSubstr(std::strerror(EFBIG)));
  ASSERT_EQ(fpm_run_in(run, block).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(run)), IsEmpty());
}

// As a disk that fills up in the middle: the newest checkpoint stays and is named.
TEST(FileSizeLimit, ThatComesLaterLeavesTheLastCheckpoint) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  const files::SystemCalls system = faulty_system([](std::int64_t, const Call& call) {
    const bool full = call.path.find("step-000004.hdf") != std::string::npos;
    return full && call.name == "pwrite" ? Fault{Fault::Kind::fails, EFBIG} : Fault{};
  });
  const Outcome outcome = fpm_run_in(run, block, {}, system);
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("cannot be written: File too large"));
  EXPECT_THAT(outcome.err,
              HasSubstr("the last good checkpoint is " + checkpoint_of(run, 3).string()));
}

TEST(Folder, ThatIsAFileOrBelowOneIsRefused) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  for (const auto& run : {folder / "file", folder.path() / "file" / "run"}) {
    try {
      const record::RunFolder made(run);
      FAIL() << "made " << run;
    } catch (const files::FileError& failure) {
      EXPECT_THAT(failure.what(), HasSubstr((folder / "file").string() + ": cannot be created: "));
    }
  }
}

// Root may write where others may not, so that the refusal comes from the calls.
TEST(Folder, ThatIsReadOnlyIsRefused) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "run");
  const files::SystemCalls system = faulty_system([](std::int64_t, const Call& call) {
    return call.name == "open" ? Fault{Fault::Kind::fails, EROFS} : Fault{};
  });
  const Outcome outcome = fpm_run_in(folder / "run", block, {}, system);
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("run.lock: cannot be opened: Read-only file system"));
}

TEST(Folder, ThatTurnsReadOnlyLeavesTheLastCheckpoint) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", run = folder / "run";
  ASSERT_EQ(fpm_run_in(whole, block).code, program::ExitCode::done);
  bool read_only = false;
  const files::SystemCalls system = faulty_system([&](std::int64_t, const Call& call) {
    read_only |= call.path.find("step-000004.hdf") != std::string::npos;
    return read_only && call.name != "close" ? Fault{Fault::Kind::fails, EROFS} : Fault{};
  });
  const Outcome outcome = fpm_run_in(run, block, {}, system);
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("Read-only file system"));
  EXPECT_THAT(outcome.err,
              HasSubstr("the last good checkpoint is " + checkpoint_of(run, 3).string()));
  ASSERT_EQ(fpm_run_in(run, block, {"--resume"}).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(run)), IsEmpty());
  EXPECT_EQ(curve_without_wall(run), curve_without_wall(whole));
}

TEST(Folder, ThatVanishesIsSaidToBeGone) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  const files::SystemCalls system = faulty_system([&](std::int64_t, const Call& call) {
    const bool now = call.path.find("step-000004.hdf") != std::string::npos;
    if (now) std::filesystem::remove_all(run / "checkpoints");
    return Fault{};
  });
  const Outcome outcome = fpm_run_in(run, block, {}, system);
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("No such file or directory"));
  EXPECT_THAT(outcome.err,
              HasSubstr("gone is the last checkpoint, " + checkpoint_of(run, 3).string()));
  EXPECT_EQ(record::read_curve(run / "curve.csv").size(), 5U);  // with the start
}

}  // namespace
}  // namespace restart

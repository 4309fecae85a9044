#include "program/child_process.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "files/file_error.hpp"
#include "support/temporary_folder.hpp"

namespace program {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

const std::filesystem::path shell = "/bin/sh";

/// Waits for the end, which every test's child comes to by itself.
int end_of(ChildProcess& child) {
  while (true) {
    if (const auto code = child.exit_code()) return *code;
    std::this_thread::sleep_for(2ms);
  }
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// The first line of a file that a child writes, once it is there; the child then waits to be
/// ended.
std::string awaited_line(const std::filesystem::path& file) {
  while (text_of(file).find('\n') == std::string::npos) std::this_thread::sleep_for(2ms);
  std::string line;
  std::ifstream stream(file);
  std::getline(stream, line);
  return line;
}

class AChildProcess : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path output() const { return folder_ / "output"; }
  support::TemporaryFolder folder_;
};

/// Standard input of this process, of which a child could take a line, for as long as it lives.
class Typed {
 public:
  explicit Typed(const std::string& line) {
    int ends[2] = {-1, -1};
    if (::pipe(ends) != 0 || ::write(ends[1], line.data(), line.size()) < 0) {
      throw std::runtime_error("no pipe");
    }
    ::close(ends[1]);
    ::dup2(ends[0], STDIN_FILENO);
    ::close(ends[0]);
  }
  Typed(const Typed&) = delete;
  Typed& operator=(const Typed&) = delete;
  ~Typed() {
    ::dup2(before_, STDIN_FILENO);
    ::close(before_);
  }

 private:
  int before_ = ::dup(STDIN_FILENO);
};

TEST_F(AChildProcess, LeavesWhatIsTypedToThisOne) {
  const Typed typed("ours\n");
  ChildProcess child("/bin/cat", {}, output());
  EXPECT_EQ(end_of(child), 0);
  EXPECT_EQ(text_of(output()), "");
}

TEST_F(AChildProcess, HasTheExitCodeOfItsProgram) {
  ChildProcess child(shell, {"-c", "exit 7"}, output());
  EXPECT_EQ(end_of(child), 7);
  EXPECT_EQ(child.exit_code(), 7) << "asked again";
}

TEST_F(AChildProcess, HasTheExitCodeOfAShellIfItWasKilled) {
  ChildProcess child(shell, {"-c", "kill -9 $$"}, output());
  EXPECT_EQ(end_of(child), 128 + SIGKILL);
}

// A shell that counts to a million needs a tenth of a second at least; one that only ends, less.
// The ratio holds on any machine.
TEST_F(AChildProcess, TellsTheProcessorTimeAndMemoryThatItTook) {
  ChildProcess idle(shell, {"-c", ":"}, output());
  EXPECT_EQ(end_of(idle), 0);
  ChildProcess busy(shell, {"-c", "i=0; while [ $i -lt 200000 ]; do i=$((i+1)); done"}, output());
  EXPECT_EQ(busy.use().peak_bytes, 0) << "it has not ended";
  EXPECT_EQ(end_of(busy), 0);
  EXPECT_GT(busy.use().cpu, 10.0 * idle.use().cpu);
  // A shell is some hundred KiB at least; whoever takes KiB for bytes is below.
  EXPECT_GT(busy.use().peak_bytes, 100 * 1024);
}

// It goes on while the child runs, and then is what it took in all.
TEST_F(AChildProcess, TellsTheProcessorTimeSoFar) {
  ChildProcess child(shell, {"-c", "while :; do :; done"}, output());
  constexpr double some = 0.02;  // [s]
  while (child.cpu_so_far() < some) std::this_thread::sleep_for(2ms);
  EXPECT_EQ(child.exit_code(), std::nullopt);
  child.ask_to_stop();
  EXPECT_EQ(end_of(child), 128 + SIGTERM);
  EXPECT_DOUBLE_EQ(child.cpu_so_far(), child.use().cpu);
  EXPECT_GE(child.use().cpu, some / 2.0) << "the system counts in ticks";
}

TEST_F(AChildProcess, EndsInItsOwnWayWhenItIsAskedTo) {
  ChildProcess child(shell, {"-c", "trap 'exit 75' TERM; echo begun; while :; do sleep 0.01; done"},
                     output());
  ASSERT_EQ(awaited_line(output()), "begun");
  child.ask_to_stop();
  EXPECT_EQ(end_of(child), 75);
}

TEST_F(AChildProcess, HasNoExitCodeWhileItRuns) {
  ChildProcess child(shell,
                     {"-c", "echo begun; while [ ! -e \"$0\" ]; do sleep 0.01; done; exit 3",
                      (folder_ / "go").string()},
                     output());
  ASSERT_EQ(awaited_line(output()), "begun");
  EXPECT_EQ(child.exit_code(), std::nullopt);
  std::ofstream(folder_ / "go") << '\n';
  EXPECT_EQ(end_of(child), 3);
}

TEST_F(AChildProcess, GetsItsArgumentsAsTheyAreAndNothingToRead) {
  ChildProcess child(shell, {"-c", "printf '<%s>' \"$@\"; cat", "sh", "a b", "", "$HOME *"},
                     output());
  EXPECT_EQ(end_of(child), 0);
  EXPECT_EQ(text_of(output()), "<a b><><$HOME *>");
}

TEST_F(AChildProcess, WritesStandardOutputAndErrorOverWhatTheFileHeld) {
  std::ofstream(output()) << std::string(100, 'x');
  ChildProcess child(shell, {"-c", "echo one; echo two >&2; echo three"}, output());
  EXPECT_EQ(end_of(child), 0);
  EXPECT_EQ(text_of(output()), "one\ntwo\nthree\n");
}

// The lock of an output folder is an open file: in a child it would outlive the run.
TEST_F(AChildProcess, InheritsNoOpenFile) {
  const int file = ::open((folder_ / "lock").c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GT(file, STDERR_FILENO);
  ChildProcess child(
      shell, {"-c", "[ -e /proc/$$/fd/$0 ] && exit 1; [ -e /proc/$$/fd/2 ]", std::to_string(file)},
      output());
  EXPECT_EQ(end_of(child), 0);
  ::close(file);
}

TEST_F(AChildProcess, StandsBehindThisOneInPriority) {
  ChildProcess child(
      shell,
      {"-c", "echo $$; while [ ! -e \"$0\" ]; do sleep 0.01; done", (folder_ / "go").string()},
      output());
  const auto process = static_cast<id_t>(std::stoi(awaited_line(output())));
  // By what nice adds, and not to it: behind a program that is nice itself, too.
  constexpr int nice_adds = 10, last = 19;
  EXPECT_EQ(::getpriority(PRIO_PROCESS, process),
            std::min(::getpriority(PRIO_PROCESS, 0) + nice_adds, last));
  std::ofstream(folder_ / "go") << '\n';
  EXPECT_EQ(end_of(child), 0);
}

TEST_F(AChildProcess, IsEndedWithItsObject) {
  auto child = std::make_unique<ChildProcess>(
      shell, std::vector<std::string>{"-c", "echo $$; exec sleep 1000"}, output());
  const auto process = static_cast<pid_t>(std::stoi(awaited_line(output())));
  ASSERT_EQ(::kill(process, 0), 0);
  child.reset();
  EXPECT_EQ(::kill(process, 0), -1);
  EXPECT_EQ(errno, ESRCH) << "waited for, too: no zombie is left";
}

TEST_F(AChildProcess, ThatCannotBeStartedIsAnErrorThatNamesIt) {
  const auto absent = folder_ / "fpm-limit";
  try {
    const ChildProcess child(absent, {}, output());
    FAIL() << "started";
  } catch (const files::FileError& failure) {
    EXPECT_EQ(failure.file(), absent);
    EXPECT_THAT(failure.what(), HasSubstr("cannot be started: No such file or directory"));
  }
}

}  // namespace
}  // namespace program

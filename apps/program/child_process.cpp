#include "program/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "files/file_error.hpp"

namespace program {

namespace {

constexpr mode_t readable_by_all = 0666;  // less the user's umask
constexpr int politeness = 10;            // what `nice` adds
constexpr int killed_by = 128;            // a shell's exit code of a killed program, and the signal

int code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : killed_by + WTERMSIG(status);
}

/// Standard output and error of a program to be started.
class Redirection {
 public:
  explicit Redirection(const std::filesystem::path& output) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, output.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, readable_by_all);
    ::posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    // The lock of an output folder must not live on in the child.
    ::posix_spawn_file_actions_addclosefrom_np(&actions_, STDERR_FILENO + 1);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;
  ~Redirection() { ::posix_spawn_file_actions_destroy(&actions_); }

  [[nodiscard]] const posix_spawn_file_actions_t* actions() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& output) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const Redirection redirection(output);
  const int failure = ::posix_spawn(&process_, program.c_str(), redirection.actions(), nullptr,
                                    pointers.data(), environ);
  if (failure != 0) throw files::system_error(program, "cannot be started", failure);
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(process_), politeness);
}

ChildProcess::~ChildProcess() {
  if (exit_code()) return;
  ::kill(process_, SIGTERM);
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

std::optional<int> ChildProcess::exit_code() {
  if (code_) return code_;
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) == process_) code_ = code_of(status);
  return code_;
}

}  // namespace program

#include "program/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "files/durable_file.hpp"

namespace program {

namespace {

constexpr mode_t readable_by_all = 0666;  // less the user's umask
constexpr int politeness = 10;            // what `nice` adds
constexpr int last = 19;                  // nobody stands behind it
constexpr int killed_by = 128;            // a shell's exit code of a killed program, and the signal

int code_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : killed_by + WTERMSIG(status);
}

ResourceUse use_of(const struct rusage& use) {
  constexpr double micro = 1e-6;
  constexpr std::int64_t kibi = 1024;  // Linux counts the resident set in KiB
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + micro * static_cast<double>(time.tv_usec);
  };
  return {seconds(use.ru_utime) + seconds(use.ru_stime), kibi * use.ru_maxrss};
}

std::vector<std::string> words_of(const std::filesystem::path& program,
                                  const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

/// As the system takes a command line: the words, which must outlive it, and a null.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
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
  std::vector<std::string> words = words_of(program, arguments);
  const std::vector<char*> pointers = pointers_to(words);
  const Redirection redirection(output);
  const int failure = ::posix_spawn(&process_, program.c_str(), redirection.actions(), nullptr,
                                    pointers.data(), environ);
  if (failure != 0) throw files::system_error(program, "cannot be started", failure);
  const int own = ::getpriority(PRIO_PROCESS, 0);
  ::setpriority(PRIO_PROCESS, static_cast<id_t>(process_), std::min(own + politeness, last));
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
  struct rusage use {};
  if (::wait4(process_, &status, WNOHANG, &use) == process_) {
    code_ = code_of(status);
    use_ = use_of(use);
  }
  return code_;
}

double ChildProcess::cpu_so_far() const {
  constexpr double nano = 1e-9;
  if (code_) return use_.cpu;
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) {
    return 0.0;
  }
  return static_cast<double>(time.tv_sec) + nano * static_cast<double>(time.tv_nsec);
}

void ChildProcess::ask_to_stop() {
  if (!exit_code()) ::kill(process_, SIGTERM);
}

void become(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = words_of(program, arguments);
  const std::vector<char*> pointers = pointers_to(words);
  ::execv(program.c_str(), pointers.data());
  throw files::system_error(program, "cannot be started", errno);
}

std::filesystem::path folder_of_this_program() {
  std::error_code failure;
  return std::filesystem::read_symlink("/proc/self/exe", failure).parent_path();
}

std::string last_word(const std::filesystem::path& output) {
  std::string word = "it said nothing";
  std::error_code failure;
  if (!std::filesystem::exists(output, failure)) return word;
  const std::string text = files::read_text(output);
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line.starts_with("error: ") || line.starts_with("internal error: ")) return line;
    if (!line.empty()) word = line;
    at = end + 1;
  }
  return word;
}

}  // namespace program

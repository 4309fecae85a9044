#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace program {

/// What a program that has ended took.
struct ResourceUse {
  double cpu = 0.0;             // [s] of user and system, its own children's included
  std::int64_t peak_bytes = 0;  // most memory it had at a time
};

/// A program that runs beside this one, behind it in priority, and is ended with this object.
class ChildProcess {
 public:
  /// @param output  takes what it writes to standard output and error; replaced
  /// @throws FileError if it cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& output);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Its exit code, as a shell has it (128 and the signal if it was killed), once it has ended.
  [[nodiscard]] std::optional<int> exit_code();
  /// What it took, once `exit_code` has told its end; zeros before.
  [[nodiscard]] const ResourceUse& use() const { return use_; }
  /// Processor time it has taken so far [s]; 0 where the system does not say.
  [[nodiscard]] double cpu_so_far() const;
  /// Asks it to end, as the user's Ctrl-C does, without waiting for it.
  void ask_to_stop();

 private:
  pid_t process_ = -1;
  std::optional<int> code_;
  ResourceUse use_;
};

/// Runs another program in this one's place.
/// @throws FileError if it cannot be started.
[[noreturn]] void become(const std::filesystem::path& program,
                         const std::vector<std::string>& arguments);

/// The folder of the program that runs, where the others of this project are as well.
[[nodiscard]] std::filesystem::path folder_of_this_program();

/// What a program of this project said of its failure, from the file that took its output: its
/// first error, else its last line.
[[nodiscard]] std::string last_word(const std::filesystem::path& output);

}  // namespace program

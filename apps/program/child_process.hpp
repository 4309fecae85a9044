#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace program {

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

 private:
  pid_t process_ = -1;
  std::optional<int> code_;
};

}  // namespace program

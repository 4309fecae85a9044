#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace program {

/// The log of one run: everything to a file (appended, with times), warnings and errors to standard
/// error as well. No global state; several may live side by side.
class Log {
 public:
  /// @param file  created or appended to; every line is flushed
  /// @param echo  whether warnings and errors also go to standard error
  /// @throws FileError if the file cannot be opened.
  explicit Log(const std::filesystem::path& file, bool echo = true);
  Log(Log&&) noexcept;
  Log& operator=(Log&&) noexcept;
  ~Log();

  void info(std::string_view line);
  void warning(std::string_view line);
  void error(std::string_view line);

 private:
  struct Sinks;
  std::unique_ptr<Sinks> sinks_;
};

}  // namespace program

#pragma once

#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace files {

/// A file could not be written, read or understood; the message names it and the reason.
class FileError : public std::runtime_error {
 public:
  FileError(const std::filesystem::path& file, const std::string& reason)
      : std::runtime_error(file.string() + ": " + reason), file_(file), reason_(reason) {}

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path file_;
  std::string reason_;
};

/// The error of a system call that failed with this errno.
[[nodiscard]] inline FileError system_error(const std::filesystem::path& file,
                                            const std::string& what, int number) {
  return {file, what + ": " + std::strerror(number)};
}

}  // namespace files

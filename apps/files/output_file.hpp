#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include "files/file_error.hpp"
#include "files/system_calls.hpp"

namespace files {

/// Writes all the bytes at `at`, however few the system takes at a time.
/// @return 0, or the errno of the call that failed
[[nodiscard]] int write_all(const SystemCalls& system, int file, std::span<const std::byte> bytes,
                            off_t at);

/// A file that is open for writing, one piece after the other; closed with its object. Every
/// failure is a FileError that names the file and the system's reason.
class OutputFile {
 public:
  /// Makes the file, or empties an old one.
  [[nodiscard]] static OutputFile create(const std::filesystem::path& file,
                                         const SystemCalls& system = system_calls());
  /// Goes on at the end of an existing file.
  [[nodiscard]] static OutputFile append(const std::filesystem::path& file,
                                         const SystemCalls& system = system_calls());
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();

  void write(std::string_view text);
  /// Forces all that was written to disk.
  void sync();
  /// Some file systems report a failed write only here.
  void close();

 private:
  OutputFile(std::filesystem::path file, const SystemCalls& system, int flags, off_t at);

  std::filesystem::path file_;
  const SystemCalls* system_;
  int number_ = -1;
  off_t at_ = 0;
};

}  // namespace files

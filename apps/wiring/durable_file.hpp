#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wiring {

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

/// Forces a file's content, or a folder's entries, to the disk.
/// @throws FileError if it cannot.
void sync_to_disk(const std::filesystem::path& file_or_folder);

/// Writes a file so that its name holds either the old or the whole new content, whatever happens:
/// `fill` writes a temporary neighbour, which is forced to disk, renamed over `file`, and the
/// folder forced to disk. If anything fails the temporary file is removed and `file` is as it was.
/// @throws FileError, or whatever `fill` throws.
void write_durably(const std::filesystem::path& file,
                   const std::function<void(const std::filesystem::path& temporary)>& fill);

/// `write_durably` of a text.
void write_text_durably(const std::filesystem::path& file, std::string_view text);

/// The whole content of a text file.
/// @throws FileError if it cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Creates a folder and its parents.
/// @throws FileError if it cannot.
void create_folder(const std::filesystem::path& folder);

}  // namespace wiring

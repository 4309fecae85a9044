#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "files/file_error.hpp"
#include "files/system_calls.hpp"

namespace files {

/// Forces a file's content, or a folder's entries, to the disk.
/// @throws FileError if it cannot.
void sync_to_disk(const std::filesystem::path& file_or_folder,
                  const SystemCalls& system = system_calls());

/// Writes a file so that its name holds either the old or the whole new content, whatever happens:
/// `fill` writes a temporary neighbour, which is forced to disk, renamed over `file`, and the
/// folder forced to disk. If anything fails up to the renaming, the temporary file is removed and
/// `file` is as it was; if forcing the folder fails, either content may be found after a crash of
/// the machine.
/// @throws FileError, or whatever `fill` throws.
void write_durably(const std::filesystem::path& file,
                   const std::function<void(const std::filesystem::path& temporary)>& fill,
                   const SystemCalls& system = system_calls());

/// `write_durably` of a text.
void write_text_durably(const std::filesystem::path& file, std::string_view text,
                        const SystemCalls& system = system_calls());

/// Renames a file or folder within one file system; the folder it comes to is forced to disk.
/// @throws FileError if it cannot.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to,
                    const SystemCalls& system = system_calls());

/// The whole content of a text file.
/// @throws FileError if it cannot be read.
[[nodiscard]] std::string read_text(const std::filesystem::path& file);

/// Creates a folder and its parents, each forced to disk.
/// @throws FileError if it cannot.
void create_folder(const std::filesystem::path& folder, const SystemCalls& system = system_calls());

}  // namespace files

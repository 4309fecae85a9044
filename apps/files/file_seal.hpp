#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "files/file_error.hpp"
#include "files/system_calls.hpp"

namespace files {

/// The first bytes of a file, in front of its HDF5 content: what the file is, and size and sum of
/// all of it. A byte that changed, wherever it stands, is so found out before the HDF5
/// library interprets it, and a file of a newer program says its name to an older one. It is text:
/// `head -n 5` shows it. HDF5's tools, h5py and ParaView skip it.
struct FileSeal {
  std::int64_t schema = 0;
  std::string writer;       // one line: program and library versions
  std::uint64_t bytes = 0;  // that follow
  std::uint64_t sum = 0;    // hash_of the lines above it and the bytes that follow
  bool operator==(const FileSeal&) const = default;
};

/// Bytes of a seal in its file.
inline constexpr std::uint64_t seal_size = 512;

/// Puts a seal on a file whose first seal_size bytes were left for it.
/// @throws FileError
void write_seal(const std::filesystem::path& file, std::int64_t schema, const std::string& writer,
                const SystemCalls& system = system_calls());

/// Whether a file begins as a sealed one does.
[[nodiscard]] bool has_seal(const std::filesystem::path& file);

/// The seal of a file, or nothing if it begins otherwise.
/// @throws FileError if it begins as a seal but is none.
[[nodiscard]] std::optional<FileSeal> read_seal(const std::filesystem::path& file);

/// Reads the whole file and compares.
/// @throws FileError if file and seal are not those that were written.
void require_unbroken(const std::filesystem::path& file, const FileSeal& seal);

}  // namespace files

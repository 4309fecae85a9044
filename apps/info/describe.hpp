#pragma once

#include <filesystem>
#include <string>

/// What an HDF5 file (checkpoint or frame) holds: attributes, groups, datasets with type, shape and
/// unit, and the stored texts' first line.
/// @throws wiring::FileError if it is no whole HDF5 file.
[[nodiscard]] std::string describe_file(const std::filesystem::path& file);

/// What an output folder holds: the scene's title, steps done and the last curve row, frames,
/// checkpoints. A part that cannot be read is said to be so, and the rest is still shown.
/// @throws wiring::FileError if the folder cannot be read.
[[nodiscard]] std::string describe_folder(const std::filesystem::path& folder);

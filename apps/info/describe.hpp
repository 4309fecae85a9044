#pragma once

#include <filesystem>
#include <string>

namespace info {

/// What an HDF5 file holds: of a checkpoint what, when, why, by whom, whence and what may change;
/// of it and of a frame attributes, groups, datasets with type, shape and unit, and the stored
/// texts' first line.
/// @throws files::FileError if it is no whole HDF5 file, or no sound checkpoint.
[[nodiscard]] std::string describe_file(const std::filesystem::path& file);

/// The scene in force when a checkpoint was written, every key, as TOML.
/// @throws files::FileError if it is no sound checkpoint.
[[nodiscard]] std::string scene_in(const std::filesystem::path& checkpoint);

/// What an output folder holds: whether a run is at work, the last curve row, frames, checkpoints.
/// A part that cannot be read is said to be so, and the rest is still shown.
/// @throws files::FileError if the folder cannot be read.
[[nodiscard]] std::string describe_folder(const std::filesystem::path& folder);

}  // namespace info

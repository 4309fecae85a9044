#pragma once

#include <filesystem>
#include <functional>

#include "files/hdf5_file.hpp"

namespace files {

/// Copies one HDF5 file to another by reading and writing it.
using CopyHdf5 =
    std::function<void(const std::filesystem::path& from, const std::filesystem::path& to)>;

/// Copies every group, dataset and attribute of the types that our files have.
/// @throws FileError
void copy_contents(const std::filesystem::path& from, const std::filesystem::path& to);

/// Opens an HDF5 file that no seal protects (a frame, a checkpoint of the first schema). HDF5
/// trusts the structure of a file and can fall on a damaged one. A child process therefore copies
/// what it can read into memory; this one reads the copy alone.
/// @param copy  what the child does, for tests
/// @throws FileError with the child's reason, or saying that HDF5 fell.
[[nodiscard]] Hdf5File open_unsealed(const std::filesystem::path& file,
                                     const CopyHdf5& copy = copy_contents);

}  // namespace files

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/system_calls.hpp"

namespace record {

/// The checkpoints in a folder by their names, newest step first; none if there is no folder.
[[nodiscard]] std::vector<std::filesystem::path> list_checkpoints(
    const std::filesystem::path& folder);

/// The newest checkpoint of a folder that opens whole.
/// @param[out] objections  what is wrong with each newer one
/// @param before  only checkpoints of earlier steps than this
[[nodiscard]] std::optional<std::filesystem::path> newest_usable(
    const std::filesystem::path& folder, std::vector<std::string>& objections,
    std::optional<std::int64_t> before = {});

/// Which checkpoints stay.
struct Retention {
  int newest = 3;
  int every = 0;  // steps: the first one at or after each multiple of these stays for good; 0: none
  std::vector<std::int64_t> for_good = {};  // steps that stay whatever they are
};

/// Removes all checkpoints up to and including `step` but those that stay.
void remove_older(const std::filesystem::path& folder, std::int64_t step,
                  const Retention& retention,
                  const files::SystemCalls& system = files::system_calls());

/// Renames the checkpoints later than `step` to `*.hdf.set-aside`: they belong to a course of the
/// run that is given up, and must be neither taken for its newest nor lost.
/// @return their new names.
std::vector<std::filesystem::path> set_aside_later(
    const std::filesystem::path& folder, std::int64_t step,
    const files::SystemCalls& system = files::system_calls());

}  // namespace record

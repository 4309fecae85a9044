#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace record {

/// File name of the checkpoint of a step, `step-000120.hdf`.
[[nodiscard]] std::string checkpoint_name(std::int64_t step);

/// The step in a checkpoint's file name, or nothing if it is no such name.
[[nodiscard]] std::optional<std::int64_t> step_of(const std::filesystem::path& checkpoint);

}  // namespace record

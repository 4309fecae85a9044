#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace comparison {

/// One field of a file: a dataset, or a column of a curve.
struct Quantity {
  std::string unit;
  std::vector<std::size_t> shape;  // particles x components, or rows
  std::variant<std::vector<double>, std::vector<std::int64_t>> values;
};

/// What can be compared in a file or folder. Fields are loaded one by one: they may be large.
struct Source {
  std::string what;                // "checkpoint of step 6", for the user
  std::vector<std::string> names;  // sorted
  std::function<Quantity(const std::string& name)> load;
  std::vector<std::int64_t> steps;  // of the rows of curve/...
  std::vector<double> points;       // x y z of each particle as it now is; empty if unknown
};

/// Opens a checkpoint (all of /state, and the curve so far), a frame (positions and fields), a
/// curve file, or an output folder (its newest usable checkpoint, and the curve). Wall times are
/// left out.
/// @throws files::FileError if it is none of these, or damaged.
[[nodiscard]] Source open_source(const std::filesystem::path& path);

}  // namespace comparison

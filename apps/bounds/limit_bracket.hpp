#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bounds {

/// The bounds of a collapse load as fpm-limit's JSON file tells them.
struct LimitBracket {
  std::optional<double> lower;  // [Pa] absent: none could be certified
  std::optional<double> upper;
  double gap_wanted = 0.0;
  std::string status;  // reached, wider than asked, not certified
  // With Davis' reduced strength for non-associated flow: an estimate, no bounds.
  std::optional<double> davis_lower;
  std::optional<double> davis_upper;
};

/// @throws FileError if the file cannot be read or is no such file.
[[nodiscard]] LimitBracket read_limit_bracket(const std::filesystem::path& file);

/// The bracket in one line: "57896 .. 59043 Pa (certified, gap 1.96 %)".
[[nodiscard]] std::string bracket_line(const LimitBracket& bracket);

}  // namespace bounds

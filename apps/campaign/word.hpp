#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace campaign {

/// The number that follows a word in a text.
[[nodiscard]] std::optional<double> number_after(std::string_view text, std::string_view word);

/// The part of its programme that a run has done, by the last whole line of its curve; 0 if there
/// is none yet.
[[nodiscard]] double fraction_reached(const std::filesystem::path& curve);

}  // namespace campaign

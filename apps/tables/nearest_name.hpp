#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tables {

/// Edit distance of two names: insertions, deletions, substitutions and swaps of neighbouring
/// letters each count one; case is ignored (optimal string alignment). Cost |a| |b|.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate a misspelt name most likely means, or "" if none is within a third of its length
/// (at least 1, so that short names still match); the first of equally near ones.
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::vector<std::string_view>& candidates);

}  // namespace tables

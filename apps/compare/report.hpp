#pragma once

#include <string>
#include <vector>

#include "compare/difference.hpp"

namespace comparison {

/// A table of the largest difference per field, where it is, and whether it passes; then one line
/// that sums up.
[[nodiscard]] std::string comparison_report(const Source& a,
                                            const std::vector<Difference>& differences);

}  // namespace comparison

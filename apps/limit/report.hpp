#pragma once

#include <string>

#include "limit/solution.hpp"

namespace limit {

/// One line on an attempt, for those who watch.
[[nodiscard]] std::string attempt_line(const Case& problem, const Attempt& attempt);

/// The whole answer in plain text.
[[nodiscard]] std::string text_report(const Case& problem, const Answer& answer,
                                      const BracketOptions& options);

/// The same as a JSON object: lower_bound and upper_bound in `unit` (null if not certified),
/// certified, status ("reached", "wider than asked", "not certified") and the rest.
[[nodiscard]] std::string json_report(const Case& problem, const Answer& answer,
                                      const BracketOptions& options);

}  // namespace limit

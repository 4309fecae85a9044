#pragma once

#include <optional>
#include <string>

#include "bounds/plateau_check.hpp"
#include "limit/bracket/solution.hpp"

namespace limit {

/// The solution of a case, that of its Davis-reduced twin if the flow is not associated, and how a
/// run compares if one was named.
struct Answer {
  bracket::Solution found;
  std::optional<bracket::Solution> davis;
  std::optional<bounds::PlateauCheck> run;
};

/// One line on an attempt, for those who watch.
[[nodiscard]] std::string attempt_line(const problem::Case& problem,
                                       const bracket::Attempt& attempt);

/// The whole answer in plain text.
[[nodiscard]] std::string text_report(const problem::Case& problem, const Answer& answer,
                                      const bracket::BracketOptions& options);

/// The same as a JSON object: lower_bound and upper_bound in `unit` (null if not certified),
/// certified, status ("reached", "wider than asked", "not certified") and the rest.
[[nodiscard]] std::string json_report(const problem::Case& problem, const Answer& answer,
                                      const bracket::BracketOptions& options);

}  // namespace limit

#pragma once

#include <optional>

#include "limit/case.hpp"
#include "wiring/plateau_check.hpp"

namespace limit {

/// The fields that bracket a case, and its two bounds in the case's unit; absent ones could not be
/// certified.
struct Solution {
  Bracket bracket;
  std::optional<double> lower, upper;

  /// (upper - lower) / their mean; infinite unless both are there and the mean is positive.
  [[nodiscard]] double gap() const;
};

/// The solution of a case, that of its Davis-reduced twin if the flow is not associated, and how a
/// run compares if one was named.
struct Answer {
  Solution found;
  std::optional<Solution> davis;
  std::optional<wiring::PlateauCheck> run;
};

/// Brackets what the case seeks: the multiplier of its live loads or the factor of its strength.
[[nodiscard]] Solution solution_of(const Case& problem, const BracketOptions& options,
                                   const std::function<void(const Attempt&)>& watch);

}  // namespace limit

#pragma once

#include <optional>

#include "limit/bracket/block_factor.hpp"
#include "limit/bracket/bracket.hpp"

namespace limit::bracket {

/// The fields that bracket a case, and its two bounds in the case's unit; absent ones could not be
/// certified.
struct Solution {
  Bracket bracket;
  std::optional<double> lower, upper;
  std::optional<BlockFactor> block;  // if that is the upper bound

  /// (upper - lower) / their mean; infinite unless both are there and the mean is positive.
  [[nodiscard]] double gap() const;
};

}  // namespace limit::bracket

#pragma once

#include <string>

#include "limit/problem/problem.hpp"
#include "limit/problem/turning_block.hpp"

namespace limit::certificate {

/// What a turning block proves, found without any code of the search that proposed it.
struct BlockCertificate {
  double multiplier = 0.0;   // dissipation less the power of the dead loads, over that of the live
  double dissipation = 0.0;  // at unit power of the live loads
  std::string objection;     // what is not as it must be; empty: the multiplier is an upper bound

  [[nodiscard]] bool holds() const { return objection.empty(); }
};

/// Dissipation and work of the ground between a pole and a curve around it that turns about the
/// pole. All of it moves, whatever lies there; so there must be no ground on the lines of sight
/// from the pole to the ends of the curve, nothing held between pole and curve, and along the curve
/// the dilation of whatever soil it runs through.
[[nodiscard]] BlockCertificate certify_block(const problem::Problem& problem,
                                             const problem::TurningBlock& block);

}  // namespace limit::certificate

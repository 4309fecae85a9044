#pragma once

#include <optional>

#include "limit/bracket/means.hpp"
#include "limit/certificate/block_certificate.hpp"
#include "limit/problem/problem.hpp"

namespace limit::bracket {

/// A block that turns under less than the loads as they are, with the strength divided by a factor.
struct BlockFactor {
  double factor = 0.0;
  problem::TurningBlock block;
  certificate::BlockCertificate certificate;
};

/// The least such factor that a search finds whose block is certified; none if there is none.
/// @param one    multiplier of the loads as they are, in its unit
/// @param first  a factor to begin with
/// @param most_seconds  of processor time
[[nodiscard]] std::optional<BlockFactor> block_factor(const problem::Problem& problem, double one,
                                                      double first, double most_seconds,
                                                      const Means& means);

}  // namespace limit::bracket

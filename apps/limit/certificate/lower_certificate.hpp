#pragma once

#include <optional>

#include "limit/problem/fields.hpp"
#include "limit/problem/problem.hpp"

namespace limit::certificate {

/// What a stress field proves, found without any code of the optimiser that proposed it.
struct LowerCertificate {
  double multiplier = 0.0;    // of the field below; a lower bound if `holds`
  double proposed = 0.0;      // what the optimiser claimed
  double residual = 0.0;      // largest imbalance left: force of a triangle over its outline's
                              // length, jump of the traction at a side's end
  double yield_excess = 0.0;  // largest radius of Mohr's circle beyond yield, or tension where the
                              // footing may lift off, before the field was drawn inwards; <= 0: it
                              // lay inside
  double kept = 1.0;          // share of the field that was kept; the rest is the resting ground's
  bool holds = false;         // the field is in equilibrium to rounding and nowhere beyond yield
  problem::StressField field;
};

/// The stress field nearest to the proposed one that is in equilibrium with all loads (by least
/// squares, to rounding), drawn towards a resting state of the ground, if it has one, until no
/// corner is beyond yield. As the stress is linear between the corners and the yield condition
/// convex, the corners decide; as the load is linear in the field, so is the bound in the share
/// that is kept.
[[nodiscard]] LowerCertificate certify_lower(const problem::Problem& problem,
                                             const problem::StressField& proposed,
                                             double multiplier);

}  // namespace limit::certificate

#pragma once

#include "limit/problem/fields.hpp"
#include "limit/problem/problem.hpp"

namespace limit::certificate {

/// What a velocity field proves, found without any code of the optimiser that proposed it.
struct UpperCertificate {
  double multiplier = 0.0;   // dissipation less the power of the dead loads, over that of the live
  double dissipation = 0.0;  // of the velocity field below, at unit power of the live loads
  double violation = 0.0;    // of the flow rule, as proposed: largest lack of dilation over shear
                             // (frictional soil), largest dilation (frictionless), <= 0: none
  double kept = 1.0;         // share of the field that was kept; the rest is a dilating one
  double residual = 0.0;     // dilation that is left in frictionless soil, to rounding
  bool holds = false;        // the flow rule is kept everywhere: the multiplier is an upper bound
  problem::VelocityField field;
  std::vector<double> of_triangle;  // dissipation in each triangle and half its sides' jumps
};

/// Dissipation and work of a velocity field. In soil without friction the field is first made free
/// of dilation (least squares, to rounding); where it violates the flow rule of frictional soil, or
/// a footing that may lift off sinks into the soil, as much of `dilating` is mixed in, a field that
/// keeps them with room to spare.
[[nodiscard]] UpperCertificate certify_upper(const problem::Problem& problem,
                                             const problem::VelocityField& proposed,
                                             const problem::VelocityField& dilating);

}  // namespace limit::certificate

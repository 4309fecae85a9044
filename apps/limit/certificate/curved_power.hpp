#pragma once

#include "limit/problem/envelope.hpp"

namespace limit::certificate {

/// The largest power of a stress within a curved envelope: its support function, convex and
/// homogeneous of degree one in the strain rate, in closed form.
/// @param dilation  of the rate, sum of the principal ones in the plane, > 0 unless shear is 0
/// @param shear     their difference; of a jump, as of a thin layer, its size
[[nodiscard]] double curved_power(const problem::Envelope& envelope, double dilation, double shear);

/// Of a traction within it that does not pull, on a jump that opens and slips.
/// @param without_pressure  strength under no normal stress
[[nodiscard]] double curved_contact_power(const problem::Envelope& envelope,
                                          double without_pressure, double opening, double slip);

}  // namespace limit::certificate

#pragma once

#include "limit/mesh/fan.hpp"
#include "limit/problem/problem.hpp"

namespace limit::problem {

/// A rigid strip footing on level, homogeneous ground; one half of it is modelled, the other is its
/// mirror image.
struct Strip {
  Soil soil;
  double half_width = 1.0;  // [m] > 0
  double surcharge = 0.0;   // [Pa] >= 0, on the surface beside the footing
  bool rough = true;        // the soil's full strength along the base; else no shear stress
  bool tension = true;  // the soil's strength across the base, too; else the footing may lift off
};

/// Extent of the modelled half of the ground, in half widths, from the axis and from the surface.
/// Beyond it, the ground is rigid.
struct Box {
  double width = 0.0;
  double depth = 0.0;
};

/// Throws std::invalid_argument, naming what is out of range, unless a collapse load exists and can
/// be bracketed: without cohesion and surcharge no stress at the surface is strictly admissible.
void check(const Strip& strip);

/// The box that holds the mechanism of a weightless soil (Prandtl's) with some room; weight and a
/// smooth base only make the mechanism smaller.
[[nodiscard]] Box box_of(const Strip& strip);

/// Collapse problem of the strip; its multiplier is the mean pressure on the footing.
[[nodiscard]] Problem strip_problem(const Strip& strip, const mesh::Fan& fan);

/// The fans with which the two bounds begin. The lower bound wants more rays than the upper one,
/// and both the more, the faster the mean stress varies around the edge.
[[nodiscard]] mesh::Fan lower_fan(const Strip& strip, const Box& box);
[[nodiscard]] mesh::Fan upper_fan(const Strip& strip, const Box& box);

/// The units in which the strip's numbers are of order one: its half width, and the strength at the
/// depth of it, c cos(phi) + (q + gamma b) sin(phi).
[[nodiscard]] Units units_of(const Strip& strip);

}  // namespace limit::problem

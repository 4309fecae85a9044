#pragma once

#include <optional>
#include <string>

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

/// What of a strip cannot be bracketed.
struct Objection {
  std::string key;      // cohesion, friction_angle [deg], unit_weight, surcharge, half_width
  std::string found;    // what is there
  std::string allowed;  // what may be there instead

  /// On one line.
  [[nodiscard]] std::string text() const { return key + ": " + found + "; " + allowed; }
};

/// What stands against bracketing the strip, for whoever knows where its numbers were written:
/// something out of range, or no collapse load that can be bracketed, as without cohesion, weight
/// and surcharge, where the soil bears nothing.
[[nodiscard]] std::optional<Objection> objection_to(const Strip& strip);

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

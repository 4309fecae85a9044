#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "limit/problem/hand_formulas.hpp"
#include "limit/problem/problem.hpp"
#include "limit/problem/strip.hpp"

namespace limit::problem {

/// What the numbers of a case are called. Any consistent units do: nothing is converted.
struct UnitNames {
  std::string stress = "Pa", length = "m";

  /// A stress over a length; for pascals and metres newtons per cubic metre, the same.
  [[nodiscard]] std::string unit_weight() const;
};

/// A collapse problem with all that a report says about it.
struct Case {
  std::string title;
  std::string quantity = "mean pressure at collapse";  // what is bracketed
  UnitNames names;
  std::string unit = names.stress;  // of what is bracketed; "" for a number
  bool seeks_strength = false;  // the factor that divides the strength, with the live loads at 1
  std::vector<std::pair<std::string, std::string>> data;  // what, value with unit
  std::vector<std::string> assumptions;
  std::vector<std::string> notes;    // on the bounds, beside them
  std::vector<std::string> reasons;  // why there may be no bounds, said if there are none
  // Bounds that are known in closed form, in the case's unit.
  std::optional<double> known_lower, known_upper;
  std::vector<HandFormula> hand;
  Units units;
  Problem lower, upper;  // in SI units, on the meshes to begin with
  /// Meshes of longer triangles for the same ground, to be tried where its soils become steep.
  std::vector<mesh::Mesh> long_lower, long_upper;
  /// A mesh of few triangles for the same ground, on which a factor is looked for first; may be
  /// none.
  mesh::Mesh rough_upper;
};

/// A collapse problem and, if a soil in it dilates by less than its friction angle, its twin of
/// Davis-reduced strength, in the same units.
struct Cases {
  Case associated;
  std::optional<Case> davis;
};

/// A strip footing as a case; `box` absent: box_of(strip).
/// @throws std::invalid_argument if there is an objection to the strip.
[[nodiscard]] Case strip_case(const Strip& strip, std::optional<Box> box,
                              const UnitNames& names = {});

/// What is assumed of a footing's base, for a report.
[[nodiscard]] std::string base_assumption(bool rough, bool tension);

/// The soil whose associated collapse is taken for that of a soil that dilates by less than its
/// friction angle (Davis 1968): c and tan(phi) times cos(psi) cos(phi) / (1 - sin(psi) sin(phi)).
/// An estimate, no bound. Angles in radians.
[[nodiscard]] Soil davis_reduced(const Soil& soil, double dilation_angle);

}  // namespace limit::problem

#pragma once

#include <optional>

namespace scene {

/// What a curved envelope is told by, in place of cohesion and friction; which of it a model has,
/// and what each is, libconstitutive says.
struct CurvedStrength {
  std::optional<double> intact_strength;  // [Pa] of hoek_brown, as are the next three
  std::optional<double> m_i, gsi, disturbance;
  std::optional<double> power_coefficient, power_exponent;  // of power_law
  std::optional<double> power_tension, reference_stress;    // [Pa] likewise
  std::optional<double> dilation_ratio;                     // of either

  /// Calls visit(name, value, whether whoever has it needs it) for each.
  template <class Visitor>
  void for_each(Visitor&& visit) const {
    visit("intact_strength", intact_strength, true);
    visit("m_i", m_i, true);
    visit("gsi", gsi, true);
    visit("disturbance", disturbance, false);
    visit("power_coefficient", power_coefficient, true);
    visit("power_exponent", power_exponent, true);
    visit("power_tension", power_tension, true);
    visit("reference_stress", reference_stress, true);
    visit("dilation_ratio", dilation_ratio, true);
  }
  bool operator==(const CurvedStrength&) const = default;
};

}  // namespace scene

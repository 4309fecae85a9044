#pragma once

#include <cstdint>

#include "constitutive/tensor.hpp"

namespace constitutive {

/// What lives at one material point between load steps; s0 is begin, s1 end of a step.
template <int Dim>
struct PointState {
  StressVector<Dim> stress = StressVector<Dim>::Zero();  ///< Cauchy stress [Pa], tension positive.
  double plastic_strain = 0;  ///< Accumulated sum of sqrt(2/3 de_p : de_p), whole tensor [-].
  double plastic_volume_strain = 0;  ///< Accumulated sum of tr(de_p), dilation positive [-].

  /// Calls visitor(name, field) for every field, in a fixed order: the one list of what lives here.
  template <class Visitor>
  void for_each_field(Visitor&& visitor) {
    visit_fields(*this, visitor);
  }

  /// Read-only form of `for_each_field`.
  template <class Visitor>
  void for_each_field(Visitor&& visitor) const {
    visit_fields(*this, visitor);
  }

 private:
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visitor) {
    visitor("stress", self.stress);
    visitor("plastic_strain", self.plastic_strain);
    visitor("plastic_volume_strain", self.plastic_volume_strain);
  }
};

/// How a stress update ended.
enum class UpdateStatus : std::uint8_t {
  ok,      ///< Stress found, elastic or on a smooth part or an edge of the yield surface.
  apex,    ///< Stress returned to the tensile apex; the tangent vanishes there.
  failed,  ///< The trial stress was not finite (or its square overflows); s1 equals s0.
};

/// Outcome of one stress update; `plastic` is false when the trial stress was admissible.
struct [[nodiscard]] UpdateOutcome {
  UpdateStatus status = UpdateStatus::ok;
  bool plastic = false;
};

/// Round-off allowance of a yield function relative to the sum of the magnitudes of its terms.
///
/// A stress is elastic while f <= yield_round_off * (sum of |terms of f|). Evaluating f after a
/// return and a rotation takes about 30 roundings of at most eps = 2^-53 of that sum each, so that
/// 2^-47 = 64 eps keeps a point that lies on the surface from being called plastic by noise.
inline constexpr double yield_round_off = 0x1p-47;

}  // namespace constitutive

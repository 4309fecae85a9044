#pragma once

#include <concepts>
#include <cstdint>

#include "constitutive/tensor.hpp"

namespace constitutive {

/// What lives at one material point between load steps; s0 is begin, s1 end of a step.
template <int Dim, class Real = double>
struct PointState {
  /// Cauchy stress [Pa], tension positive.
  StressVector<Dim, Real> stress = StressVector<Dim, Real>::Zero();
  Real plastic_strain = 0;         ///< Accumulated sum of sqrt(2/3 de_p : de_p), whole tensor [-].
  Real plastic_volume_strain = 0;  ///< Accumulated sum of tr(de_p), dilation positive [-].

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

/// Outcome of a stress update.
template <class Real>
struct [[nodiscard]] BasicUpdateOutcome {
  Mask<Real> failed{};   ///< The trial stress was not finite (or its square overflows).
  Mask<Real> apex{};     ///< Returned to the tensile apex.
  Mask<Real> plastic{};  ///< The trial stress was not admissible.

  /// How the update of a single point ended.
  [[nodiscard]] UpdateStatus status() const requires std::same_as<Real, double> {
    if (failed) return UpdateStatus::failed;
    return apex ? UpdateStatus::apex : UpdateStatus::ok;
  }
};

/// Outcome of the stress update of one point.
using UpdateOutcome = BasicUpdateOutcome<double>;

/// Round-off allowance of a yield function relative to the sum of the magnitudes of its terms.
///
/// A stress is elastic while f <= yield_round_off * (sum of |terms of f|). Evaluating f after a
/// return and a rotation takes about 30 roundings of at most eps = 2^-53 of that sum each, so that
/// 2^-47 = 64 eps keeps a point that lies on the surface from being called plastic by noise.
inline constexpr double yield_round_off = 0x1p-47;

}  // namespace constitutive

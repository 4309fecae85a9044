#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "constitutive/elastic.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// Yield cone sqrt(J2) + 3 alpha p - strength = 0 with potential sqrt(J2) + 3 beta p.
///
/// p = tr(sigma) / 3, tension positive; 0 <= beta <= alpha. alpha = 0 is a cylinder (no apex).
template <class Real>
struct BasicCone {
  // All may differ from point to point (dilation cut-off).
  Real alpha = 0;     ///< Friction slope [-].
  Real beta = 0;      ///< Dilation slope [-].
  Real strength = 0;  ///< sqrt(J2) at p = 0 [Pa]; > 0 unless alpha > 0.

  /// Largest sqrt(J2) admitted at mean stress p; <= 0 at and beyond the apex [Pa].
  [[nodiscard]] Real radius(const Real& p) const { return strength - 3 * alpha * p; }

  /// Mean stress of the apex, strength / (3 alpha); infinite for a cylinder [Pa].
  [[nodiscard]] Real apex_pressure() const { return strength / (3 * alpha); }

  /// Whether (sqrt_j2, p) lies outside by more than round-off (`yield_round_off`).
  [[nodiscard]] Mask<Real> is_exceeded(const Real& sqrt_j2, const Real& p) const {
    using std::abs;
    const Real magnitude = sqrt_j2 + 3 * alpha * abs(p) + strength;
    return sqrt_j2 - radius(p) > yield_round_off * magnitude;
  }
};

/// The cone of one point.
using Cone = BasicCone<double>;

/// Cone equal to Mohr-Coulomb at collapse in plane strain, non-associated.
///
/// beta = sin psi / sqrt(9 + 3 sin^2 psi), q0 = sqrt(1 - 3 beta^2),
/// alpha = sin phi / (3 (q0 + beta sin phi)), strength = c cos phi (1 - 3 alpha beta) / q0.
/// Holds in plane strain only: the out-of-plane stress follows from the flow rule.
/// @param cohesion  [Pa]  @param friction_angle, dilation_angle  [rad], 0 <= psi <= phi < pi/2
Cone plane_strain_cone(double cohesion, double friction_angle, double dilation_angle);

/// Cone through the triaxial compression meridian of Mohr-Coulomb (circumscribed cone).
///
/// alpha = 2 sin phi / (sqrt3 (3 - sin phi)), strength = 6 c cos phi / (sqrt3 (3 - sin phi)), beta
/// as alpha with psi. Too strong on every other meridian.
/// @param cohesion  [Pa]  @param friction_angle, dilation_angle  [rad], 0 <= psi <= phi < pi/2
Cone compression_cone(double cohesion, double friction_angle, double dilation_angle);

namespace detail {

/// Mean stress of a block on its cone, and which of its sub-points flow.
template <std::size_t M, class Real>
struct ConeSweep {
  Real pressure = 0;
  std::array<Mask<Real>, M> yields{};
};

/// Root p of p - p_tr + (3 K beta / mu) sum_k w_k max(0, J_k + 3 alpha p - strength) = 0.
///
/// The left side is increasing and piecewise linear. Its kinks are met in the order of falling J_k,
/// so that a sweep which adds the largest inactive J_k while it is exceeded ends at the exact root
/// after at most M steps: no tolerance, no iteration. Equal J_k flow together.
template <std::size_t M, class Real>
ConeSweep<M, Real> sweep_cone(const BasicCone<Real>& cone, const ElasticModuli& m, const Real& p_tr,
                              const std::array<Real, M>& j, const std::array<double, M>& weights) {
  using std::max;
  const Real slope = 3 * m.bulk / m.shear * cone.beta;
  const Real trial_radius = cone.radius(p_tr);
  ConeSweep<M, Real> sweep{.pressure = p_tr};
  Real active_weight = 0, active_excess = 0;
  for (std::size_t step = 0; step < M; ++step) {
    Real largest = -1;
    for (std::size_t k = 0; k < M; ++k) largest = max(largest, select(sweep.yields[k], -1, j[k]));
    const Mask<Real> exceeded = cone.is_exceeded(largest, sweep.pressure);
    if (!any(exceeded)) break;
    for (std::size_t k = 0; k < M; ++k) {
      const Mask<Real> joins = exceeded & (j[k] == largest);
      active_weight += select(joins, weights[k], 0);
      active_excess += select(joins, weights[k] * (j[k] - trial_radius), 0);
      sweep.yields[k] = sweep.yields[k] | joins;
    }
    const Real slack = 1 + 3 * cone.alpha * slope * active_weight;
    sweep.pressure = p_tr - slope * active_excess / slack;
  }
  return sweep;
}

}  // namespace detail
}  // namespace constitutive

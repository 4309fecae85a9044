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
struct Cone {
  double alpha = 0;     ///< Friction slope [-].
  double beta = 0;      ///< Dilation slope [-].
  double strength = 0;  ///< sqrt(J2) at p = 0 [Pa]; > 0 unless alpha > 0.

  /// Largest sqrt(J2) admitted at mean stress p; <= 0 at and beyond the apex [Pa].
  [[nodiscard]] double radius(double p) const { return strength - 3 * alpha * p; }

  /// Mean stress of the apex, strength / (3 alpha); infinite for a cylinder [Pa].
  [[nodiscard]] double apex_pressure() const { return strength / (3 * alpha); }

  /// Whether (sqrt_j2, p) lies outside by more than round-off (`yield_round_off`).
  [[nodiscard]] bool is_exceeded(double sqrt_j2, double p) const {
    const double magnitude = sqrt_j2 + 3 * alpha * std::abs(p) + strength;
    return sqrt_j2 - radius(p) > yield_round_off * magnitude;
  }
};

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
template <std::size_t M>
struct ConeSweep {
  double pressure = 0;
  std::array<bool, M> yields{};
};

/// Root p of p - p_tr + (3 K beta / mu) sum_k w_k max(0, J_k + 3 alpha p - strength) = 0.
///
/// The left side is increasing and piecewise linear. Its kinks are met in the order of falling J_k,
/// so that a sweep which adds the largest inactive J_k while it is exceeded ends at the exact root
/// after at most M steps: no tolerance, no iteration.
template <std::size_t M>
ConeSweep<M> sweep_cone(const Cone& cone, const ElasticModuli& m, double p_tr,
                        const std::array<double, M>& j, const std::array<double, M>& weights) {
  std::array<std::size_t, M> order;
  for (std::size_t k = 0; k < M; ++k) {
    std::size_t at = k;
    for (; at > 0 && j[order[at - 1]] < j[k]; --at) order[at] = order[at - 1];
    order[at] = k;
  }
  const double slope = 3 * m.bulk * cone.beta / m.shear;
  ConeSweep<M> sweep{.pressure = p_tr};
  double active_weight = 0, active_excess = 0;
  for (const std::size_t k : order) {
    if (!cone.is_exceeded(j[k], sweep.pressure)) break;
    sweep.yields[k] = true;
    active_weight += weights[k];
    active_excess += weights[k] * (j[k] - cone.radius(p_tr));
    const double slack = 1 + 3 * cone.alpha * slope * active_weight;
    sweep.pressure = p_tr - slope * active_excess / slack;
  }
  return sweep;
}

}  // namespace detail
}  // namespace constitutive

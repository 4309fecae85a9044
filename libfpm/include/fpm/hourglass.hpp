#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "fpm/types.hpp"

namespace fpm {

/// Control of zero-energy modes by stiffness on the non-affine part of a row's neighbourhood,
///   y_ab = e_ab - R_a e_ab(n),   e_ab = (x_b - x_a) - F_a X_ab,
/// with spring constants k_a kappa_ab. R = 0 is the total form, right for elastic bodies; R = Q,
/// the rotation of the step, the incremental form, which forgets the non-affine deformation at
/// the end of each step and so does not lock when the material flows.
/// Departure: replaces Chen, Huang & Lyamin 2020, Eq. 15-20 (share/doc/decisions/pair-control.md).
///
/// With du the step's increment and D = I - R this is
///   y_ab = (du_b - du_a) - dF X_ab + D e_ab(n),
/// so everything a row needs are its moments of du and those of e(n), which are constant in a step.

/// What a row's pair control knows before the step.
template <int Dim, class Real = double>
struct PairRow {
  Vector<Dim, Real> first_moment;   ///< [1/m] sum kappa X
  Tensor<Dim, Real> second_moment;  ///< [-] sum kappa X x X
  Vector<Dim, Real> memory_first;   ///< [1/m] sum kappa e(n)
  Tensor<Dim, Real> memory_second;  ///< [-] sum kappa e(n) x X
  Vector<Dim, Real> position;       ///< [m] x_a(n)
  Tensor<Dim, Real> gradient;       ///< [-] F_a(n)
};

/// Response of one row: what `MomentOperator::scatter` wants, and what acts on the row itself.
template <int Dim, class Real = double>
struct PairResponse {
  Real stiffness;                 ///< k: acts on the field at the neighbour
  Vector<Dim, Real> constant;     ///< c
  Tensor<Dim, Real> on_position;  ///< A, acts on x_b(n)
  Tensor<Dim, Real> affine;       ///< B, acts on kappa X
  Vector<Dim, Real> own_force;    ///< force on the row itself, -k sum kappa y
  Tensor<Dim, Real> stress;       ///< addition to the row's nominal stress, -k sum kappa y x X
};

/// Pair forces of one row; linear in (field, gradient_increment, defect), so the same function
/// gives the response to du (defect = I - R) and its derivative along v (defect = -dR).
/// @param stiffness  k_a = gamma Eh_a Vref_a
/// @param field  value of du (or v) at the row
/// @param first,second  moments sum kappa (du_b - du_a) and sum (du_b - du_a) x kappa X
/// @param gradient_increment  dF_a = sum (du_b - du_a) x G_ab
template <int Dim, class Real>
PairResponse<Dim, Real> pair_response(
    const Real& stiffness, const PairRow<Dim, Real>& row,
    const std::type_identity_t<Vector<Dim, Real>>& field,
    const std::type_identity_t<Vector<Dim, Real>>& first,
    const std::type_identity_t<Tensor<Dim, Real>>& second,
    const std::type_identity_t<Tensor<Dim, Real>>& gradient_increment,
    const std::type_identity_t<Tensor<Dim, Real>>& defect) {
  PairResponse<Dim, Real> response;
  response.stiffness = stiffness;
  response.on_position = stiffness * defect;
  response.constant = -stiffness * field - response.on_position * row.position;
  response.affine = stiffness * gradient_increment + response.on_position * row.gradient;
  response.own_force =
      -stiffness * (first - gradient_increment * row.first_moment + defect * row.memory_first);
  response.stress =
      -stiffness * (second - gradient_increment * row.second_moment + defect * row.memory_second);
  return response;
}

/// Parameters of the stiffness controls.
struct PairControlOptions {
  double stiffness_ratio = 0.1;  ///< gamma [-] >= 0; 0.01-0.3 are all good in elasticity; 0.01 with
                                 ///< sub-points
  double modulus_factor = 1.0;   ///< chi [-] > 0, scales the secant modulus of yielding rows
};

/// Modulus of the incremental control during a step: E for a row that did not yield in the last
/// converged step, otherwise the secant modulus of its flow, chi sqrt(3 J2) / d(eps_p), between
/// 1e-5 chi E and E. Frozen during a step.
inline double pair_modulus(double youngs_modulus, double modulus_factor, double sqrt_j2,
                           double plastic_increment) {
  constexpr double floor_ratio = 1e-5;
  if (plastic_increment <= 0.0) return youngs_modulus;
  const double secant = modulus_factor * std::sqrt(3.0) * sqrt_j2 / plastic_increment;
  return std::clamp(secant, std::min(1.0, floor_ratio * modulus_factor) * youngs_modulus,
                    youngs_modulus);
}

}  // namespace fpm

#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "constitutive/drucker_prager.hpp"
#include "constitutive/tensor.hpp"

/// A block of M deviatoric sub-points that share one mean stress.
///
/// One volumetric and M deviatoric strains per block: as many dilation constraints as blocks, which
/// keeps collapse loads free of locking. M = 1 is the ordinary return mapping, exactly.
namespace constitutive {

/// Elastic trial of a block: s_k,tr = Q s_k,n Q^T + 2 mu de_k, p_tr = p_n + K dvol.
template <std::size_t M, int Dim = 2>
struct MixedTrial {
  double pressure = 0;                        ///< Trial mean stress, tension positive [Pa].
  std::array<StressVector<Dim>, M> deviator;  ///< Trial deviators (traceless, stress-like) [Pa].
};

/// Stress of a block after the return; `status` failed leaves everything but `status` unspecified.
template <std::size_t M, int Dim = 2>
struct [[nodiscard]] MixedResult {
  UpdateStatus status = UpdateStatus::ok;
  bool plastic = false;                       ///< At least one sub-point yields.
  double pressure = 0;                        ///< Mean stress of the block [Pa].
  std::array<StressVector<Dim>, M> deviator;  ///< s_k = factor_k s_k,tr [Pa].
  std::array<double, M> factor;  ///< Y / J_k of a yielding sub-point, 1 of an elastic one, 0 apex.
  std::array<bool, M> yields;    ///< Whether sub-point k flows (all do at the apex).
  double plastic_strain_increment = 0;  ///< Weighted mean of sqrt(2/3 de_p : de_p) [-].
  double plastic_volume_increment = 0;  ///< (p_tr - p) / K [-].
};

/// Consistent tangent of `mixed_return`, kept as its few numbers and applied to directions.
///
/// With n_k = s_k,tr / J_k (not unit), q_k = factor_k, j_k = n_k : ds_k,tr / 2 and A the yielding
/// sub-points:
///   dp (1 + 9 K alpha beta w_A / mu) = dp_tr - (3 K beta / mu) sum_A w_k j_k
///   yielding: ds_k = q_k ds_k,tr - n_k (q_k j_k + 3 alpha dp);   elastic: ds_k = ds_k,tr
/// and zero at the apex.
template <std::size_t M, int Dim = 2>
struct MixedTangent {
  ElasticModuli moduli;
  bool apex = false;
  double three_alpha = 0;                   ///< 3 alpha.
  double pressure_scale = 1;                ///< 1 / (1 + 9 K alpha beta w_A / mu).
  std::array<double, M> pressure_weight;    ///< 3 K beta w_k / mu if yielding, else 0.
  std::array<double, M> factor;             ///< q_k, 1 of an elastic sub-point.
  std::array<StressVector<Dim>, M> normal;  ///< n_k if yielding, else 0.

  /// (dp, ds_k) of a direction of the *trial stress*; exact also for finite strain, where the trial
  /// changes with the rotation. In-place use (same object for both) is allowed.
  void apply_to_trial(const MixedTrial<M, Dim>& direction, MixedTrial<M, Dim>& result) const;

  /// (dp, ds_k) of small-strain directions: volume strain and M deviatoric strain vectors
  /// (engineering shear, traceless).
  void apply_to_strain(double volume_strain,
                       const std::array<StrainVector<Dim>, M>& deviatoric_strain,
                       MixedTrial<M, Dim>& result) const;
};

namespace detail {

template <std::size_t M, int Dim>
std::array<double, M> deviator_sizes(const MixedTrial<M, Dim>& trial) {
  std::array<double, M> j;
  for (std::size_t k = 0; k < M; ++k) j[k] = sqrt_j2_of_deviator(trial.deviator[k]);
  return j;
}

/// Finite test that also catches squares which overflow.
template <std::size_t M>
bool all_finite(double p, const std::array<double, M>& j) {
  double sum = std::abs(p);
  for (const double size : j) sum += size;
  return std::isfinite(sum);
}

template <std::size_t M, int Dim>
void return_to_apex(const Cone& cone, const ElasticModuli& m, const MixedTrial<M, Dim>& trial,
                    const std::array<double, M>& j, const std::array<double, M>& weights,
                    MixedResult<M, Dim>& r) {
  r.status = UpdateStatus::apex;
  r.pressure = cone.apex_pressure();
  r.factor.fill(0);
  r.yields.fill(true);
  for (std::size_t k = 0; k < M; ++k) {
    r.deviator[k].setZero();
    r.plastic_strain_increment +=
        weights[k] * equivalent_elastic_strain(m, trial.pressure - r.pressure, j[k]);
  }
}

template <std::size_t M, int Dim>
void return_to_cone(const Cone& cone, const ElasticModuli& m, const MixedTrial<M, Dim>& trial,
                    const std::array<double, M>& j, const std::array<double, M>& weights,
                    double radius, MixedResult<M, Dim>& r) {
  double multiplier = 0;
  for (std::size_t k = 0; k < M; ++k) {
    r.factor[k] = r.yields[k] ? std::min(1.0, radius / j[k]) : 1.0;
    r.deviator[k] = r.factor[k] * trial.deviator[k];
    if (r.yields[k]) multiplier += weights[k] * std::max(0.0, j[k] - radius) / m.shear;
  }
  r.plastic_strain_increment = std::sqrt(1.0 / 3 + 2 * cone.beta * cone.beta) * multiplier;
}

}  // namespace detail

/// Returns a block to its cone: one pressure, M deviators, solved exactly.
///
///   p - p_tr + 3 K beta sum_k w_k dl_k = 0,  dl_k = max(0, J_k + 3 alpha p - strength) / mu
///   Y = strength - 3 alpha p > 0: s_k = s_k,tr min(1, Y / J_k),
///                                 plastic strain sqrt(1/3 + 2 beta^2) sum_k w_k dl_k
///   else the apex: s_k = 0, p = strength / (3 alpha), plastic strain of (trial - stress)
/// @param weights  volume shares w_k >= 0 with sum 1
/// @param plastic_volume_strain  accumulated at the beginning of the step (dilation cut-off)
/// No allocation, at most M^2 / 2 comparisons. Not finite -> status failed.
template <ConeMaterial Material, std::size_t M, int Dim>
MixedResult<M, Dim> mixed_return(const Material& material, const MixedTrial<M, Dim>& trial,
                                 const std::array<double, M>& weights,
                                 double plastic_volume_strain) {
  const ElasticModuli& m = material.moduli;
  const Cone cone = yield_cone(material, plastic_volume_strain);
  const std::array<double, M> j = detail::deviator_sizes(trial);
  MixedResult<M, Dim> r;
  if (!detail::all_finite(trial.pressure, j)) {
    r.status = UpdateStatus::failed;
    return r;
  }
  const detail::ConeSweep<M> sweep = detail::sweep_cone(cone, m, trial.pressure, j, weights);
  r.pressure = sweep.pressure;
  r.yields = sweep.yields;
  r.plastic = std::any_of(r.yields.begin(), r.yields.end(), [](bool y) { return y; });
  const double radius = cone.radius(r.pressure);
  if (r.plastic && radius <= 0) {
    detail::return_to_apex(cone, m, trial, j, weights, r);
  } else {
    detail::return_to_cone(cone, m, trial, j, weights, radius, r);
  }
  r.plastic_volume_increment = (trial.pressure - r.pressure) / m.bulk;
  return r;
}

/// Elastic block: the trial is the stress.
template <std::size_t M, int Dim>
MixedResult<M, Dim> mixed_return(const Elastic&, const MixedTrial<M, Dim>& trial,
                                 const std::array<double, M>& /*weights*/,
                                 double /*plastic_volume_strain*/) {
  MixedResult<M, Dim> r;
  if (!detail::all_finite(trial.pressure, detail::deviator_sizes(trial))) {
    r.status = UpdateStatus::failed;
    return r;
  }
  r.pressure = trial.pressure;
  r.deviator = trial.deviator;
  r.factor.fill(1);
  r.yields.fill(false);
  return r;
}

/// Consistent tangent at a trial whose `result` came from `mixed_return` with the same arguments.
template <ConeMaterial Material, std::size_t M, int Dim>
MixedTangent<M, Dim> mixed_tangent(const Material& material, const MixedTrial<M, Dim>& trial,
                                   const std::array<double, M>& weights,
                                   double plastic_volume_strain,
                                   const MixedResult<M, Dim>& result) {
  assert(result.status != UpdateStatus::failed);
  const ElasticModuli& m = material.moduli;
  const Cone cone = yield_cone(material, plastic_volume_strain);
  MixedTangent<M, Dim> t;
  t.moduli = m;
  t.apex = result.status == UpdateStatus::apex;
  t.three_alpha = 3 * cone.alpha;
  t.factor = result.factor;
  const double slope = 3 * m.bulk * cone.beta / m.shear;
  double active = 0;
  for (std::size_t k = 0; k < M; ++k) {
    const bool yields = !t.apex && result.yields[k];
    t.pressure_weight[k] = yields ? slope * weights[k] : 0;
    active += t.pressure_weight[k];
    if (yields) {
      t.normal[k] = trial.deviator[k] / sqrt_j2_of_deviator(trial.deviator[k]);
    } else {
      t.normal[k].setZero();
    }
  }
  t.pressure_scale = 1 / (1 + t.three_alpha * active);
  return t;
}

/// Tangent of an elastic block: the identity on trial directions.
template <std::size_t M, int Dim>
MixedTangent<M, Dim> mixed_tangent(const Elastic& material, const MixedTrial<M, Dim>&,
                                   const std::array<double, M>&, double,
                                   const MixedResult<M, Dim>&) {
  MixedTangent<M, Dim> t;
  t.moduli = material.moduli;
  t.pressure_weight.fill(0);
  t.factor.fill(1);
  for (auto& n : t.normal) n.setZero();
  return t;
}

template <std::size_t M, int Dim>
void MixedTangent<M, Dim>::apply_to_trial(const MixedTrial<M, Dim>& direction,
                                          MixedTrial<M, Dim>& result) const {
  if (apex) {
    result.pressure = 0;
    for (auto& s : result.deviator) s.setZero();
    return;
  }
  std::array<double, M> dj;
  double dp = direction.pressure;
  for (std::size_t k = 0; k < M; ++k) {
    dj[k] = contract(normal[k], direction.deviator[k]) / 2;
    dp -= pressure_weight[k] * dj[k];
  }
  dp *= pressure_scale;
  for (std::size_t k = 0; k < M; ++k) {
    const double along_normal = factor[k] * dj[k] + three_alpha * dp;
    result.deviator[k] = factor[k] * direction.deviator[k] - along_normal * normal[k];
  }
  result.pressure = dp;
}

template <std::size_t M, int Dim>
void MixedTangent<M, Dim>::apply_to_strain(
    double volume_strain, const std::array<StrainVector<Dim>, M>& deviatoric_strain,
    MixedTrial<M, Dim>& result) const {
  result.pressure = moduli.bulk * volume_strain;
  for (std::size_t k = 0; k < M; ++k) {
    result.deviator[k] = 2 * moduli.shear * with_tensor_shear(deviatoric_strain[k]);
  }
  apply_to_trial(result, result);
}

}  // namespace constitutive

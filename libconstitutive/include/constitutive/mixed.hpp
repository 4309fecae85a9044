#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "constitutive/drucker_prager.hpp"
#include "constitutive/tensor.hpp"

/// A block of M deviatoric sub-points that share one mean stress.
///
/// One volumetric and M deviatoric strains per block: as many dilation constraints as blocks, which
/// keeps collapse loads free of locking. M = 1 is the ordinary return mapping, exactly.
namespace constitutive {

/// Elastic trial of a block: s_k,tr = Q s_k,n Q^T + 2 mu de_k, p_tr = p_n + K dvol.
template <std::size_t M, int Dim = 2, class Real = double>
struct MixedTrial {
  Real pressure = 0;  ///< Trial mean stress, tension positive [Pa].
  /// Trial deviators (traceless, stress-like) [Pa].
  std::array<StressVector<Dim, Real>, M> deviator;
};

/// Stress of a block after the return; if it failed, everything but `outcome` is unspecified.
template <std::size_t M, int Dim = 2, class Real = double>
struct [[nodiscard]] MixedResult {
  BasicUpdateOutcome<Real> outcome;                 ///< Plastic if at least one sub-point yields.
  Real pressure = 0;                                ///< Mean stress of the block [Pa].
  std::array<StressVector<Dim, Real>, M> deviator;  ///< s_k = factor_k s_k,tr [Pa].
  std::array<Real, M> factor;  ///< Y / J_k of a yielding sub-point, 1 of an elastic one, 0 apex.
  std::array<Mask<Real>, M> yields;   ///< Whether sub-point k flows (all do at the apex).
  Real plastic_strain_increment = 0;  ///< Weighted mean of sqrt(2/3 de_p : de_p) [-].
  Real plastic_volume_increment = 0;  ///< (p_tr - p) / K [-].
};

/// Consistent tangent of `mixed_return`, kept as its few numbers and applied to directions.
///
/// With n_k = s_k,tr / J_k (not unit), q_k = factor_k, j_k = n_k : ds_k,tr / 2 and A the yielding
/// sub-points:
///   dp (1 + 9 K alpha beta w_A / mu) = dp_tr - (3 K beta / mu) sum_A w_k j_k
///   yielding: ds_k = q_k ds_k,tr - n_k (q_k j_k + 3 alpha dp);   elastic: ds_k = ds_k,tr
/// and zero at the apex.
template <std::size_t M, int Dim = 2, class Real = double>
struct MixedTangent {
  ElasticModuli moduli;
  Real three_alpha = 0;                           ///< 3 alpha.
  Real pressure_scale = 1;                        ///< 1 / (1 + 9 K alpha beta w_A / mu), 0 apex.
  std::array<Real, M> pressure_weight;            ///< 3 K beta w_k / mu if yielding, else 0.
  std::array<Real, M> factor;                     ///< q_k, 1 of an elastic sub-point, 0 apex.
  std::array<StressVector<Dim, Real>, M> normal;  ///< n_k if yielding, 0 if elastic or at the apex.

  /// (dp, ds_k) of a direction of the *trial stress*; exact also for finite strain, where the trial
  /// changes with the rotation. In-place use (same object for both) is allowed.
  void apply_to_trial(const MixedTrial<M, Dim, Real>& direction,
                      MixedTrial<M, Dim, Real>& result) const;

  /// (dp, ds_k) of small-strain directions: volume strain and M deviatoric strain vectors
  /// (engineering shear, traceless).
  void apply_to_strain(const Real& volume_strain,
                       const std::array<StrainVector<Dim, Real>, M>& deviatoric_strain,
                       MixedTrial<M, Dim, Real>& result) const;
};

namespace detail {

template <std::size_t M, int Dim, class Real>
std::array<Real, M> deviator_sizes(const MixedTrial<M, Dim, Real>& trial) {
  std::array<Real, M> j;
  for (std::size_t k = 0; k < M; ++k) j[k] = sqrt_j2_of_deviator(trial.deviator[k]);
  return j;
}

/// Finite test that also catches squares which overflow.
template <std::size_t M, class Real>
Mask<Real> all_finite(const Real& p, const std::array<Real, M>& j) {
  using std::abs;
  Real sum = abs(p);
  for (const Real& size : j) sum += size;
  return is_finite(sum);
}

/// Overwrites the result where `r.outcome.apex` holds.
template <std::size_t M, int Dim, class Real>
void return_to_apex(const BasicCone<Real>& cone, const ElasticModuli& m,
                    const MixedTrial<M, Dim, Real>& trial, const std::array<Real, M>& j,
                    const std::array<double, M>& weights, MixedResult<M, Dim, Real>& r) {
  const Real pressure = cone.apex_pressure();
  Real plastic_strain = 0;
  for (std::size_t k = 0; k < M; ++k) {
    r.factor[k] = select(r.outcome.apex, 0, r.factor[k]);
    r.yields[k] = r.yields[k] | r.outcome.apex;
    plastic_strain +=
        weights[k] * equivalent_elastic_strain(m, Real(trial.pressure - pressure), j[k]);
  }
  r.pressure = select(r.outcome.apex, pressure, r.pressure);
  r.plastic_strain_increment = select(r.outcome.apex, plastic_strain, r.plastic_strain_increment);
}

template <std::size_t M, class Real>
void return_to_cone(const BasicCone<Real>& cone, const ElasticModuli& m,
                    const std::array<Real, M>& j, const std::array<double, M>& weights,
                    const Real& radius, std::array<Real, M>& factor, Real& plastic_strain,
                    const std::array<Mask<Real>, M>& yields) {
  using std::max;
  using std::min;
  using std::sqrt;
  Real multiplier = 0;
  for (std::size_t k = 0; k < M; ++k) {
    factor[k] = select(yields[k], min(Real(1), Real(radius / j[k])), 1);
    multiplier += select(yields[k], weights[k] / m.shear * max(Real(0), Real(j[k] - radius)), 0);
  }
  plastic_strain = sqrt(Real(1.0 / 3 + 2 * cone.beta * cone.beta)) * multiplier;
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
template <ConeMaterial Material, std::size_t M, int Dim, class Real>
MixedResult<M, Dim, Real> mixed_return(const Material& material,
                                       const MixedTrial<M, Dim, Real>& trial,
                                       const std::array<double, M>& weights,
                                       const std::type_identity_t<Real>& plastic_volume_strain) {
  const ElasticModuli& m = material.moduli;
  const BasicCone<Real> cone = yield_cone<Real>(material, plastic_volume_strain);
  const std::array<Real, M> j = detail::deviator_sizes(trial);
  MixedResult<M, Dim, Real> r;
  r.outcome.failed = !detail::all_finite(trial.pressure, j);
  const auto sweep = detail::sweep_cone(cone, m, trial.pressure, j, weights);
  r.pressure = sweep.pressure;
  r.yields = sweep.yields;
  for (const Mask<Real>& yields : r.yields) r.outcome.plastic = r.outcome.plastic | yields;
  const Real radius = cone.radius(r.pressure);
  detail::return_to_cone(cone, m, j, weights, radius, r.factor, r.plastic_strain_increment,
                         r.yields);
  r.outcome.apex = r.outcome.plastic & (radius <= Real(0));
  if (any(r.outcome.apex)) detail::return_to_apex(cone, m, trial, j, weights, r);
  for (std::size_t k = 0; k < M; ++k) r.deviator[k] = r.factor[k] * trial.deviator[k];
  r.plastic_volume_increment = (trial.pressure - r.pressure) / m.bulk;
  return r;
}

/// Elastic block: the trial is the stress.
template <std::size_t M, int Dim, class Real>
MixedResult<M, Dim, Real> mixed_return(
    const Elastic&, const MixedTrial<M, Dim, Real>& trial, const std::array<double, M>& /*weights*/,
    const std::type_identity_t<Real>& /*plastic_volume_strain*/) {
  MixedResult<M, Dim, Real> r;
  r.outcome.failed = !detail::all_finite(trial.pressure, detail::deviator_sizes(trial));
  r.pressure = trial.pressure;
  r.deviator = trial.deviator;
  r.factor.fill(1);
  r.yields.fill({});
  return r;
}

/// Consistent tangent at a trial whose `result` came from `mixed_return` with the same arguments.
template <ConeMaterial Material, std::size_t M, int Dim, class Real>
MixedTangent<M, Dim, Real> mixed_tangent(const Material& material,
                                         const MixedTrial<M, Dim, Real>& trial,
                                         const std::array<double, M>& weights,
                                         const std::type_identity_t<Real>& plastic_volume_strain,
                                         const MixedResult<M, Dim, Real>& result) {
  const ElasticModuli& m = material.moduli;
  const BasicCone<Real> cone = yield_cone<Real>(material, plastic_volume_strain);
  MixedTangent<M, Dim, Real> t;
  t.moduli = m;
  t.three_alpha = 3 * cone.alpha;
  t.factor = result.factor;
  const Real slope = 3 * m.bulk / m.shear * cone.beta;
  Real active = 0;
  for (std::size_t k = 0; k < M; ++k) {
    const Mask<Real> yields = result.yields[k] & !result.outcome.apex;
    t.pressure_weight[k] = select(yields, slope * weights[k], 0);
    active += t.pressure_weight[k];
    // A sub-point that does not yield may have no direction: 1 / 0 is then not chosen.
    const Real length = sqrt_j2_of_deviator(trial.deviator[k]);
    t.normal[k] = select(yields, 1 / length, 0) * trial.deviator[k];
  }
  t.pressure_scale = select(result.outcome.apex, 0, 1 / (1 + t.three_alpha * active));
  return t;
}

/// Tangent of an elastic block: the identity on trial directions.
template <std::size_t M, int Dim, class Real>
MixedTangent<M, Dim, Real> mixed_tangent(const Elastic& material, const MixedTrial<M, Dim, Real>&,
                                         const std::array<double, M>&,
                                         const std::type_identity_t<Real>&,
                                         const MixedResult<M, Dim, Real>&) {
  MixedTangent<M, Dim, Real> t;
  t.moduli = material.moduli;
  t.pressure_weight.fill(0);
  t.factor.fill(1);
  for (auto& n : t.normal) n.setZero();
  return t;
}

template <std::size_t M, int Dim, class Real>
void MixedTangent<M, Dim, Real>::apply_to_trial(const MixedTrial<M, Dim, Real>& direction,
                                                MixedTrial<M, Dim, Real>& result) const {
  std::array<Real, M> dj;
  Real dp = direction.pressure;
  for (std::size_t k = 0; k < M; ++k) {
    dj[k] = contract(normal[k], direction.deviator[k]) / 2;
    dp -= pressure_weight[k] * dj[k];
  }
  dp *= pressure_scale;
  for (std::size_t k = 0; k < M; ++k) {
    const Real along_normal = factor[k] * dj[k] + three_alpha * dp;
    result.deviator[k] = factor[k] * direction.deviator[k] - along_normal * normal[k];
  }
  result.pressure = dp;
}

template <std::size_t M, int Dim, class Real>
void MixedTangent<M, Dim, Real>::apply_to_strain(
    const Real& volume_strain, const std::array<StrainVector<Dim, Real>, M>& deviatoric_strain,
    MixedTrial<M, Dim, Real>& result) const {
  result.pressure = moduli.bulk * volume_strain;
  for (std::size_t k = 0; k < M; ++k) {
    result.deviator[k] = Real(2 * moduli.shear) * with_tensor_shear(deviatoric_strain[k]);
  }
  apply_to_trial(result, result);
}

}  // namespace constitutive

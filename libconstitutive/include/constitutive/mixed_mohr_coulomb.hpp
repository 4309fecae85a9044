#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "constitutive/mixed.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/spectral.hpp"

/// `mixed_return` and `mixed_tangent` of Mohr-Coulomb: M deviators that share one mean stress.
///
/// At a given mean stress p a sub-point returns to its surface without a change of p: that is the
/// ordinary return of p + s_k,tr with elasticity of no bulk modulus. The dilation of all of them is
/// what p has to make up for,
///   p - p_tr + 2 K sin psi sum_k w_k l_k(p) = 0,
/// l_k the sum of the multipliers of sub-point k: convex, rising and piecewise linear in p, so that
/// Newton's method from above ends at the root after finitely many steps. M = 1 is the ordinary
/// update. Beyond the apex all deviators vanish.
namespace constitutive {

namespace detail {

/// A sub-point at a given mean stress.
struct CornerPoint {
  Spectrum trial;                                      ///< Of p + s_k,tr.
  PrincipalReturn returned;                            ///< At this mean stress.
  double multiplier = 0;                               ///< Sum of the multipliers l_k [-].
  Eigen::Vector3d by_trial = Eigen::Vector3d::Zero();  ///< dl_k / d(principal trial) [1/Pa].
};

/// The material with which a return leaves the mean stress alone.
inline MohrCoulomb without_bulk(MohrCoulomb m) {
  m.moduli.bulk = 0;
  m.moduli.lame = -2.0 / 3 * m.moduli.shear;
  return m;
}

/// The return of one sub-point. @param m  without bulk
inline void return_at_mean(const MohrCoulomb& m, double sin_psi, const Spectrum& trial,
                           CornerPoint& point) {
  point.trial = trial;
  point.returned = return_principal(m, sin_psi, trial.values);
  point.multiplier = 0;
  point.by_trial.setZero();
  if (point.returned.regime == MohrCoulombRegime::elastic) return;
  // At the apex pressure the surface is one point, reached along one of its edges: on which side of
  // the main plane's flow, (1 + s / 3, -2 s / 3, -(1 - s / 3)) without its mean, the trial lies.
  if (point.returned.regime == MohrCoulombRegime::apex) {
    const Eigen::Vector3d t = trial.values.array() - trial.values.mean();
    const bool extension = t[1] * (3 + sin_psi) < -2 * sin_psi * t[0];
    (void)return_to_edge(m, sin_psi, trial.values, extension ? 0 : 1, extension ? 1 : 2,
                         point.returned);
  }
  // One row is shared by all active planes, the smallest stress unless the smallest two are equal:
  // what it has lost is the sum of the multipliers.
  const bool largest = point.returned.regime == MohrCoulombRegime::extension_edge;
  const int row = largest ? 0 : 2;
  const double flow = 2 * m.moduli.shear * (largest ? 1 + sin_psi / 3 : -(1 - sin_psi / 3));
  point.multiplier = (trial.values[row] - point.returned.stress[row]) / flow;
  point.by_trial = -point.returned.jacobian.row(row).transpose() / flow;
  point.by_trial[row] += 1 / flow;
}

/// The trial's deviators in their principal frames, but of sub-points that are elastic for sure: at
/// the trial's mean stress, and so at any lower one.
template <std::size_t M>
struct TrialSpectra {
  std::array<bool, M> is_elastic;
  std::array<Spectrum, M> of;  ///< Unspecified where it is elastic.

  template <int Dim>
  TrialSpectra(const MohrCoulomb& m, const MixedTrial<M, Dim>& trial,
               const std::array<double, M>& sizes) {
    for (std::size_t k = 0; k < M; ++k) {
      is_elastic[k] = is_within_for_sure(m, trial.pressure, sizes[k]);
      if (!is_elastic[k]) of[k] = spectrum(trial.deviator[k]);
    }
  }
};

/// A block at a given mean stress: the rest of the equation for p, and its slope.
template <std::size_t M>
struct CornerBlock {
  std::array<CornerPoint, M> point;
  double rest = 0, slope = 1;

  CornerBlock(const MohrCoulomb& material, double sin_psi, double trial_pressure,
              const TrialSpectra<M>& deviator, const std::array<double, M>& weights,
              double pressure)
      : rest(pressure - trial_pressure) {
    const MohrCoulomb m = without_bulk(material);
    const double dilation = 2 * material.moduli.bulk * sin_psi;
    for (std::size_t k = 0; k < M; ++k) {
      if (deviator.is_elastic[k]) continue;
      Spectrum at_pressure = deviator.of[k];
      at_pressure.values.array() += pressure;
      return_at_mean(m, sin_psi, at_pressure, point[k]);
      rest += dilation * weights[k] * point[k].multiplier;
      slope += dilation * weights[k] * point[k].by_trial.sum();
    }
  }
};

/// Mean stress of the apex; infinite for Tresca's prism.
inline double apex_pressure(const MohrCoulomb& m) {
  if (m.sin_friction == 0) return std::numeric_limits<double>::infinity();
  return m.cohesion * m.cos_friction / m.sin_friction;
}

/// Whether the block ends at the apex, else the block at its mean stress, which `pressure` becomes.
template <std::size_t M>
bool solve_corner_block(const MohrCoulomb& m, double sin_psi, double trial_pressure,
                        const TrialSpectra<M>& deviator, const std::array<double, M>& weights,
                        double& pressure, CornerBlock<M>& block) {
  const double apex = apex_pressure(m);
  pressure = std::min(trial_pressure, apex);
  const auto at = [&](double p) {
    return CornerBlock<M>(m, sin_psi, trial_pressure, deviator, weights, p);
  };
  block = at(pressure);
  if (trial_pressure >= apex && block.rest <= 0) return true;
  // Each sub-point has three linear pieces; a step that gains nothing is the last.
  for (std::size_t step = 0; step < 3 * M + 3 && block.rest > 0; ++step) {
    const double next = pressure - block.rest / block.slope;
    if (!(next < pressure)) break;
    pressure = next;
    block = at(pressure);
  }
  return false;
}

}  // namespace detail

/// Result of a block of Mohr-Coulomb, with what its tangent is made of.
template <std::size_t M, int Dim = 2>
struct [[nodiscard]] MixedCornerResult : MixedResult<M, Dim> {
  std::array<detail::CornerPoint, M>
      point;         ///< At the block's mean stress; unspecified at the apex and where none yields.
  double slope = 1;  ///< Of the equation for p.
};

/// Returns a block to Mohr-Coulomb's surface: one pressure, M deviators, to round-off.
/// @param weights  volume shares w_k >= 0 with sum 1
/// @param plastic_volume_strain  accumulated at the beginning of the step (dilation cut-off)
/// No allocation. Not finite, or a material with a tension cut-off -> status failed.
template <std::size_t M, int Dim>
MixedCornerResult<M, Dim> mixed_return(const MohrCoulomb& material, const MixedTrial<M, Dim>& trial,
                                       const std::array<double, M>& weights,
                                       double plastic_volume_strain) {
  using detail::MohrCoulombRegime;
  const ElasticModuli& moduli = material.moduli;
  const double sin_psi = detail::sine_of_dilation(
      material, PointState<Dim>{.plastic_volume_strain = plastic_volume_strain});
  MixedCornerResult<M, Dim> r;
  const auto sizes = detail::deviator_sizes(trial);
  r.outcome.failed = !detail::all_finite(trial.pressure, sizes) || std::isfinite(material.tension);
  if (r.outcome.failed) return r;
  const detail::TrialSpectra<M> deviator(material, trial, sizes);
  detail::CornerBlock<M> block(material, sin_psi, trial.pressure, deviator, weights,
                               trial.pressure);
  r.outcome.apex = detail::solve_corner_block(material, sin_psi, trial.pressure, deviator, weights,
                                              r.pressure, block);
  r.point = block.point;
  r.slope = block.slope;
  r.plastic_volume_increment = (trial.pressure - r.pressure) / moduli.bulk;
  for (std::size_t k = 0; k < M; ++k) {
    const detail::CornerPoint& point = block.point[k];
    r.yields[k] = r.outcome.apex || point.returned.regime != MohrCoulombRegime::elastic;
    if (!r.yields[k]) {
      r.deviator[k] = trial.deviator[k];
      continue;
    }
    r.outcome.plastic = true;
    double dilation = trial.pressure - r.pressure;
    if (r.outcome.apex) {
      r.deviator[k].setZero();
    } else {
      dilation = 2 * moduli.bulk * sin_psi * point.multiplier;
      r.deviator[k] = recompose<Dim>(Eigen::Vector3d(point.returned.stress.array() - r.pressure),
                                     deviator.of[k].directions);
    }
    const double removed =
        sqrt_j2_of_deviator(StressVector<Dim>(trial.deviator[k] - r.deviator[k]));
    r.plastic_strain_increment += weights[k] * equivalent_elastic_strain(moduli, dilation, removed);
  }
  return r;
}

/// Consistent tangent of a block of Mohr-Coulomb: with T_k the derivative of the return at a given
/// mean stress and c_k that of the multiplier, both by p + s_k,tr,
///   dp slope = dp_tr - 2 K sin psi sum_k w_k c_k : ds_k,tr,
///   ds_k = T_k (ds_k,tr + dp I) - dp I;
/// zero at the apex.
template <std::size_t M, int Dim>
struct MixedCornerTangent {
  double pressure_scale = 1;                         ///< 1 / slope, 0 at the apex.
  std::array<TangentMatrix<Dim>, M> at_mean;         ///< T_k.
  std::array<StressVector<Dim>, M> pressure_weight;  ///< 2 K sin psi w_k c_k, for a plain product.

  /// (dp, ds_k) of a direction of the trial stress. In-place use is allowed.
  void apply_to_trial(const MixedTrial<M, Dim>& direction, MixedTrial<M, Dim>& result) const {
    double dp = direction.pressure;
    for (std::size_t k = 0; k < M; ++k) dp -= pressure_weight[k].dot(direction.deviator[k]);
    dp *= pressure_scale;
    const StressVector<Dim> sphere = isotropic<Dim>(dp);
    for (std::size_t k = 0; k < M; ++k) {
      result.deviator[k] =
          pressure_scale == 0
              ? StressVector<Dim>::Zero()
              : StressVector<Dim>(at_mean[k] * (direction.deviator[k] + sphere) - sphere);
    }
    result.pressure = dp;
  }
};

/// Consistent tangent at a trial whose `result` came from `mixed_return` with the same arguments.
template <std::size_t M, int Dim>
MixedCornerTangent<M, Dim> mixed_tangent(const MohrCoulomb& material, const MixedTrial<M, Dim>&,
                                         const std::array<double, M>& weights,
                                         double plastic_volume_strain,
                                         const MixedCornerResult<M, Dim>& result) {
  const double sin_psi = detail::sine_of_dilation(
      material, PointState<Dim>{.plastic_volume_strain = plastic_volume_strain});
  MixedCornerTangent<M, Dim> t;
  t.pressure_scale = result.outcome.apex ? 0 : 1 / result.slope;
  for (std::size_t k = 0; k < M; ++k) {
    const detail::CornerPoint& point = result.point[k];
    t.at_mean[k].setIdentity();
    t.pressure_weight[k].setZero();
    if (!result.yields[k] || result.outcome.apex) continue;
    t.at_mean[k] = isotropic_function_derivative<Dim>(point.trial, point.returned.stress,
                                                      point.returned.jacobian);
    const Eigen::Matrix3d& n = point.trial.directions;
    t.pressure_weight[k] =
        2 * material.moduli.bulk * sin_psi * weights[k] *
        with_engineering_shear(from_matrix<Dim>(n * point.by_trial.asDiagonal() * n.transpose()));
  }
  return t;
}

}  // namespace constitutive

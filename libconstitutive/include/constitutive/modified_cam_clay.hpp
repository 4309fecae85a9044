#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "constitutive/elastic.hpp"
#include "constitutive/no_subpoints.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// Modified Cam Clay (Roscoe & Burland 1968), associated, by the implicit return of Borja & Lee
/// (1990); plane strain and 3D.
///
/// With p the mean stress, compression positive, q = sqrt(3 J2) and e_v the volume strain,
/// compression positive:  f = q^2 / M^2 + p (p - p_c),  p = p_0 exp(e_v^e / kappa),
/// p_c = p_c0 exp(e_v^p / (lambda - kappa)), kappa and lambda being slopes of volume strain over
/// ln p. The shear modulus is constant: elasticity then keeps no energy back in a closed path.
/// p_c follows from `plastic_volume_strain`, so that a point has no more state than others.
struct ModifiedCamClay {
  static constexpr std::array<ModelInfo, 1> models{
      {{.name = "modified_cam_clay",
        .doc = "clay that hardens with its compaction; bulk modulus p / swelling_index, shear "
               "modulus that of E and nu",
        .critical_state = true}}};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;
  static constexpr bool without_subpoints = true;

  /// Of the trial stress, whose volume strain they tell; the shear modulus is the clay's as well.
  ElasticModuli moduli;
  double slope = 1;             ///< M = q / p in the critical state.
  double compression = 0;       ///< lambda.
  double swelling = 0;          ///< kappa.
  double preconsolidation = 0;  ///< p_c of a state without plastic volume strain [Pa].

  static ModifiedCamClay make(const MaterialParameters& p, const ModelInfo&) {
    return {elastic_moduli(p.youngs_modulus, p.poissons_ratio), p.critical_stress_ratio,
            p.compression_index, p.swelling_index, p.preconsolidation_pressure};
  }

  /// What is borne at least: without a mean stress there is no stiffness, and no tension [Pa].
  [[nodiscard]] double least_pressure() const { return 1e-6 * preconsolidation; }

  /// p_c at a plastic volume strain (dilation positive) [Pa].
  [[nodiscard]] double preconsolidation_at(double plastic_volume_strain) const {
    return preconsolidation * std::exp(-plastic_volume_strain / (compression - swelling));
  }
};

/// The preconsolidation p + q^2 / (M^2 p) at which a stress just yields [Pa].
/// @param slope  M  @param stress  [Pa] with a mean stress < 0
template <int Dim>
double yield_pressure(double slope, const std::type_identity_t<StressVector<Dim>>& stress) {
  const double p = -mean_stress(stress);
  return p + 3 * j2(stress) / (slope * slope * p);
}

/// Stress update of `ModifiedCamClay` from the linear elastic trial stress of its `moduli`.
///
/// The trial's volume strain is taken from its mean stress; a trial without any is returned bit for
/// bit if it is admissible. Failed where the pressure is no number. `s0` and `s1` may be the same
/// object. No allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const ModifiedCamClay& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1);

/// d(stress)/d(trial stress) of `update` at a finite trial.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const ModifiedCamClay& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0);

}  // namespace constitutive

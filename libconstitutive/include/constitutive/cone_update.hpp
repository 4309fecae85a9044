#pragma once

#include <type_traits>

#include "constitutive/mixed.hpp"

/// Ordinary return mapping of the cone materials: a block with one deviatoric point.
namespace constitutive {

namespace detail {

inline constexpr std::array<double, 1> whole_weight{1.0};

template <int Dim, class Real>
MixedTrial<1, Dim, Real> single_point_trial(const StressVector<Dim, Real>& trial) {
  return {mean_stress(trial), {deviator(trial)}};
}

template <int Dim, class Real>
StressVector<Dim, Real> recompose(const Real& p, const StressVector<Dim, Real>& s) {
  return s + isotropic<Dim>(p);
}

}  // namespace detail

/// Stress update of `VonMises` or `DruckerPrager` from the elastic trial stress.
///
/// dl = f / (mu + 9 K alpha beta); cone if sqrt(J2) - mu dl > 0, else the apex. An admissible trial
/// is returned bit for bit. `s0` and `s1` may be the same object. No allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <ConeMaterial Material, int Dim, class Real>
BasicUpdateOutcome<Real> update(const Material& material,
                                const std::type_identity_t<StressVector<Dim, Real>>& trial,
                                const PointState<Dim, Real>& s0, PointState<Dim, Real>& s1) {
  const MixedResult<1, Dim, Real> r = mixed_return(material, detail::single_point_trial<Dim>(trial),
                                                   detail::whole_weight, s0.plastic_volume_strain);
  const StressVector<Dim, Real> returned = detail::recompose<Dim>(r.pressure, r.deviator[0]);
  const Mask<Real>& failed = r.outcome.failed;
  const Mask<Real> flows = r.outcome.plastic & !failed;
  const Mask<Real> at_apex = r.outcome.apex & !failed;
  for (int row = 0; row < stress_size<Dim>; ++row) {
    const Real accepted = select(flows, returned[row], trial[row]);
    s1.stress[row] = select(failed, s0.stress[row], accepted);
  }
  s1.plastic_strain = s0.plastic_strain + select(flows, r.plastic_strain_increment, 0);
  s1.plastic_volume_strain =
      s0.plastic_volume_strain + select(flows, r.plastic_volume_increment, 0);
  return {failed, at_apex, flows};
}

/// d(stress)/d(trial stress) of `update` at a finite trial: maps stress-like to stress-like
/// vectors.
template <ConeMaterial Material, int Dim, class Real>
TangentMatrix<Dim, Real> trial_tangent(const Material& material,
                                       const std::type_identity_t<StressVector<Dim, Real>>& trial,
                                       const PointState<Dim, Real>& s0) {
  const MixedTrial<1, Dim, Real> single = detail::single_point_trial<Dim>(trial);
  const Real& plastic_volume = s0.plastic_volume_strain;
  const MixedResult<1, Dim, Real> r =
      mixed_return(material, single, detail::whole_weight, plastic_volume);
  if (!any(r.outcome.plastic)) return TangentMatrix<Dim, Real>::Identity();
  const MixedTangent<1, Dim, Real> tangent =
      mixed_tangent(material, single, detail::whole_weight, plastic_volume, r);
  TangentMatrix<Dim, Real> t;
  for (int column = 0; column < stress_size<Dim>; ++column) {
    const StressVector<Dim, Real> unit = StressVector<Dim, Real>::Unit(column);
    MixedTrial<1, Dim, Real> direction = detail::single_point_trial<Dim>(unit);
    tangent.apply_to_trial(direction, direction);
    t.col(column) = detail::recompose<Dim>(direction.pressure, direction.deviator[0]);
  }
  return t;
}

}  // namespace constitutive

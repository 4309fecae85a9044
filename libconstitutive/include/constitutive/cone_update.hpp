#pragma once

#include <type_traits>

#include "constitutive/mixed.hpp"

/// Ordinary return mapping of the cone materials: a block with one deviatoric point.
namespace constitutive {

namespace detail {

inline constexpr std::array<double, 1> whole_weight{1.0};

template <int Dim>
MixedTrial<1, Dim> single_point_trial(const StressVector<Dim>& trial) {
  return {mean_stress(trial), {deviator(trial)}};
}

template <int Dim>
StressVector<Dim> recompose(double p, const StressVector<Dim>& s) {
  return s + isotropic<Dim>(p);
}

}  // namespace detail

/// Stress update of `VonMises` or `DruckerPrager` from the elastic trial stress.
///
/// dl = f / (mu + 9 K alpha beta); cone if sqrt(J2) - mu dl > 0, else the apex. An admissible trial
/// is returned bit for bit. `s0` and `s1` may be the same object. No allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <ConeMaterial Material, int Dim>
UpdateOutcome update(const Material& material, const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  const MixedResult<1, Dim> r = mixed_return(material, detail::single_point_trial<Dim>(trial),
                                             detail::whole_weight, s0.plastic_volume_strain);
  s1 = s0;
  if (r.status == UpdateStatus::failed) return {r.status, false};
  s1.stress = r.plastic ? detail::recompose<Dim>(r.pressure, r.deviator[0]) : trial;
  if (r.plastic) {
    s1.plastic_strain += r.plastic_strain_increment;
    s1.plastic_volume_strain += r.plastic_volume_increment;
  }
  return {r.status, r.plastic};
}

/// d(stress)/d(trial stress) of `update` at a finite trial: maps stress-like to stress-like
/// vectors.
template <ConeMaterial Material, int Dim>
TangentMatrix<Dim> trial_tangent(const Material& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  const MixedTrial<1, Dim> single = detail::single_point_trial<Dim>(trial);
  const double plastic_volume = s0.plastic_volume_strain;
  const MixedResult<1, Dim> r =
      mixed_return(material, single, detail::whole_weight, plastic_volume);
  if (!r.plastic) return TangentMatrix<Dim>::Identity();
  const MixedTangent<1, Dim> tangent =
      mixed_tangent(material, single, detail::whole_weight, plastic_volume, r);
  TangentMatrix<Dim> t;
  for (int column = 0; column < stress_size<Dim>; ++column) {
    const StressVector<Dim> unit = StressVector<Dim>::Unit(column);
    MixedTrial<1, Dim> direction = detail::single_point_trial<Dim>(unit);
    tangent.apply_to_trial(direction, direction);
    t.col(column) = detail::recompose<Dim>(direction.pressure, direction.deviator[0]);
  }
  return t;
}

}  // namespace constitutive

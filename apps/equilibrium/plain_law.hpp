#pragma once

#include "constitutive/cone_update.hpp"
#include "constitutive/material.hpp"
#include "equilibrium/local_response.hpp"

namespace equilibrium {

/// Ordinary nodal integration: one stress per particle.
template <int Dim, bool Finite>
struct PlainLaw {
  static constexpr bool mixed = false;
  template <class Material, class Real>
  static void respond(const Material& material, const ParticleStart<Dim, Real>& start,
                      const ParticleIncrement<Dim, Real>& increment,
                      ParticleResponse<Dim, Real>& response);
  template <class Material, class Real>
  static constitutive::Mask<Real> linearise(const Material& material,
                                            const ParticleStart<Dim, Real>& start,
                                            const ParticleIncrement<Dim, Real>& increment,
                                            ParticleTangent<Dim, false, Real>& tangent);
};

template <int Dim, bool Finite>
template <class Material, class Real>
void PlainLaw<Dim, Finite>::respond(const Material& material, const ParticleStart<Dim, Real>& start,
                                    const ParticleIncrement<Dim, Real>& increment,
                                    ParticleResponse<Dim, Real>& response) {
  using namespace constitutive;
  if constexpr (Finite) {
    const detail::CurrentGradient<Dim, Real> now(start.gradient, increment.gradient);
    const auto motion = objective_increment(increment.gradient,
                                            detail::midpoint(start.gradient, increment.gradient));
    const auto trial = elastic_trial<Dim>(start.point.stress, motion, material.moduli);
    const auto outcome = update(material, trial, start.point, response.point);
    response.admissible = now.admissible() & motion.is_admissible() & !outcome.failed;
    response.plastic = outcome.plastic;
    response.rotation = motion.rotation;
    response.nominal = (start.reference_volume * now.determinant) *
                       spatial_part<Dim>(response.point.stress) * now.inverse.transpose();
  } else {
    const auto strain = strain_vector<Dim>(detail::symmetric(increment.gradient));
    const auto trial = elastic_trial<Dim>(start.point.stress, strain, material.moduli);
    const auto outcome = update(material, trial, start.point, response.point);
    response.admissible = !outcome.failed;
    response.plastic = outcome.plastic;
    response.rotation.setIdentity();
    response.nominal = start.reference_volume * spatial_part<Dim>(response.point.stress);
  }
  response.plastic_increment = response.point.plastic_strain - start.point.plastic_strain;
}

template <int Dim, bool Finite>
template <class Material, class Real>
constitutive::Mask<Real> PlainLaw<Dim, Finite>::linearise(
    const Material& material, const ParticleStart<Dim, Real>& start,
    const ParticleIncrement<Dim, Real>& increment, ParticleTangent<Dim, false, Real>& tangent) {
  using namespace constitutive;
  using Tensor = fpm::Tensor<Dim, Real>;
  ParticleResponse<Dim, Real> base;
  respond(material, start, increment, base);
  if constexpr (Finite) {
    const detail::CurrentGradient<Dim, Real> now(start.gradient, increment.gradient);
    const auto motion = objective_increment(increment.gradient,
                                            detail::midpoint(start.gradient, increment.gradient));
    const auto trial = elastic_trial<Dim>(start.point.stress, motion, material.moduli);
    const auto on_trial = trial_tangent(material, trial, start.point);
    const Real volume = start.reference_volume * now.determinant;
    for (int k = 0; k < Dim * Dim; ++k) {
      const auto direction = detail::unit<Tensor>(k);
      const auto d = derivative(motion, direction);
      const StressVector<Dim, Real> d_stress =
          on_trial * elastic_trial_derivative<Dim>(start.point.stress, motion, d, material.moduli);
      // P = V sigma F^-T: dP = V dsigma F^-T + P (tr(F^-1 dF) I - (F^-1 dF)^T)
      const Tensor rate = now.inverse * direction;
      const Tensor d_nominal = volume * spatial_part<Dim>(d_stress) * now.inverse.transpose() +
                               rate.trace() * base.nominal - base.nominal * rate.transpose();
      tangent.stress.col(k) = detail::flat(d_nominal);
      tangent.rotation.col(k) = detail::flat(d.rotation);
    }
  } else {
    const auto strain = strain_vector<Dim>(detail::symmetric(increment.gradient));
    const auto trial = elastic_trial<Dim>(start.point.stress, strain, material.moduli);
    const auto on_trial = trial_tangent(material, trial, start.point);
    for (int k = 0; k < Dim * Dim; ++k) {
      const auto direction = strain_vector<Dim>(detail::symmetric(detail::unit<Tensor>(k)));
      const StressVector<Dim, Real> d_stress =
          on_trial * elastic_stress<Dim>(material.moduli, direction);
      const Tensor d_nominal = start.reference_volume * spatial_part<Dim>(d_stress);
      tangent.stress.col(k) = detail::flat(d_nominal);
    }
    tangent.rotation.setZero();
  }
  return base.admissible;
}

}  // namespace equilibrium

#pragma once

#include "constitutive/cone_update.hpp"
#include "constitutive/material.hpp"
#include "wiring/local_response.hpp"

namespace wiring {
/// Ordinary nodal integration: one stress per particle.
template <int Dim, bool Finite>
struct PlainLaw {
  static constexpr bool mixed = false;
  template <class Material>
  static constexpr bool supports = true;
  template <class Material>
  static void respond(const Material& material, const ParticleStart<Dim>& start,
                      const ParticleIncrement<Dim>& increment, ParticleResponse<Dim>& response);
  template <class Material>
  static bool linearise(const Material& material, const ParticleStart<Dim>& start,
                        const ParticleIncrement<Dim>& increment,
                        ParticleTangent<Dim, false>& tangent);
};

template <int Dim, bool Finite>
template <class Material>
void PlainLaw<Dim, Finite>::respond(const Material& material, const ParticleStart<Dim>& start,
                                    const ParticleIncrement<Dim>& increment,
                                    ParticleResponse<Dim>& response) {
  using namespace constitutive;
  using fpm::Tensor;
  response.admissible = false;
  StressVector<Dim> trial;
  if constexpr (Finite) {
    const detail::CurrentGradient<Dim> now(start.gradient, increment.gradient);
    const auto motion = objective_increment<Dim>(
        increment.gradient, Tensor<Dim>(start.gradient + 0.5 * increment.gradient));
    if (!now.admissible() || !motion.is_admissible()) return;
    trial = elastic_trial(start.point.stress, motion, material.moduli);
    if (update(material, trial, start.point, response.point).status == UpdateStatus::failed) return;
    response.rotation = motion.rotation;
    response.nominal = (start.reference_volume * now.determinant) *
                       spatial_part<Dim>(response.point.stress) * now.inverse.transpose();
  } else {
    trial = elastic_trial<Dim>(start.point.stress,
                               strain_vector<Dim>(detail::symmetric<Dim>(increment.gradient)),
                               material.moduli);
    if (update(material, trial, start.point, response.point).status == UpdateStatus::failed) return;
    response.rotation.setIdentity();
    response.nominal = start.reference_volume * spatial_part<Dim>(response.point.stress);
  }
  response.plastic_increment = response.point.plastic_strain - start.point.plastic_strain;
  response.plastic = response.plastic_increment > 0.0;
  response.admissible = true;
}

template <int Dim, bool Finite>
template <class Material>
bool PlainLaw<Dim, Finite>::linearise(const Material& material, const ParticleStart<Dim>& start,
                                      const ParticleIncrement<Dim>& increment,
                                      ParticleTangent<Dim, false>& tangent) {
  using namespace constitutive;
  using fpm::Tensor;
  ParticleResponse<Dim> base;
  respond(material, start, increment, base);
  if (!base.admissible) return false;
  if constexpr (Finite) {
    const detail::CurrentGradient<Dim> now(start.gradient, increment.gradient);
    const auto motion = objective_increment<Dim>(
        increment.gradient, Tensor<Dim>(start.gradient + 0.5 * increment.gradient));
    const auto trial = elastic_trial(start.point.stress, motion, material.moduli);
    const TangentMatrix<Dim> on_trial = trial_tangent(material, trial, start.point);
    const double volume = start.reference_volume * now.determinant;
    for (int k = 0; k < Dim * Dim; ++k) {
      const Tensor<Dim> direction = detail::unit<Tensor<Dim>>(k);
      const auto d = derivative<Dim>(motion, direction);
      const StressVector<Dim> d_stress =
          on_trial * elastic_trial_derivative(start.point.stress, motion, d, material.moduli);
      // P = V sigma F^-T: dP = V dsigma F^-T + P (tr(F^-1 dF) I - (F^-1 dF)^T)
      const Tensor<Dim> rate = now.inverse * direction;
      const Tensor<Dim> d_nominal = volume * spatial_part<Dim>(d_stress) * now.inverse.transpose() +
                                    rate.trace() * base.nominal - base.nominal * rate.transpose();
      tangent.stress.col(k) = detail::flat(d_nominal);
      tangent.rotation.col(k) = detail::flat(d.rotation);
    }
  } else {
    const StressVector<Dim> trial = elastic_trial<Dim>(
        start.point.stress, strain_vector<Dim>(detail::symmetric<Dim>(increment.gradient)),
        material.moduli);
    const TangentMatrix<Dim> on_strain = constitutive::tangent(material, trial, start.point);
    for (int k = 0; k < Dim * Dim; ++k) {
      const Tensor<Dim> strain = detail::symmetric<Dim>(detail::unit<Tensor<Dim>>(k));
      const StressVector<Dim> d_stress = on_strain * strain_vector<Dim>(strain);
      const Tensor<Dim> d_nominal = start.reference_volume * spatial_part<Dim>(d_stress);
      tangent.stress.col(k) = detail::flat(d_nominal);
    }
    tangent.rotation.setZero();
  }
  return true;
}

}  // namespace wiring

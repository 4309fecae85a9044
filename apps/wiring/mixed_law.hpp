#pragma once

#include "constitutive/mixed.hpp"
#include "wiring/local_response.hpp"

namespace wiring {

/// Mixed sub-point integration in plane strain: one pressure per particle, four deviators.
///
/// Each sub-point has its own finite motion dF_k = F_k F_k(n)^-1 of the Taylor field, so a rigid
/// rotation of a bent body strains nothing; its in-plane dilation is replaced by the particle's,
/// which leaves the two unknowns per dilation constraint that collapse needs. Forces are
/// work-conjugate: with A = dev2 s_k the in-plane deviator of s_k and tr2 its in-plane trace,
///   P = V ((p + sum w tr2(s_k) / 2) F^-T + sum w A_k F_k^-T),  T = V sum w (A_k F_k^-T) x xi_k.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mixed-subpoints.md).
template <bool Finite>
struct MixedLaw {
  static constexpr bool mixed = true;
  template <class Material>
  static constexpr bool supports =
      constitutive::ConeMaterial<Material> || std::same_as<Material, constitutive::Elastic>;
  template <class Material>
  static void respond(const Material& material, const ParticleStart<2>& start,
                      const ParticleIncrement<2>& increment, ParticleResponse<2>& response);
  template <class Material>
  static bool linearise(const Material& material, const ParticleStart<2>& start,
                        const ParticleIncrement<2>& increment, ParticleTangent<2, true>& tangent);
};

namespace detail {

using Trial = constitutive::MixedTrial<fpm::subpoint_count>;
using Motion = constitutive::ObjectiveIncrement<2>;

/// Motion of a particle and of its sub-points; in small strain the gradients alone.
template <bool Finite>
struct MixedMotion {
  Motion particle;
  std::array<Motion, fpm::subpoint_count> sub;
  std::array<fpm::Vector<2>, fpm::subpoint_count> offset;       // xi_k
  std::array<fpm::Tensor<2>, fpm::subpoint_count> inverse_now;  // F_k^-1
  fpm::Tensor<2> particle_inverse_now;
  double volume = 0.0;
  bool admissible = true;

  MixedMotion(const ParticleStart<2>& start, const ParticleIncrement<2>& increment) {
    volume = start.reference_volume;
    admissible =
        follow(start.gradient, increment.gradient, particle, particle_inverse_now, &volume);
    for (std::size_t k = 0; k < fpm::subpoint_count && admissible; ++k) {
      offset[k] = fpm::subpoint_offset(k, start.reference_volume);
      const fpm::Tensor<2> change =
          increment.gradient + fpm::second_gradient_at(increment.second_gradient, offset[k]);
      if constexpr (Finite) {
        const fpm::Tensor<2> begin =
            start.gradient + fpm::second_gradient_at(start.second_gradient, offset[k]);
        admissible = follow(begin, change, sub[k], inverse_now[k], nullptr);
      } else {
        admissible = follow(start.gradient, change, sub[k], inverse_now[k], nullptr);
      }
    }
  }

  /// Deviatoric tensor components (xx yy zz xy) of a sub-point's strain, its in-plane dilation
  /// replaced by the particle's.
  static constitutive::StressVector<2> deviatoric(const fpm::Tensor<2>& sub_strain,
                                                  double dilation) {
    const double difference = 0.5 * (sub_strain(0, 0) - sub_strain(1, 1));
    return {difference + dilation / 6.0, -difference + dilation / 6.0, -dilation / 3.0,
            sub_strain(0, 1)};
  }

 private:
  static bool follow(const fpm::Tensor<2>& start, const fpm::Tensor<2>& change, Motion& motion,
                     fpm::Tensor<2>& inverse_now, double* volume) {
    if constexpr (Finite) {
      const CurrentGradient<2> now(start, change);
      inverse_now = now.inverse;
      motion = constitutive::objective_increment<2>(change, fpm::Tensor<2>(start + 0.5 * change));
      if (volume != nullptr) *volume *= now.determinant;
      return now.admissible() && motion.is_admissible();
    } else {
      motion.gradient = change;
      motion.strain = symmetric<2>(change);
      motion.rotation.setIdentity();
      inverse_now.setIdentity();
      return true;
    }
  }
};

template <bool Finite, class Material>
Trial mixed_trial(const Material& material, const ParticleStart<2>& start,
                  const MixedMotion<Finite>& motion) {
  using namespace constitutive;
  const double dilation = motion.particle.strain.trace();
  Trial trial;
  trial.pressure = mean_stress(start.point.stress) + material.moduli.bulk * dilation;
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const Eigen::Map<const StressVector<2>> begin(start.deviator + k * stress_size<2>);
    const StressVector<2> strain = MixedMotion<Finite>::deviatoric(motion.sub[k].strain, dilation);
    if constexpr (Finite) {
      trial.deviator[k] =
          rotate(begin, motion.sub[k].rotation) + 2.0 * material.moduli.shear * strain;
    } else {
      trial.deviator[k] = begin + 2.0 * material.moduli.shear * strain;
    }
  }
  return trial;
}

/// The in-plane deviator of a deviatoric stress vector.
inline fpm::Tensor<2> plane_deviator(const constitutive::StressVector<2>& s) {
  const double half_difference = 0.5 * (s[0] - s[1]);
  fpm::Tensor<2> a;
  a << half_difference, s[3], s[3], -half_difference;
  return a;
}

}  // namespace detail

template <bool Finite>
template <class Material>
void MixedLaw<Finite>::respond(const Material& material, const ParticleStart<2>& start,
                               const ParticleIncrement<2>& increment,
                               ParticleResponse<2>& response) {
  using namespace constitutive;
  response.admissible = false;
  const detail::MixedMotion<Finite> motion(start, increment);
  if (!motion.admissible) return;
  const detail::Trial trial = detail::mixed_trial(material, start, motion);
  const auto result =
      mixed_return(material, trial, fpm::subpoint_weights, start.point.plastic_volume_strain);
  if (result.status == UpdateStatus::failed) return;

  StressVector<2> mean = isotropic<2>(result.pressure);
  double spherical = result.pressure;
  fpm::Tensor<2> nominal = fpm::Tensor<2>::Zero();
  response.second_stress.setZero();
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const double share = fpm::subpoint_weights[k];
    const StressVector<2>& s = result.deviator[k];
    mean += share * s;
    spherical += 0.5 * share * (s[0] + s[1]);
    const fpm::Tensor<2> own =
        (motion.volume * share) * detail::plane_deviator(s) * motion.inverse_now[k].transpose();
    nominal += own;
    fpm::add_second_stress(own, motion.offset[k], response.second_stress);
  }
  response.nominal =
      nominal + (motion.volume * spherical) * motion.particle_inverse_now.transpose();
  response.rotation = motion.particle.rotation;
  response.deviator = result.deviator;
  response.point = start.point;
  response.point.stress = mean;
  response.point.plastic_strain += result.plastic_strain_increment;
  if (result.plastic) response.point.plastic_volume_strain += result.plastic_volume_increment;
  response.plastic_increment = result.plastic_strain_increment;
  response.plastic = result.plastic;
  response.admissible = true;
}

namespace detail {

/// Changes along one direction (gradient, second gradient) of a particle's increment.
struct MixedDirection {
  fpm::Tensor<2> gradient;
  std::array<fpm::Tensor<2>, fpm::subpoint_count> sub;  // at the sub-points
  fpm::Tensor<2> rotation;                              // dQ of the particle
  Trial trial;                                          // of the trial stress
};

template <bool Finite, class Material>
MixedDirection differentiate_trial(const Material& material, const ParticleStart<2>& start,
                                   const MixedMotion<Finite>& motion,
                                   const fpm::Tensor<2>& gradient,
                                   const fpm::SecondGradient& second) {
  using namespace constitutive;
  MixedDirection d;
  d.gradient = gradient;
  fpm::Tensor<2> strain = symmetric<2>(gradient);
  d.rotation.setZero();
  if constexpr (Finite) {
    const auto particle = derivative<2>(motion.particle, gradient);
    strain = particle.strain;
    d.rotation = particle.rotation;
  }
  const double dilation = strain.trace();
  const double twice_shear = 2.0 * material.moduli.shear;
  d.trial.pressure = material.moduli.bulk * dilation;
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    d.sub[k] = gradient + fpm::second_gradient_at(second, motion.offset[k]);
    if constexpr (Finite) {
      const auto sub = derivative<2>(motion.sub[k], d.sub[k]);
      const Eigen::Map<const StressVector<2>> begin(start.deviator + k * stress_size<2>);
      d.trial.deviator[k] = rotate_derivative<2>(begin, motion.sub[k].rotation, sub.rotation) +
                            twice_shear * MixedMotion<Finite>::deviatoric(sub.strain, dilation);
    } else {
      d.trial.deviator[k] =
          twice_shear * MixedMotion<Finite>::deviatoric(symmetric<2>(d.sub[k]), dilation);
    }
  }
  return d;
}

/// Product rule over volume, stress and inverse gradients: (dP, dT) of a stress change.
template <bool Finite>
Eigen::Matrix<double, 10, 1> differentiate_forces(
    const MixedMotion<Finite>& motion, const constitutive::MixedResult<fpm::subpoint_count>& stress,
    const Trial& change, const MixedDirection& d) {
  using fpm::Tensor;
  const double log_volume = Finite ? (motion.particle_inverse_now * d.gradient).trace() : 0.0;
  double spherical = stress.pressure;
  double d_spherical = change.pressure;
  Tensor<2> nominal = Tensor<2>::Zero();
  fpm::SecondGradient second = fpm::SecondGradient::Zero();
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const double share = fpm::subpoint_weights[k];
    spherical += 0.5 * share * (stress.deviator[k][0] + stress.deviator[k][1]);
    d_spherical += 0.5 * share * (change.deviator[k][0] + change.deviator[k][1]);
    const Tensor<2> inverse_t = motion.inverse_now[k].transpose();
    Tensor<2> own = plane_deviator(change.deviator[k]) * inverse_t;
    if constexpr (Finite) {
      const Tensor<2> base = plane_deviator(stress.deviator[k]) * inverse_t;
      own += log_volume * base - base * d.sub[k].transpose() * inverse_t;
    }
    own *= motion.volume * share;
    nominal += own;
    fpm::add_second_stress(own, motion.offset[k], second);
  }
  const Tensor<2> inverse_t = motion.particle_inverse_now.transpose();
  Tensor<2> sphere = d_spherical * inverse_t;
  if constexpr (Finite) {
    sphere += spherical * (log_volume * inverse_t - inverse_t * d.gradient.transpose() * inverse_t);
  }
  nominal += motion.volume * sphere;
  Eigen::Matrix<double, 10, 1> forces;
  forces << flat(nominal), flat(second);
  return forces;
}

}  // namespace detail

template <bool Finite>
template <class Material>
bool MixedLaw<Finite>::linearise(const Material& material, const ParticleStart<2>& start,
                                 const ParticleIncrement<2>& increment,
                                 ParticleTangent<2, true>& tangent) {
  const detail::MixedMotion<Finite> motion(start, increment);
  if (!motion.admissible) return false;
  const detail::Trial trial = detail::mixed_trial(material, start, motion);
  const double plastic_volume = start.point.plastic_volume_strain;
  const auto stress =
      constitutive::mixed_return(material, trial, fpm::subpoint_weights, plastic_volume);
  if (stress.status == constitutive::UpdateStatus::failed) return false;
  const auto on_trial =
      constitutive::mixed_tangent(material, trial, fpm::subpoint_weights, plastic_volume, stress);
  constexpr int size = generalised_size<2, true>;
  for (int column = 0; column < size; ++column) {
    const auto unit = detail::unit<Eigen::Matrix<double, size, 1>>(column);
    const fpm::Tensor<2> gradient = Eigen::Map<const fpm::Tensor<2>>(unit.data());
    const fpm::SecondGradient second = Eigen::Map<const fpm::SecondGradient>(unit.data() + 4);
    const auto d = detail::differentiate_trial(material, start, motion, gradient, second);
    detail::Trial change;
    on_trial.apply_to_trial(d.trial, change);
    tangent.stress.col(column) = detail::differentiate_forces(motion, stress, change, d);
    if (column < 4) tangent.rotation.col(column) = detail::flat(d.rotation);
  }
  return true;
}

}  // namespace wiring

#pragma once

#include "constitutive/mixed_mohr_coulomb.hpp"
#include "equilibrium/local_response.hpp"

namespace equilibrium {

/// Mixed sub-point integration: one pressure per particle, four deviators.
///
/// Each sub-point has its own finite motion dF_k = F_k F_k(n)^-1 of the Taylor field, so a rigid
/// rotation of a bent body strains nothing; its dilation (in plane strain that in the plane) is
/// left to the particle's, which leaves as many unknowns per dilation constraint as there are
/// dimensions, as collapse needs. Forces are work-conjugate. In plane strain, with A = dev2 s_k the
/// in-plane deviator of s_k and tr2 its in-plane trace,
///   P = V ((p + sum w tr2(s_k) / 2) F^-T + sum w A_k F_k^-T),  T = V sum w (A_k F_k^-T) x xi_k;
/// in space A = s_k and tr2 is 0.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mixed-subpoints.md).
template <int Dim, bool Finite>
struct MixedLaw {
  static constexpr bool mixed = true;
  template <class Material, class Real>
  static void respond(const Material& material, const ParticleStart<Dim, Real>& start,
                      const ParticleIncrement<Dim, Real>& increment,
                      ParticleResponse<Dim, Real>& response);
  template <class Material, class Real>
  static constitutive::Mask<Real> linearise(const Material& material,
                                            const ParticleStart<Dim, Real>& start,
                                            const ParticleIncrement<Dim, Real>& increment,
                                            ParticleTangent<Dim, true, Real>& tangent);
};

namespace detail {

template <int Dim, class Real>
using MixedTrial = constitutive::MixedTrial<fpm::subpoint_count, Dim, Real>;

/// Motion of a particle and of its sub-points; in small strain the gradients alone.
template <int Dim, bool Finite, class Real>
struct MixedMotion {
  using Motion = constitutive::ObjectiveIncrement<Dim, Real>;
  using Tensor = fpm::Tensor<Dim, Real>;

  Motion particle;
  std::array<Motion, fpm::subpoint_count> sub;
  std::array<fpm::Vector<Dim, Real>, fpm::subpoint_count> offset;  // xi_k
  std::array<Tensor, fpm::subpoint_count> inverse_now;             // F_k^-1
  Tensor particle_inverse_now;
  Real volume;
  constitutive::Mask<Real> admissible;

  MixedMotion(const ParticleStart<Dim, Real>& start,
              const ParticleIncrement<Dim, Real>& increment) {
    Real ratio = 1.0;
    admissible = follow(start.gradient, increment.gradient, particle, particle_inverse_now, ratio);
    volume = start.reference_volume * ratio;
    for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
      offset[k] = fpm::subpoint_offset<Dim>(k, start.reference_volume);
      const Tensor change =
          increment.gradient + fpm::second_gradient_at<Dim>(increment.second_gradient, offset[k]);
      Tensor begin = start.gradient;
      if constexpr (Finite) begin += fpm::second_gradient_at<Dim>(start.second_gradient, offset[k]);
      admissible = admissible & follow(begin, change, sub[k], inverse_now[k], ratio);
    }
  }

  /// Deviatoric tensor components of a sub-point's strain; in the plane its dilation is replaced by
  /// the particle's, as out of the plane there is no strain to make up for it.
  static constitutive::StressVector<Dim, Real> deviatoric(const Tensor& sub_strain,
                                                          const Real& dilation) {
    if constexpr (Dim == 2) {
      const Real difference = 0.5 * (sub_strain(0, 0) - sub_strain(1, 1));
      const Real sixth = dilation / 6.0;
      return {difference + sixth, sixth - difference, -2.0 * sixth, sub_strain(0, 1)};
    } else {
      const Real third = sub_strain.trace() / 3.0;
      return {sub_strain(0, 0) - third, sub_strain(1, 1) - third, sub_strain(2, 2) - third,
              sub_strain(0, 1),         sub_strain(1, 2),         sub_strain(2, 0)};
    }
  }

 private:
  static constitutive::Mask<Real> follow(const Tensor& start, const Tensor& change, Motion& motion,
                                         Tensor& inverse_now, Real& volume_ratio) {
    if constexpr (Finite) {
      const CurrentGradient<Dim, Real> now(start, change);
      inverse_now = now.inverse;
      motion = constitutive::objective_increment(change, midpoint(start, change));
      volume_ratio = now.determinant;
      return now.admissible() & motion.is_admissible();
    } else {
      motion.gradient = change;
      motion.strain = symmetric(change);
      motion.rotation.setIdentity();
      inverse_now.setIdentity();
      return Real(0.0) < Real(1.0);
    }
  }
};

template <int Dim, bool Finite, class Material, class Real>
MixedTrial<Dim, Real> mixed_trial(const Material& material, const ParticleStart<Dim, Real>& start,
                                  const MixedMotion<Dim, Finite, Real>& motion) {
  using namespace constitutive;
  const Real dilation = motion.particle.strain.trace();
  const Real twice_shear = 2.0 * material.moduli.shear;
  MixedTrial<Dim, Real> trial;
  trial.pressure = mean_stress(start.point.stress) + material.moduli.bulk * dilation;
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    trial.deviator[k] =
        twice_shear * MixedMotion<Dim, Finite, Real>::deviatoric(motion.sub[k].strain, dilation);
    if constexpr (Finite) {
      trial.deviator[k] += rotate(start.deviator[k], motion.sub[k].rotation);
    } else {
      trial.deviator[k] += start.deviator[k];
    }
  }
  return trial;
}

/// The part of a deviatoric stress that works on the sub-points' own gradients: in the plane its
/// deviator there.
template <int Dim, class Real>
fpm::Tensor<Dim, Real> own_part(const constitutive::StressVector<Dim, Real>& s) {
  if constexpr (Dim == 2) {
    const Real half_difference = 0.5 * (s[0] - s[1]);
    fpm::Tensor<2, Real> a;
    a << half_difference, s[3], s[3], -half_difference;
    return a;
  } else {
    return constitutive::spatial_part<3>(s);
  }
}

/// The rest, which works on the particle's dilation: half the trace in the plane, nothing in space.
template <int Dim, class Real>
Real spherical_part(const constitutive::StressVector<Dim, Real>& s) {
  if constexpr (Dim == 2) return 0.5 * (s[0] + s[1]);
  return Real(0.0);
}

}  // namespace detail

template <int Dim, bool Finite>
template <class Material, class Real>
void MixedLaw<Dim, Finite>::respond(const Material& material, const ParticleStart<Dim, Real>& start,
                                    const ParticleIncrement<Dim, Real>& increment,
                                    ParticleResponse<Dim, Real>& response) {
  using namespace constitutive;
  using constitutive::select;
  const detail::MixedMotion<Dim, Finite, Real> motion(start, increment);
  const auto trial = detail::mixed_trial(material, start, motion);
  const auto result =
      mixed_return(material, trial, fpm::subpoint_weights, start.point.plastic_volume_strain);

  StressVector<Dim, Real> mean = isotropic<Dim>(result.pressure);
  Real spherical = result.pressure;
  fpm::Tensor<Dim, Real> nominal = fpm::Tensor<Dim, Real>::Zero();
  response.second_stress.setZero();
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const Real share = fpm::subpoint_weights[k];
    const StressVector<Dim, Real>& s = result.deviator[k];
    mean += share * s;
    spherical += share * detail::spherical_part<Dim>(s);
    const fpm::Tensor<Dim, Real> own =
        (motion.volume * share) * detail::own_part<Dim>(s) * motion.inverse_now[k].transpose();
    nominal += own;
    fpm::add_second_stress<Dim>(own, motion.offset[k], response.second_stress);
  }
  response.nominal =
      nominal + (motion.volume * spherical) * motion.particle_inverse_now.transpose();
  response.rotation = motion.particle.rotation;
  response.deviator = result.deviator;
  response.plastic = result.outcome.plastic;
  response.plastic_increment = result.plastic_strain_increment;
  response.point.stress = mean;
  response.point.plastic_strain = start.point.plastic_strain + result.plastic_strain_increment;
  response.point.plastic_volume_strain =
      start.point.plastic_volume_strain +
      select(response.plastic, result.plastic_volume_increment, 0.0);
  response.admissible = motion.admissible & !result.outcome.failed;
}

namespace detail {

/// Changes along one direction (gradient, second gradient) of a particle's increment.
template <int Dim, class Real>
struct MixedDirection {
  fpm::Tensor<Dim, Real> gradient;
  std::array<fpm::Tensor<Dim, Real>, fpm::subpoint_count> sub;  // at the sub-points
  fpm::Tensor<Dim, Real> rotation;                              // dQ of the particle
  MixedTrial<Dim, Real> trial;                                  // of the trial stress
};

template <int Dim, bool Finite, class Material, class Real>
MixedDirection<Dim, Real> differentiate_trial(const Material& material,
                                              const ParticleStart<Dim, Real>& start,
                                              const MixedMotion<Dim, Finite, Real>& motion,
                                              const fpm::Tensor<Dim, Real>& gradient,
                                              const fpm::SecondGradient<Dim, Real>& second) {
  using namespace constitutive;
  using Motion = MixedMotion<Dim, Finite, Real>;
  MixedDirection<Dim, Real> d;
  d.gradient = gradient;
  fpm::Tensor<Dim, Real> strain = symmetric(gradient);
  d.rotation.setZero();
  if constexpr (Finite) {
    const auto particle = derivative(motion.particle, gradient);
    strain = particle.strain;
    d.rotation = particle.rotation;
  }
  const Real dilation = strain.trace();
  const Real twice_shear = 2.0 * material.moduli.shear;
  d.trial.pressure = material.moduli.bulk * dilation;
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    d.sub[k] = gradient + fpm::second_gradient_at<Dim>(second, motion.offset[k]);
    if constexpr (Finite) {
      const auto sub = derivative(motion.sub[k], d.sub[k]);
      d.trial.deviator[k] =
          rotate_derivative<Dim>(start.deviator[k], motion.sub[k].rotation, sub.rotation) +
          twice_shear * Motion::deviatoric(sub.strain, dilation);
    } else {
      d.trial.deviator[k] = twice_shear * Motion::deviatoric(symmetric(d.sub[k]), dilation);
    }
  }
  return d;
}

/// Product rule over volume, stress and inverse gradients: (dP, dT) of a stress change.
template <int Dim, bool Finite, class Real>
Eigen::Matrix<Real, generalised_size<Dim, true>, 1> differentiate_forces(
    const MixedMotion<Dim, Finite, Real>& motion,
    const constitutive::MixedResult<fpm::subpoint_count, Dim, Real>& stress,
    const MixedTrial<Dim, Real>& change, const MixedDirection<Dim, Real>& d) {
  using Tensor = fpm::Tensor<Dim, Real>;
  const Real log_volume = Finite ? (motion.particle_inverse_now * d.gradient).trace() : Real(0.0);
  Real spherical = stress.pressure;
  Real d_spherical = change.pressure;
  Tensor nominal = Tensor::Zero();
  fpm::SecondGradient<Dim, Real> second = fpm::SecondGradient<Dim, Real>::Zero();
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const Real share = fpm::subpoint_weights[k];
    spherical += share * spherical_part<Dim>(stress.deviator[k]);
    d_spherical += share * spherical_part<Dim>(change.deviator[k]);
    const Tensor inverse_t = motion.inverse_now[k].transpose();
    Tensor own = own_part<Dim>(change.deviator[k]) * inverse_t;
    if constexpr (Finite) {
      const Tensor base = own_part<Dim>(stress.deviator[k]) * inverse_t;
      own += log_volume * base - base * d.sub[k].transpose() * inverse_t;
    }
    own *= motion.volume * share;
    nominal += own;
    fpm::add_second_stress<Dim>(own, motion.offset[k], second);
  }
  const Tensor inverse_t = motion.particle_inverse_now.transpose();
  Tensor sphere = d_spherical * inverse_t;
  if constexpr (Finite) {
    sphere += spherical * (log_volume * inverse_t - inverse_t * d.gradient.transpose() * inverse_t);
  }
  nominal += motion.volume * sphere;
  Eigen::Matrix<Real, generalised_size<Dim, true>, 1> forces;
  forces << flat(nominal), flat(second);
  return forces;
}

}  // namespace detail

template <int Dim, bool Finite>
template <class Material, class Real>
constitutive::Mask<Real> MixedLaw<Dim, Finite>::linearise(
    const Material& material, const ParticleStart<Dim, Real>& start,
    const ParticleIncrement<Dim, Real>& increment, ParticleTangent<Dim, true, Real>& tangent) {
  using Generalised = Eigen::Matrix<Real, generalised_size<Dim, true>, 1>;
  const detail::MixedMotion<Dim, Finite, Real> motion(start, increment);
  const auto trial = detail::mixed_trial(material, start, motion);
  const Real& plastic_volume = start.point.plastic_volume_strain;
  const auto stress =
      constitutive::mixed_return(material, trial, fpm::subpoint_weights, plastic_volume);
  const auto on_trial =
      constitutive::mixed_tangent(material, trial, fpm::subpoint_weights, plastic_volume, stress);
  for (int column = 0; column < Generalised::SizeAtCompileTime; ++column) {
    const auto unit = detail::unit<Generalised>(column);
    const fpm::Tensor<Dim, Real> gradient = Eigen::Map<const fpm::Tensor<Dim, Real>>(unit.data());
    const fpm::SecondGradient<Dim, Real> second =
        Eigen::Map<const fpm::SecondGradient<Dim, Real>>(unit.data() + Dim * Dim);
    const auto d = detail::differentiate_trial(material, start, motion, gradient, second);
    detail::MixedTrial<Dim, Real> change;
    on_trial.apply_to_trial(d.trial, change);
    tangent.stress.col(column) = detail::differentiate_forces(motion, stress, change, d);
    if (column < Dim * Dim) tangent.rotation.col(column) = detail::flat(d.rotation);
  }
  return motion.admissible & !stress.outcome.failed;
}

}  // namespace equilibrium

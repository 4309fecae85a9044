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

template <bool Finite>
template <class Material>
bool MixedLaw<Finite>::linearise(const Material& material, const ParticleStart<2>& start,
                                 const ParticleIncrement<2>& increment,
                                 ParticleTangent<2, true>& tangent) {
  using namespace constitutive;
  using fpm::Tensor;
  const detail::MixedMotion<Finite> motion(start, increment);
  if (!motion.admissible) return false;
  const detail::Trial trial = detail::mixed_trial(material, start, motion);
  const double plastic_volume = start.point.plastic_volume_strain;
  const auto result = mixed_return(material, trial, fpm::subpoint_weights, plastic_volume);
  if (result.status == UpdateStatus::failed) return false;
  const auto on_trial =
      mixed_tangent(material, trial, fpm::subpoint_weights, plastic_volume, result);

  constexpr int size = generalised_size<2, true>;
  for (int column = 0; column < size; ++column) {
    const auto direction = detail::unit<Eigen::Matrix<double, size, 1>>(column);
    const Eigen::Map<const Tensor<2>> d_gradient(direction.data());
    const Eigen::Map<const fpm::SecondGradient> d_second(direction.data() + 4);

    // Trial stress along this direction.
    detail::Trial d_trial;
    const auto particle = [&] {
      ObjectiveDerivative<2> d;
      if constexpr (Finite) {
        d = derivative<2>(motion.particle, Tensor<2>(d_gradient));
      } else {
        d.strain = detail::symmetric<2>(d_gradient);
        d.rotation.setZero();
      }
      return d;
    }();
    const double dilation = particle.strain.trace();
    d_trial.pressure = material.moduli.bulk * dilation;
    std::array<Tensor<2>, fpm::subpoint_count> d_sub;
    for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
      d_sub[k] = d_gradient + fpm::second_gradient_at(d_second, motion.offset[k]);
      if constexpr (Finite) {
        const auto d = derivative<2>(motion.sub[k], d_sub[k]);
        const Eigen::Map<const StressVector<2>> begin(start.deviator + k * stress_size<2>);
        d_trial.deviator[k] = rotate_derivative<2>(begin, motion.sub[k].rotation, d.rotation) +
                              2.0 * material.moduli.shear *
                                  detail::MixedMotion<Finite>::deviatoric(d.strain, dilation);
      } else {
        d_trial.deviator[k] =
            2.0 * material.moduli.shear *
            detail::MixedMotion<Finite>::deviatoric(detail::symmetric<2>(d_sub[k]), dilation);
      }
    }
    on_trial.apply_to_trial(d_trial, d_trial);

    // Product rule over volume, stress and inverse gradients.
    const double d_log_volume = Finite ? (motion.particle_inverse_now * d_gradient).trace() : 0.0;
    double spherical = result.pressure;
    double d_spherical = d_trial.pressure;
    Tensor<2> d_nominal = Tensor<2>::Zero();
    fpm::SecondGradient d_second_stress = fpm::SecondGradient::Zero();
    for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
      const double share = fpm::subpoint_weights[k];
      const StressVector<2>& s = result.deviator[k];
      const StressVector<2>& ds = d_trial.deviator[k];
      spherical += 0.5 * share * (s[0] + s[1]);
      d_spherical += 0.5 * share * (ds[0] + ds[1]);
      const Tensor<2> inverse_t = motion.inverse_now[k].transpose();
      Tensor<2> d_own = detail::plane_deviator(ds) * inverse_t;
      if constexpr (Finite) {
        const Tensor<2> own = detail::plane_deviator(s) * inverse_t;
        d_own += d_log_volume * own - own * d_sub[k].transpose() * inverse_t;
      }
      d_own *= motion.volume * share;
      d_nominal += d_own;
      fpm::add_second_stress(d_own, motion.offset[k], d_second_stress);
    }
    const Tensor<2> inverse_t = motion.particle_inverse_now.transpose();
    Tensor<2> d_sphere = d_spherical * inverse_t;
    if constexpr (Finite) {
      d_sphere +=
          spherical * (d_log_volume * inverse_t - inverse_t * d_gradient.transpose() * inverse_t);
    }
    d_nominal += motion.volume * d_sphere;
    tangent.stress.template block<4, 1>(0, column) = detail::flat(d_nominal);
    tangent.stress.template block<6, 1>(4, column) = detail::flat(d_second_stress);
    if (column < 4) tangent.rotation.col(column) = detail::flat(particle.rotation);
  }
  return true;
}

}  // namespace wiring

#pragma once

#include <array>

#include "constitutive/cone_update.hpp"
#include "constitutive/material.hpp"
#include "constitutive/mixed.hpp"
#include "constitutive/objective.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/types.hpp"
#include "wiring/state.hpp"

/// One particle between kinematics and stress: here, and only here, strain increments of libfpm
/// meet the stress updates of libconstitutive.
namespace wiring {

/// A particle at the beginning of a step.
template <int Dim>
struct ParticleStart {
  fpm::Tensor<Dim> gradient;            // F_a(n); identity in small strain
  fpm::SecondGradient second_gradient;  // H_a(n), total; with sub-points only
  double reference_volume = 0.0;        // Vref
  constitutive::PointState<Dim> point;
  const double* deviator = nullptr;  // 4 x 4, with sub-points only
};

/// The increments the row's neighbourhood gives it.
template <int Dim>
struct ParticleIncrement {
  fpm::Tensor<Dim> gradient;            // sum du x G
  fpm::SecondGradient second_gradient;  // sum du x h; with sub-points only
};

/// What comes out: nominal stresses for the forces, and the end-of-step point.
template <int Dim>
struct ParticleResponse {
  bool admissible = false;            // false: inverted or not finite, everything else is void
  fpm::Tensor<Dim> nominal;           // P_a = V sigma F^-T, volume included
  fpm::SecondGradient second_stress;  // T_a, conjugate to H; with sub-points only
  fpm::Tensor<Dim> rotation;          // Q of the step
  constitutive::PointState<Dim> point;
  std::array<constitutive::StressVector<2>, fpm::subpoint_count> deviator;
  double plastic_increment = 0.0;
  bool plastic = false;
};

/// Number of generalised strains: gradient, and with sub-points the second gradient.
template <int Dim, bool Mixed>
inline constexpr int generalised_size = Dim* Dim + (Mixed ? 2 * 3 : 0);

/// d(P, T) / d(gradient, second gradient), both column-major, and dQ / d(gradient).
template <int Dim, bool Mixed>
struct ParticleTangent {
  Eigen::Matrix<double, generalised_size<Dim, Mixed>, generalised_size<Dim, Mixed>> stress;
  Eigen::Matrix<double, Dim * Dim, Dim * Dim> rotation;
};

/// Ordinary nodal integration: one stress per particle.
template <int Dim, bool Finite>
struct PlainLaw {
  template <class Material>
  static void respond(const Material& material, const ParticleStart<Dim>& start,
                      const ParticleIncrement<Dim>& increment, ParticleResponse<Dim>& response);
  template <class Material>
  static bool linearise(const Material& material, const ParticleStart<Dim>& start,
                        const ParticleIncrement<Dim>& increment,
                        ParticleTangent<Dim, false>& tangent);
};

/// Mixed sub-point integration in plane strain: one pressure per particle, four deviators.
/// Each sub-point has its own finite motion dF_k = F_k F_k(n)^-1 of the Taylor field, so a rigid
/// rotation of a bent body strains nothing; its in-plane dilation is replaced by the particle's.
template <bool Finite>
struct MixedLaw {
  template <class Material>
  static void respond(const Material& material, const ParticleStart<2>& start,
                      const ParticleIncrement<2>& increment, ParticleResponse<2>& response);
  template <class Material>
  static bool linearise(const Material& material, const ParticleStart<2>& start,
                        const ParticleIncrement<2>& increment, ParticleTangent<2, true>& tangent);
};

}  // namespace wiring

#include "wiring/local_response_mixed.ipp"
#include "wiring/local_response_plain.ipp"

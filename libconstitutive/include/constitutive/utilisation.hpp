#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "constitutive/material.hpp"
#include "constitutive/spectral.hpp"

namespace constitutive {

namespace detail {

/// Beyond the apex there is no strength, and nothing is borne that it could be compared with.
inline double share_of_strength(double shear, double strength) {
  return strength > 0 ? shear / strength : 1;
}

}  // namespace detail

/// How much of its shear strength a stress takes: sqrt(J2) over the cone's radius at its mean
/// stress. 1 on the yield surface and at its apex; a tension cut-off does not count.
template <int Dim, ConeMaterial M>
double utilisation(const M& material, const std::type_identity_t<StressVector<Dim>>& stress,
                   double plastic_volume_strain, double /*plastic_strain*/) {
  const Cone cone = yield_cone<double>(material, plastic_volume_strain);
  return detail::share_of_strength(std::sqrt(j2(stress)), cone.radius(mean_stress(stress)));
}

/// The same under its cut-off.
template <int Dim>
double utilisation(const CutCone& material, const std::type_identity_t<StressVector<Dim>>& stress,
                   double plastic_volume_strain, double plastic_strain) {
  return utilisation<Dim>(material.soil, stress, plastic_volume_strain, plastic_strain);
}

/// Half the largest difference of principal stresses over c cos phi - sin phi times their mean.
template <int Dim>
double utilisation(const MohrCoulomb& material,
                   const std::type_identity_t<StressVector<Dim>>& stress,
                   double /*plastic_volume_strain*/, double /*plastic_strain*/) {
  const Eigen::Vector3d principal = spectrum(stress).values;
  const double shear = (principal[0] - principal[2]) / 2;
  const double mean = (principal[0] + principal[2]) / 2;
  return detail::share_of_strength(
      shear, material.cohesion * material.cos_friction - mean * material.sin_friction);
}

/// With the strength at the plastic strain.
template <int Dim>
double utilisation(const HardeningSoil& material,
                   const std::type_identity_t<StressVector<Dim>>& stress,
                   double plastic_volume_strain, double plastic_strain) {
  const detail::Strength now(material, plastic_strain);
  if (material.surface == HardeningSoil::Surface::pyramid) {
    const MohrCoulomb base{.moduli = material.moduli,
                           .cohesion = now.cohesion,
                           .sin_friction = std::sin(now.friction),
                           .cos_friction = std::cos(now.friction)};
    return utilisation<Dim>(base, stress, plastic_volume_strain, plastic_strain);
  }
  const double psi = plastic_volume_strain >= material.dilation_cutoff ? 0 : material.dilation;
  const Cone cone = detail::cone_change(material.surface, now, psi).cone;
  return detail::share_of_strength(std::sqrt(j2(stress)), cone.radius(mean_stress(stress)));
}

/// q over that of the ellipse at the same mean stress.
template <int Dim>
double utilisation(const ModifiedCamClay& material,
                   const std::type_identity_t<StressVector<Dim>>& stress,
                   double plastic_volume_strain, double /*plastic_strain*/) {
  const double p = -mean_stress(stress);
  const double room = p * (material.preconsolidation_at(plastic_volume_strain) - p);
  return detail::share_of_strength(std::sqrt(3 * j2(stress)),
                                   material.slope * std::sqrt(std::max(0.0, room)));
}

/// Half the largest difference of principal stresses over that of the envelope at the same mean of
/// the two.
template <int Dim>
double utilisation(const CurvedEnvelope& material,
                   const std::type_identity_t<StressVector<Dim>>& stress,
                   double /*plastic_volume_strain*/, double /*plastic_strain*/) {
  const Eigen::Vector3d principal = spectrum(stress).values;
  const double shear = (principal[0] - principal[2]) / 2;
  const double centre = -(principal[0] + principal[2]) / 2;
  return detail::share_of_strength(shear, detail::curved_radius(material, centre));
}

/// What does not yield has no strength to use up: 0.
template <int Dim>
double utilisation(const Elastic&, const std::type_identity_t<StressVector<Dim>>&,
                   double /*plastic_volume_strain*/, double /*plastic_strain*/) {
  return 0;
}

/// That of whichever material is held, at the point's accumulated plastic strains; for single
/// points.
template <int Dim>
double utilisation(const Material& material, const std::type_identity_t<StressVector<Dim>>& stress,
                   double plastic_volume_strain, double plastic_strain) {
  return std::visit(
      [&](const auto& m) {
        return utilisation<Dim>(m, stress, plastic_volume_strain, plastic_strain);
      },
      material);
}

}  // namespace constitutive

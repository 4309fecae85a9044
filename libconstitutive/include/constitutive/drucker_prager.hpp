#pragma once

#include <array>
#include <concepts>
#include <limits>
#include <optional>
#include <type_traits>

#include "constitutive/cone.hpp"
#include "constitutive/elastic.hpp"

namespace constitutive {

/// Pressure-independent perfect plasticity, sqrt(J2) = strength.
///
/// With strength = c this equals Tresca's criterion of undrained shear strength c (phi = 0) at
/// collapse in plane strain; in three dimensions it is the von Mises cylinder of shear strength c.
struct VonMises {
  static constexpr std::array<ModelInfo, 1> models{
      {{.name = "von_mises", .doc = "undrained clay, strength = cohesion", .one_pressure = true}}};

  ElasticModuli moduli;
  double strength = 0;  ///< Shear strength [Pa], > 0.

  static VonMises make(const MaterialParameters& p, const ModelInfo&) {
    return {elastic_moduli(p.youngs_modulus, p.poissons_ratio), p.cohesion};
  }
};

/// Drucker-Prager, non-associated and perfectly plastic, with apex and dilation cut-off.
struct DruckerPrager {
  static constexpr std::array<ModelInfo, 2> models{
      {{.name = "drucker_prager",
        .doc = "cone matched to Mohr-Coulomb",
        .family = "drucker_prager",
        .match = "plane_strain",
        .frictional = true,
        .one_pressure = true,
        .only_plane_strain = "the plane strain match holds in 2D only: use match = "
                             "\"compression_cone\" or model = \"mohr_coulomb\""},
       {.name = "drucker_prager_compression",
        .family = "drucker_prager",
        .match = "compression_cone",
        .frictional = true,
        .one_pressure = true}}};

  ElasticModuli moduli;
  Cone cone;  ///< By `plane_strain_cone` or `compression_cone`.
  /// No dilation (beta = 0) in a step that begins with plastic_volume_strain >= this [-]; off at
  /// infinity. Being judged at the beginning of the step, it may be overshot by one step's
  /// dilation.
  double dilation_cutoff = std::numeric_limits<double>::infinity();

  /// The cone of a step without dilation; absent: `cone` with beta = 0. A match that depends on
  /// psi (plane strain) has another one, or the strength would fall with the dilation.
  std::optional<Cone> cut_off;

  static DruckerPrager make(const MaterialParameters& p, const ModelInfo& model) {
    const auto cone = model.match == "plane_strain" ? plane_strain_cone : compression_cone;
    const double phi = radians(p.friction_angle);
    return {elastic_moduli(p.youngs_modulus, p.poissons_ratio),
            cone(p.cohesion, phi, radians(p.dilation_angle)), p.dilation_cutoff,
            cone(p.cohesion, phi, 0.0)};
  }
};

/// The cylinder of `VonMises`, whatever the plastic volume strain.
template <class Real = double>
BasicCone<Real> yield_cone(const VonMises& m,
                           const std::type_identity_t<Real>& /*plastic_volume_strain*/) {
  return {.alpha = 0, .beta = 0, .strength = m.strength};
}

/// The cone of `DruckerPrager` in a step that begins with this plastic volume strain.
template <class Real = double>
BasicCone<Real> yield_cone(const DruckerPrager& m,
                           const std::type_identity_t<Real>& plastic_volume_strain) {
  const Mask<Real> off = plastic_volume_strain >= Real(m.dilation_cutoff);
  const Cone flat = m.cut_off.value_or(Cone{m.cone.alpha, 0, m.cone.strength});
  return {.alpha = select(off, Real(flat.alpha), Real(m.cone.alpha)),
          .beta = select(off, Real(flat.beta), Real(m.cone.beta)),
          .strength = select(off, Real(flat.strength), Real(m.cone.strength))};
}

/// A material whose yield surface is a cone in (sqrt(J2), p) and whose elasticity is isotropic.
template <class M>
concept ConeMaterial = requires(const M& m, double plastic_volume_strain) {
  { m.moduli } -> std::convertible_to<const ElasticModuli&>;
  { yield_cone<double>(m, plastic_volume_strain) } -> std::same_as<Cone>;
};

}  // namespace constitutive

#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <type_traits>

#include "constitutive/elastic.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// Mohr-Coulomb with edges and apex, non-associated and perfectly plastic; plane strain and 3D.
///
/// f = (1 + sin phi) sigma_1 - (1 - sin phi) sigma_3 - 2 c cos phi, sigma_1 >= sigma_2 >= sigma_3,
/// tension positive; the potential has psi for phi. phi = 0 is Tresca's prism (no apex).
struct MohrCoulomb {
  static constexpr std::array<ModelInfo, 1> models{
      {{.name = "mohr_coulomb", .doc = "true corners", .frictional = true}}};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;

  ElasticModuli moduli;
  double cohesion = 0;  ///< c [Pa].
  double sin_friction = 0;
  double cos_friction = 1;
  double sin_dilation = 0;
  /// No dilation (psi = 0) in a step that begins with plastic_volume_strain >= this [-].
  double dilation_cutoff = std::numeric_limits<double>::infinity();
  /// No principal stress above it (Rankine's cut-off, associated) [Pa]; off at infinity and
  /// wherever it lies beyond the apex. `mixed_return` is not for it.
  double tension = std::numeric_limits<double>::infinity();

  static MohrCoulomb make(const MaterialParameters& p, const ModelInfo&) {
    const double phi = radians(p.friction_angle), psi = radians(p.dilation_angle);
    return {elastic_moduli(p.youngs_modulus, p.poissons_ratio),
            p.cohesion,
            std::sin(phi),
            std::cos(phi),
            std::sin(psi),
            p.dilation_cutoff,
            p.tension_cutoff};
  }
};

namespace detail {

/// Part of the Mohr-Coulomb surface a stress lies on.
enum class MohrCoulombRegime : std::uint8_t {
  elastic,
  plane,             ///< sigma_1 > sigma_2 > sigma_3.
  compression_edge,  ///< sigma_1 = sigma_2 > sigma_3.
  extension_edge,    ///< sigma_1 > sigma_2 = sigma_3.
  apex,
  tension,  ///< sigma_1 is at the tension cut-off, on whatever part of it but its apex.
};

/// Return in principal stress space: stress, and its derivative by the trial.
struct PrincipalReturn {
  MohrCoulombRegime regime = MohrCoulombRegime::elastic;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;
};

/// D b for b = (1 + s, 0, -(1 - s)) placed at rows `major` and `minor`: 2 mu b + 2 lambda s.
Eigen::Vector3d principal_flow(const ElasticModuli& m, double sine, int major, int minor);

/// Gradient a = (1 + s) e_major - (1 - s) e_minor of a yield plane.
Eigen::Vector3d plane_gradient(double sine, int major, int minor);

/// Return to the edge between the main plane and the plane of rows `major`, `minor`.
///
/// Koiter: two multipliers from the 2 x 2 system G = A^T D B, which is [[g, h], [h, g]] by
/// symmetry. False if a multiplier is negative or the point lies beyond the apex.
bool return_to_edge(const MohrCoulomb& m, double sin_psi, const Eigen::Vector3d& trial, int major,
                    int minor, PrincipalReturn& r);

/// Return of sorted principal trial stresses (falling order) to the pyramid without its cut-off.
///
/// The surface and the potential consist of planes and the elasticity is linear, so every regime is
/// closed form. Regimes are tried from the plane to the apex; the order of the returned principal
/// stresses decides.
PrincipalReturn return_to_pyramid(const MohrCoulomb& m, double sin_psi,
                                  const Eigen::Vector3d& trial);

/// Whether a stress is within the pyramid and its cut-off whatever its Lode angle; false does not
/// say that it is not. Spares most points of a body the search for their principal stresses.
/// @param size  sqrt(J2)
inline bool is_within_for_sure(const MohrCoulomb& m, double pressure, double size) {
  // sigma_1 - sigma_3 <= 2 sqrt(J2); sigma_2 is off the mean by sqrt(J2 / 3) at most, sigma_1 by
  // twice that.
  constexpr double off = std::numbers::inv_sqrt3;
  return (2 + m.sin_friction * off) * size + 2 * m.sin_friction * pressure <
             2 * m.cohesion * m.cos_friction &&
         pressure + 2 * off * size < m.tension;
}

/// Return of sorted principal trial stresses (falling order) to the surface.
PrincipalReturn return_principal(const MohrCoulomb& m, double sin_psi,
                                 const Eigen::Vector3d& trial);

template <int Dim>
double sine_of_dilation(const MohrCoulomb& m, const PointState<Dim>& s0) {
  return s0.plastic_volume_strain >= m.dilation_cutoff ? 0 : m.sin_dilation;
}

}  // namespace detail

/// Stress update of `MohrCoulomb` from the elastic trial stress, in principal stress space.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const MohrCoulomb& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1);

/// d(stress)/d(trial stress) of `update` at a finite trial, the spin of the principal axes
/// included.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const MohrCoulomb& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0);

}  // namespace constitutive

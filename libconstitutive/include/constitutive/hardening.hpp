#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "constitutive/cone.hpp"
#include "constitutive/no_subpoints.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// `VonMises`, `DruckerPrager` or `MohrCoulomb` whose cohesion and friction angle go linearly, with
/// the accumulated equivalent plastic strain k, to residual values: softening, or hardening where
/// these are higher. Plane strain and 3D.
///
/// `make_material` makes it of parameters that have a `residual_strain`.
struct HardeningSoil {
  static constexpr std::array<ModelInfo, 0> models{};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;
  static constexpr bool without_subpoints = true;

  /// Whose surface it has.
  enum class Surface : std::uint8_t { cylinder, plane_strain_cone, compression_cone, pyramid };

  ElasticModuli moduli;
  Surface surface = Surface::cylinder;
  double cohesion = 0, residual_cohesion = 0;  ///< [Pa]
  double friction = 0, residual_friction = 0;  ///< [rad]
  double dilation = 0;                         ///< [rad], at most either friction angle.
  double residual_strain = 1;                  ///< k from which on the residual values hold, > 0.
  /// No dilation in a step that begins with plastic_volume_strain >= this [-].
  double dilation_cutoff = std::numeric_limits<double>::infinity();

  /// Strength at a plastic strain.
  [[nodiscard]] double cohesion_at(double k) const {
    return cohesion + share(k) * (residual_cohesion - cohesion);
  }
  [[nodiscard]] double friction_at(double k) const {
    return friction + share(k) * (residual_friction - friction);
  }
  /// How far of the way to the residual values.
  [[nodiscard]] double share(double k) const { return std::clamp(k / residual_strain, 0.0, 1.0); }
};

namespace detail {

/// The strength at some plastic strain, and by how much it grows with it.
struct Strength {
  double cohesion, friction, cohesion_slope = 0, friction_slope = 0;

  Strength(const HardeningSoil& m, double k)
      : cohesion(m.cohesion_at(k)), friction(m.friction_at(k)) {
    if (k >= m.residual_strain) return;
    cohesion_slope = (m.residual_cohesion - m.cohesion) / m.residual_strain;
    friction_slope = (m.residual_friction - m.friction) / m.residual_strain;
  }
};

/// The cone at some strength, and its change with the plastic strain.
struct ConeChange {
  Cone cone;
  double alpha = 0, strength = 0;
};

ConeChange cone_change(HardeningSoil::Surface surface, const Strength& now, double psi);

/// A return to the surface of some plastic strain k in principal stresses.
struct HardeningReturn {
  bool plastic = false, apex = false;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;                             ///< Of the stress by the trial, at that k.
  Eigen::Vector3d of_strain = Eigen::Vector3d::Zero();  ///< Of the stress by k, at that trial [Pa].
};

/// The implicit return: k such that it is the plastic strain that the return to its surface makes.
struct HardeningStep {
  double strain = 0;  ///< k at the end.
  HardeningReturn at;
  Eigen::RowVector3d gradient =
      Eigen::RowVector3d::Zero();  ///< Of the plastic strain of the step by what is removed.
};

/// k - k0 - (plastic strain of the return at k) is negative at k0 and positive far beyond; Newton's
/// method inside a bracket. Where strength is lost faster than a point can be followed, several k
/// solve it; the bracket then holds one of them.
HardeningStep hardening_step(const HardeningSoil& m, double k0, double psi,
                             const Eigen::Vector3d& trial);

template <int Dim>
HardeningStep hardening_step_of(const HardeningSoil& m, const PointState<Dim>& s0,
                                const Eigen::Vector3d& trial);

}  // namespace detail

/// Stress update of `HardeningSoil` from the elastic trial stress, in principal stress space: on
/// the surface of the plastic strain at the end of the step.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const HardeningSoil& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1);

/// d(stress)/d(trial stress) of `update` at a finite trial, the change of strength included.
///
/// With A and b the derivatives of the return at k by trial and by k, and e that of its plastic
/// strain by the stress removed, dk = e (I - A) d(trial) / (1 + e b).
template <int Dim>
TangentMatrix<Dim> trial_tangent(const HardeningSoil& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0);

}  // namespace constitutive

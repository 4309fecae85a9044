#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "constitutive/drucker_prager.hpp"
#include "constitutive/no_subpoints.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// `VonMises` or `DruckerPrager` whose principal stresses are cut off at a tension T; plane strain
/// and 3D. Associated on the cut-off, with its corners among themselves and with the cone.
///
/// `make_material` makes it of a cone whose parameters have a `tension_cutoff`.
struct CutCone {
  static constexpr std::array<ModelInfo, 0> models{};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;
  static constexpr bool without_subpoints = true;
  ElasticModuli moduli;
  DruckerPrager soil;  ///< The cone, and without dilation the one beyond its cut-off.
  double tension = 0;  ///< T [Pa], >= 0.
};

namespace detail {

/// Part of the surface of a cut cone that a stress lies on.
enum class CutConeRegime : std::uint8_t {
  elastic,
  cone,
  cone_apex,
  plane,           ///< sigma_1 = T.
  edge,            ///< sigma_1 = sigma_2 = T.
  corner,          ///< All three are T.
  cone_and_plane,  ///< On the cone, sigma_1 = T: a curve.
  cone_and_edge,   ///< On the cone, sigma_1 = sigma_2 = T: a point.
};

struct CutConeReturn {
  CutConeRegime regime = CutConeRegime::elastic;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;
};

/// The return to the cone alone in principal stresses, and its derivative.
CutConeReturn return_to_cone_alone(const Cone& cone, const ElasticModuli& m,
                                   const Eigen::Vector3d& trial);

}  // namespace detail

/// Stress update of `CutCone` from the elastic trial stress, in principal stress space.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const CutCone& material, const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1);

/// d(stress)/d(trial stress) of `update` at a finite trial, the spin of the principal axes
/// included.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const CutCone& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0);

}  // namespace constitutive

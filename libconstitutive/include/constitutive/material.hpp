#pragma once

#include <type_traits>
#include <variant>

#include "constitutive/cone_update.hpp"
#include "constitutive/curved_envelope.hpp"
#include "constitutive/cut_cone.hpp"
#include "constitutive/drucker_prager.hpp"
#include "constitutive/elastic.hpp"
#include "constitutive/hardening.hpp"
#include "constitutive/modified_cam_clay.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/parameters.hpp"

namespace constitutive {

/// Any material of this library; visit once per block of points, not per point.
///
/// This is where materials are registered: each brings its models (`M::models`), is made by
/// `M::make(parameters, model)`, and has `update` and `trial_tangent` beside it.
using Material = std::variant<Elastic, VonMises, DruckerPrager, MohrCoulomb, CutCone, HardeningSoil,
                              ModifiedCamClay, CurvedEnvelope>;

/// The material of valid parameters, its derived constants computed once.
/// @throws std::invalid_argument with every message of `validate` (dimension 2) if there is one
Material make_material(const MaterialParameters& parameters);

/// Elastic moduli of any material.
const ElasticModuli& moduli(const Material& material);

/// Consistent tangent d(stress)/d(strain increment), engineering shear, at this trial stress [Pa].
///
/// The trial tangent times the elastic stiffness, since d(trial) = D d(strain). Symmetric if the
/// flow is associated. Material is any member of `Material`.
template <class M, int Dim>
TangentMatrix<Dim> tangent(const M& material, const std::type_identity_t<StressVector<Dim>>& trial,
                           const PointState<Dim>& s0) {
  return trial_tangent(material, trial, s0) * elastic_stiffness<Dim>(material.moduli);
}

/// `update` of whichever material is held; for single points, as it branches on every call.
template <int Dim>
UpdateOutcome update(const Material& material, const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  return std::visit([&](const auto& m) { return update(m, trial, s0, s1); }, material);
}

/// `trial_tangent` of whichever material is held; for single points.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const Material& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  return std::visit([&](const auto& m) { return trial_tangent(m, trial, s0); }, material);
}

/// `tangent` of whichever material is held; for single points.
template <int Dim>
TangentMatrix<Dim> tangent(const Material& material,
                           const std::type_identity_t<StressVector<Dim>>& trial,
                           const PointState<Dim>& s0) {
  return trial_tangent(material, trial, s0) * elastic_stiffness<Dim>(moduli(material));
}

}  // namespace constitutive

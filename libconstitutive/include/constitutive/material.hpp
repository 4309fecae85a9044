#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "constitutive/cone_update.hpp"
#include "constitutive/drucker_prager.hpp"
#include "constitutive/elastic.hpp"
#include "constitutive/mohr_coulomb.hpp"

namespace constitutive {

/// Any material of this library; visit once per block of points, not per point.
using Material = std::variant<Elastic, VonMises, DruckerPrager, MohrCoulomb>;

/// What a user writes down about a material.
struct MaterialParameters {
  /// One of `material_model_names()`.
  std::string model = "drucker_prager";
  /// E > 0 [Pa]. Required: the default is refused by `validate`.
  double youngs_modulus = 0;
  /// -1 < nu < 1/2 [-].
  double poissons_ratio = 0.3;
  /// c >= 0 [Pa]; > 0 where the friction angle is 0 and for von_mises. Unused by elastic.
  double cohesion = 0;
  /// 0 <= phi < 90 [degree]; must be 0 for von_mises. Unused by elastic.
  double friction_angle = 0;
  /// 0 <= psi <= phi [degree].
  double dilation_angle = 0;
  /// Mass density rho >= 0 [kg/m^3]; carried for body forces, no stress update uses it.
  double density = 0;
  /// No dilation once the plastic volume strain reaches this, >= 0 [-]; off at infinity.
  double dilation_cutoff = std::numeric_limits<double>::infinity();

  /// Calls visitor(name, field) for every field, in a fixed order.
  template <class Visitor>
  void for_each_field(Visitor&& visitor) {
    visit_fields(*this, visitor);
  }

  /// Read-only form of `for_each_field`.
  template <class Visitor>
  void for_each_field(Visitor&& visitor) const {
    visit_fields(*this, visitor);
  }

  bool operator==(const MaterialParameters&) const = default;

 private:
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visitor) {
    visitor("model", self.model);
    visitor("youngs_modulus", self.youngs_modulus);
    visitor("poissons_ratio", self.poissons_ratio);
    visitor("cohesion", self.cohesion);
    visitor("friction_angle", self.friction_angle);
    visitor("dilation_angle", self.dilation_angle);
    visitor("density", self.density);
    visitor("dilation_cutoff", self.dilation_cutoff);
  }
};

/// Names accepted as `MaterialParameters::model`.
///
/// elastic, von_mises (sqrt(J2) = c), drucker_prager (plane-strain match), mohr_coulomb, and
/// drucker_prager_compression (compression cone).
std::span<const std::string_view> material_model_names();

/// All objections to the parameters, each naming field, value and what is allowed; empty if none.
/// @param dimension  2 (plane strain) or 3; drucker_prager is refused in 3, where its match to
///   Mohr-Coulomb does not hold
std::vector<std::string> validate(const MaterialParameters& parameters, int dimension = 2);

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

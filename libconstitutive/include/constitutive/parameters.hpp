#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace constitutive {

/// What a user writes down about a material. What each may be, and which model uses it, is in
/// `parameter_infos()`.
struct MaterialParameters {
  /// The name of one of `material_models()`.
  std::string model = "drucker_prager";
  /// Required: the default is refused by `validate`.
  double youngs_modulus = 0;
  double poissons_ratio = 0.3;
  double cohesion = 0;
  double friction_angle = 0;
  double dilation_angle = 0;
  double density = 0;
  double dilation_cutoff = std::numeric_limits<double>::infinity();
  double tension_cutoff = std::numeric_limits<double>::infinity();
  /// Infinite: the strength stays what it is.
  double residual_strain = std::numeric_limits<double>::infinity();
  double residual_cohesion = std::numeric_limits<double>::infinity();
  double residual_friction_angle = std::numeric_limits<double>::infinity();
  /// Required of a clay in critical states: the defaults are refused.
  double compression_index = 0;
  double swelling_index = 0;
  double critical_stress_ratio = 0;
  double preconsolidation_pressure = 0;
  /// Required of rock by Hoek and Brown, but for the disturbance: the defaults are refused.
  double intact_strength = 0;
  double m_i = 0;
  double gsi = -1;
  double disturbance = 0;
  /// Required of a power law: the defaults are refused.
  double power_coefficient = 0;
  double power_exponent = 0;
  double power_tension = 0;
  double reference_stress = 0;
  /// Of curved envelopes.
  double dilation_ratio = 0;
  double strength_factor = 1;

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
    visitor("tension_cutoff", self.tension_cutoff);
    visitor("residual_strain", self.residual_strain);
    visitor("residual_cohesion", self.residual_cohesion);
    visitor("residual_friction_angle", self.residual_friction_angle);
    visitor("compression_index", self.compression_index);
    visitor("swelling_index", self.swelling_index);
    visitor("critical_stress_ratio", self.critical_stress_ratio);
    visitor("preconsolidation_pressure", self.preconsolidation_pressure);
    visitor("intact_strength", self.intact_strength);
    visitor("m_i", self.m_i);
    visitor("gsi", self.gsi);
    visitor("disturbance", self.disturbance);
    visitor("power_coefficient", self.power_coefficient);
    visitor("power_exponent", self.power_exponent);
    visitor("power_tension", self.power_tension);
    visitor("reference_stress", self.reference_stress);
    visitor("dilation_ratio", self.dilation_ratio);
    visitor("strength_factor", self.strength_factor);
  }
};

/// Strength told by a curved Mohr envelope in place of cohesion and friction.
enum class Curve { none, hoek_brown, power_law };

/// One model of a material, described by the material itself (its member `models`). `Material`
/// lists the materials; everything else that is said of models comes from here.
struct ModelInfo {
  std::string_view name;      ///< As `MaterialParameters::model` takes it.
  std::string_view doc = "";  ///< What it is, in a line.
  /// Models of one surface with different constants are a family, told apart by whose states of
  /// Mohr-Coulomb they match; a model alone is its own family.
  std::string_view family = name;
  std::string_view match = "";
  bool yields = true;           ///< Cohesion is a parameter if it `is_cohesive`.
  bool frictional = false;      ///< Friction, dilation and its cut-off are, too.
  bool critical_state = false;  ///< Strength by compaction in place of cohesion and friction.
  Curve curve = Curve::none;    ///< Strength by a curved envelope in place of them.
  /// Deviatoric points share one pressure side by side (`mixed.hpp`); true corners can as well, one
  /// by one (`mixed_mohr_coulomb.hpp`).
  bool one_pressure = false;
  /// Why it is for plane strain only; "" if it is for three dimensions as well.
  std::string_view only_plane_strain = "";

  /// Whether cohesion is what its strength begins with.
  [[nodiscard]] constexpr bool is_cohesive() const {
    return yields && !critical_state && curve == Curve::none;
  }
};

/// Which models use a parameter.
enum class Use { all, yielding, frictional, critical_state, curved, hoek_brown, power_law };

/// One parameter: what it may be, and for whom.
struct ParameterInfo {
  std::string_view name;
  std::string_view unit;
  std::string_view doc;
  double lower, upper;  ///< Ends of its range; an infinite one is none.
  bool lower_open, upper_open;
  Use use;
  double MaterialParameters::*member;

  [[nodiscard]] bool is_used_by(const ModelInfo& model) const {
    if (use == Use::all) return true;
    if (use == Use::critical_state) return model.critical_state;
    if (use == Use::hoek_brown) return model.curve == Curve::hoek_brown;
    if (use == Use::power_law) return model.curve == Curve::power_law;
    if (use == Use::curved) return model.curve != Curve::none;
    return use == Use::yielding ? model.is_cohesive() : model.frictional;
  }
  /// Whether a value lies in the range; not a number does not.
  [[nodiscard]] bool holds(double value) const;
  /// `> 0 [Pa]`.
  [[nodiscard]] std::string allowed() const;
};

/// Every number of `MaterialParameters`.
std::span<const ParameterInfo> parameter_infos();

/// The parameter of that name.
/// @throws std::out_of_range if there is none
const ParameterInfo& parameter_info(std::string_view name);

/// Every model, in the order of `Material`.
std::span<const ModelInfo> material_models();

/// The model of that name, or nullptr.
const ModelInfo* find_model(std::string_view name);

/// The model of a family with that match (which a model alone does not ask for), or nullptr.
const ModelInfo* find_model(std::string_view family, std::string_view match);

/// What is wrong with parameters, by the parameter at fault.
struct Objection {
  std::string_view parameter;
  std::string found;
  std::string allowed;
};

/// Objections by the rules that join parameters, each of which is in its range.
std::vector<Objection> joint_objections(const MaterialParameters& parameters,
                                        const ModelInfo& model);

/// All objections to the parameters, each naming field, value and what is allowed; empty if none.
/// @param dimension  2 (plane strain) or 3
std::vector<std::string> validate(const MaterialParameters& parameters, int dimension = 2);

}  // namespace constitutive

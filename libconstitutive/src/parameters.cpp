#include "constitutive/parameters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace constitutive {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using P = MaterialParameters;
// The range of Poisson's ratio is that of positive bulk and shear moduli.
constexpr std::array<ParameterInfo, 25> infos{
    {{"youngs_modulus", "Pa", "Young's modulus E.", 0, infinity, true, false, Use::all,
      &P::youngs_modulus},
     {"poissons_ratio", "", "Poisson's ratio nu.", -1, 0.5, true, true, Use::all,
      &P::poissons_ratio},
     {"cohesion", "Pa", "Cohesion c.", 0, infinity, false, false, Use::yielding, &P::cohesion},
     {"friction_angle", "deg", "Friction angle phi.", 0, 90, false, true, Use::frictional,
      &P::friction_angle},
     {"dilation_angle", "deg", "Dilation angle psi, at most phi; psi = phi is associated flow.", 0,
      90, false, true, Use::frictional, &P::dilation_angle},
     {"density", "kg/m3", "Mass per initial volume.", 0, infinity, false, false, Use::all,
      &P::density},
     {"dilation_cutoff", "",
      "Accumulated plastic volume strain at which dilation stops; 0 is never.", 0, infinity, false,
      false, Use::frictional, &P::dilation_cutoff},
     {"tension_cutoff", "Pa",
      "Largest principal stress (Rankine); 0 is no tension at all, and beyond the apex it changes "
      "nothing.",
      0, infinity, false, false, Use::yielding, &P::tension_cutoff},
     {"residual_strain", "",
      "Accumulated equivalent plastic strain over which cohesion and friction angle go linearly to "
      "their residual values, which then stay. What softens does so in bands as thin as the "
      "discretisation allows: results after the peak depend on it.",
      0, infinity, true, false, Use::yielding, &P::residual_strain},
     {"residual_cohesion", "Pa", "Cohesion from residual_strain on.", 0, infinity, false, false,
      Use::yielding, &P::residual_cohesion},
     {"residual_friction_angle", "deg", "Friction angle from residual_strain on, at least psi.", 0,
      90, false, true, Use::frictional, &P::residual_friction_angle},
     {"compression_index", "",
      "Slope lambda of volume strain over ln p on the isotropic compression line.", 0, infinity,
      true, false, Use::critical_state, &P::compression_index},
     {"swelling_index", "",
      "Slope kappa of volume strain over ln p where nothing yields, below lambda; the bulk modulus "
      "is p / kappa.",
      0, infinity, true, false, Use::critical_state, &P::swelling_index},
     {"critical_stress_ratio", "",
      "M = q / p in the critical state; 6 sin phi / (3 - sin phi) in triaxial compression.", 0, 3,
      true, true, Use::critical_state, &P::critical_stress_ratio},
     {"preconsolidation_pressure", "Pa",
      "Mean stress at which isotropic compression first yields, compression positive.", 0, infinity,
      true, false, Use::critical_state, &P::preconsolidation_pressure},
     {"intact_strength", "Pa", "Unconfined strength sigma_ci of the intact rock.", 0, infinity,
      true, false, Use::hoek_brown, &P::intact_strength},
     {"m_i", "", "Hoek and Brown's m of the intact rock.", 0, infinity, true, false,
      Use::hoek_brown, &P::m_i},
     {"gsi", "", "Geological strength index: 100 is intact rock.", 0, 100, false, false,
      Use::hoek_brown, &P::gsi},
     {"disturbance", "", "Disturbance D by blasting and relief.", 0, 1, false, false,
      Use::hoek_brown, &P::disturbance},
     {"power_coefficient", "", "A of tau = A p_r ((sigma_n + T) / p_r)^b.", 0, infinity, true,
      false, Use::power_law, &P::power_coefficient},
     {"power_exponent", "", "b of the power law.", 0.5, 1, false, true, Use::power_law,
      &P::power_exponent},
     {"power_tension", "Pa", "T of the power law, the largest tension.", 0, infinity, false, false,
      Use::power_law, &P::power_tension},
     {"reference_stress", "Pa", "p_r of the power law.", 0, infinity, true, false, Use::power_law,
      &P::reference_stress},
     {"dilation_ratio", "",
      "Of a curved envelope: its flow's K - 1 over its strength's, K = d(sigma_1) / d(sigma_3); 1 "
      "is associated flow, 0 no change of volume.",
      0, 1, false, false, Use::curved, &P::dilation_ratio},
     {"strength_factor", "", "Of a curved envelope: what its shear strengths are divided by.", 0,
      infinity, true, false, Use::curved, &P::strength_factor}}};

std::string text_of(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string joined_names() {
  std::string all;
  for (const ModelInfo& model : material_models()) {
    all += (all.empty() ? "" : ", ") + std::string(model.name);
  }
  return all;
}

}  // namespace

bool ParameterInfo::holds(double value) const {
  const bool above = lower_open ? value > lower : value >= lower;
  const bool below = upper_open ? value < upper : value <= upper;
  // Only where the default is infinite, which is never, may a value be.
  const P defaults;
  const bool never = std::isinf(defaults.*member) && std::isinf(value) && value > 0;
  return never || (above && below && std::isfinite(value));
}

std::string ParameterInfo::allowed() const {
  std::string text = (lower_open ? "> " : ">= ") + text_of(lower);
  if (std::isfinite(upper)) text += (upper_open ? " and < " : " and <= ") + text_of(upper);
  return unit.empty() ? text : text + " [" + std::string(unit) + "]";
}

std::span<const ParameterInfo> parameter_infos() {
  return infos;
}

const ParameterInfo& parameter_info(std::string_view name) {
  for (const ParameterInfo& info : infos) {
    if (info.name == name) return info;
  }
  throw std::out_of_range("no parameter of a material is named " + std::string(name));
}

const ModelInfo* find_model(std::string_view name) {
  for (const ModelInfo& model : material_models()) {
    if (model.name == name) return &model;
  }
  return nullptr;
}

const ModelInfo* find_model(std::string_view family, std::string_view match) {
  for (const ModelInfo& model : material_models()) {
    if (model.family == family && (model.match.empty() || model.match == match)) return &model;
  }
  return nullptr;
}

namespace {

/// Residual values that say nothing, or that the model cannot have.
void object_to_residuals(const MaterialParameters& p, const ModelInfo& model,
                         std::vector<Objection>& all) {
  const bool cohesion = std::isfinite(p.residual_cohesion);
  const bool friction = std::isfinite(p.residual_friction_angle) && model.frictional;
  if (std::isnan(p.residual_strain)) return;  // which its range objects to
  if (std::isinf(p.residual_strain)) {
    const char* why = "it needs the residual_strain over which it is reached";
    if (cohesion)
      all.push_back({"residual_cohesion", "found " + text_of(p.residual_cohesion), why});
    if (friction) {
      all.push_back(
          {"residual_friction_angle", "found " + text_of(p.residual_friction_angle), why});
    }
    return;
  }
  if (!cohesion && !friction) {
    all.push_back({"residual_strain", "found " + text_of(p.residual_strain),
                   model.frictional ? "it needs residual_cohesion or residual_friction_angle"
                                    : "it needs residual_cohesion"});
    return;
  }
  if (std::isfinite(p.tension_cutoff)) {
    all.push_back({"tension_cutoff", "found " + text_of(p.tension_cutoff),
                   "a strength that changes with residual_strain has none"});
  }
  const double least_friction = friction ? p.residual_friction_angle : p.friction_angle;
  if ((cohesion ? p.residual_cohesion : p.cohesion) == 0 &&
      (!model.frictional || least_friction == 0)) {
    all.push_back({"residual_cohesion", "found 0 without friction",
                   "a yielding material needs cohesion or friction"});
  }
  if (friction && p.dilation_angle > p.residual_friction_angle) {
    all.push_back({"residual_friction_angle", "found " + text_of(p.residual_friction_angle),
                   "it must not be below the dilation angle, " + text_of(p.dilation_angle)});
  }
}

}  // namespace

std::vector<Objection> joint_objections(const MaterialParameters& p, const ModelInfo& model) {
  std::vector<Objection> all;
  if (model.critical_state) {
    if (p.swelling_index >= p.compression_index) {
      all.push_back({"swelling_index", "found " + text_of(p.swelling_index),
                     "it must be below the compression index, " + text_of(p.compression_index)});
    }
    return all;
  }
  if (model.curve != Curve::none) return all;
  const double friction = model.frictional ? p.friction_angle : 0.0;
  if (model.yields && p.cohesion == 0 && friction == 0) {
    all.push_back(
        {"cohesion", "found 0 without friction", "a yielding material needs cohesion or friction"});
  }
  if (model.yields && !model.frictional && p.friction_angle != 0) {
    all.push_back({"friction_angle", "found " + text_of(p.friction_angle),
                   "the model " + std::string(model.name) + " has none"});
  }
  const bool sound = parameter_info("friction_angle").holds(friction);
  if (model.yields && sound && p.dilation_angle > friction) {
    all.push_back({"dilation_angle", "found " + text_of(p.dilation_angle),
                   "it must not exceed the friction angle, " + text_of(friction)});
  }
  if (model.yields) object_to_residuals(p, model, all);
  return all;
}

std::vector<std::string> validate(const MaterialParameters& p, int dimension) {
  std::vector<std::string> messages;
  if (dimension != 2 && dimension != 3) {
    messages.push_back("dimension = " + std::to_string(dimension) + ": must be 2 or 3");
  }
  const ModelInfo* model = find_model(p.model);
  if (model == nullptr) {
    messages.push_back("model = \"" + p.model + "\": must be one of " + joined_names());
  } else if (dimension == 3 && !model->only_plane_strain.empty()) {
    messages.push_back("model = \"" + p.model + "\": " + std::string(model->only_plane_strain));
  }
  // Of a model that is not known all parameters are judged.
  const ModelInfo any{.name = "any", .frictional = true};
  const ModelInfo& judged = model != nullptr ? *model : any;
  for (const ParameterInfo& info : infos) {
    const double value = p.*info.member;
    if (!info.is_used_by(judged) || info.holds(value)) continue;
    messages.push_back(std::string(info.name) + " = " + text_of(value) + ": must be " +
                       info.allowed());
  }
  for (const Objection& objection : joint_objections(p, judged)) {
    messages.push_back(std::string(objection.parameter) + ": " + objection.found + "; " +
                       objection.allowed);
  }
  return messages;
}

}  // namespace constitutive

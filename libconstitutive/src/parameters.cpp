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
constexpr std::array<ParameterInfo, 8> infos{
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
      0, infinity, false, false, Use::yielding, &P::tension_cutoff}}};

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
  // Only the defaults of the cut-offs are infinite: never.
  const bool cutoff = member == &P::dilation_cutoff || member == &P::tension_cutoff;
  return above && below && (std::isfinite(value) || cutoff);
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

std::vector<Objection> joint_objections(const MaterialParameters& p, const ModelInfo& model) {
  std::vector<Objection> all;
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

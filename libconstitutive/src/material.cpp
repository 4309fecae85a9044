#include "constitutive/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace constitutive {

namespace {

constexpr std::array<std::string_view, 5> model_names{"elastic", "von_mises", "drucker_prager",
                                                      "drucker_prager_compression", "mohr_coulomb"};

constexpr double degree = std::numbers::pi / 180;

std::string objection(std::string_view field, double value, std::string_view allowed) {
  std::ostringstream text;
  text << field << " = " << value << ": " << allowed;
  return text.str();
}

void check_model(const MaterialParameters& p, int dimension, std::vector<std::string>& messages) {
  if (std::find(model_names.begin(), model_names.end(), p.model) == model_names.end()) {
    std::string allowed;
    for (const std::string_view name : model_names) {
      allowed += (allowed.empty() ? "" : ", ") + std::string(name);
    }
    messages.push_back("model = \"" + p.model + "\": must be one of " + allowed);
  }
  if (dimension == 3 && p.model == "drucker_prager") {
    messages.push_back(
        "model = \"drucker_prager\": is matched to Mohr-Coulomb in plane strain only; in 3D use "
        "mohr_coulomb or drucker_prager_compression");
  }
}

void check_elasticity(const MaterialParameters& p, std::vector<std::string>& messages) {
  if (!(std::isfinite(p.youngs_modulus) && p.youngs_modulus > 0)) {
    messages.push_back(
        objection("youngs_modulus", p.youngs_modulus, "must be finite and > 0 [Pa]"));
  }
  if (!(p.poissons_ratio > -1 && p.poissons_ratio < 0.5)) {
    messages.push_back(objection("poissons_ratio", p.poissons_ratio,
                                 "must be > -1 and < 0.5; 0.5 itself is not "
                                 "available, use 0.4999 or less"));
  }
  if (!(std::isfinite(p.density) && p.density >= 0)) {
    messages.push_back(objection("density", p.density, "must be finite and >= 0 [kg/m^3]"));
  }
}

void check_strength(const MaterialParameters& p, std::vector<std::string>& messages) {
  const bool friction_valid = p.friction_angle >= 0 && p.friction_angle < 90;
  if (!(std::isfinite(p.cohesion) && p.cohesion >= 0)) {
    messages.push_back(objection("cohesion", p.cohesion, "must be finite and >= 0 [Pa]"));
  }
  if (!friction_valid) {
    messages.push_back(
        objection("friction_angle", p.friction_angle, "must be >= 0 and < 90 [degree]"));
  }
  if (!(p.dilation_angle >= 0 && (!friction_valid || p.dilation_angle <= p.friction_angle))) {
    messages.push_back(objection("dilation_angle", p.dilation_angle,
                                 "must be >= 0 and <= friction_angle [degree]"));
  }
  if (!(p.dilation_cutoff >= 0)) {
    messages.push_back(
        objection("dilation_cutoff", p.dilation_cutoff, "must be >= 0 [-], infinity for none"));
  }
  if (p.model == "von_mises" && p.friction_angle != 0) {
    messages.push_back(objection("friction_angle", p.friction_angle,
                                 "must be 0 for von_mises, whose strength is the cohesion"));
  }
  if (p.cohesion == 0 && (p.friction_angle == 0 || p.model == "von_mises")) {
    messages.push_back(objection("cohesion", p.cohesion,
                                 "must be > 0 where friction_angle is 0: the material has no "
                                 "strength"));
  }
}

}  // namespace

std::span<const std::string_view> material_model_names() {
  return model_names;
}

std::vector<std::string> validate(const MaterialParameters& parameters, int dimension) {
  std::vector<std::string> messages;
  if (dimension != 2 && dimension != 3) {
    messages.push_back("dimension = " + std::to_string(dimension) + ": must be 2 or 3");
  }
  check_model(parameters, dimension, messages);
  check_elasticity(parameters, messages);
  if (parameters.model != "elastic") check_strength(parameters, messages);
  return messages;
}

Material make_material(const MaterialParameters& p) {
  const std::vector<std::string> messages = validate(p);
  if (!messages.empty()) {
    std::string all = "material refused:";
    for (const std::string& message : messages) all += "\n  " + message;
    throw std::invalid_argument(all);
  }
  const ElasticModuli elastic = elastic_moduli(p.youngs_modulus, p.poissons_ratio);
  const double phi = p.friction_angle * degree, psi = p.dilation_angle * degree;
  if (p.model == "elastic") return Elastic{elastic};
  if (p.model == "von_mises") return VonMises{elastic, p.cohesion};
  if (p.model == "drucker_prager") {
    return DruckerPrager{elastic, plane_strain_cone(p.cohesion, phi, psi), p.dilation_cutoff};
  }
  if (p.model == "drucker_prager_compression") {
    return DruckerPrager{elastic, compression_cone(p.cohesion, phi, psi), p.dilation_cutoff};
  }
  return MohrCoulomb{elastic,       p.cohesion,    std::sin(phi),
                     std::cos(phi), std::sin(psi), p.dilation_cutoff};
}

const ElasticModuli& moduli(const Material& material) {
  return std::visit([](const auto& m) -> const ElasticModuli& { return m.moduli; }, material);
}

}  // namespace constitutive

#include "constitutive/material.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace constitutive {

namespace {

using Maker = Material (*)(const MaterialParameters&, const ModelInfo&);

struct Registered {
  std::vector<ModelInfo> models;
  std::vector<Maker> makers;  // of each model
};

template <class M>
void add(Registered& all) {
  // A material that is only made of another one has no models of its own.
  if constexpr (M::models.size() > 0) {
    for (const ModelInfo& model : M::models) {
      all.models.push_back(model);
      all.makers.push_back([](const MaterialParameters& p, const ModelInfo& of) -> Material {
        return M::make(p, of);
      });
    }
  }
}

const Registered& registered() {
  static const Registered all = [] {
    Registered list;
    [&]<class... M>(std::type_identity<std::variant<M...>>) {
      (add<M>(list), ...);
    }(std::type_identity<Material>{});
    return list;
  }();
  return all;
}

/// The cones have a material of their own for their tension cut-off; the others know it themselves.
Material with_cutoff(const Material& made, double tension) {
  if (const auto* clay = std::get_if<VonMises>(&made)) {
    DruckerPrager cylinder;
    cylinder.moduli = clay->moduli;
    cylinder.cone = yield_cone<double>(*clay, 0);
    return CutCone{clay->moduli, cylinder, tension};
  }
  if (const auto* soil = std::get_if<DruckerPrager>(&made)) {
    return CutCone{soil->moduli, *soil, tension};
  }
  return made;
}

/// The same surface with a strength that changes.
Material with_residuals(const Material& made, const MaterialParameters& p, const ModelInfo& model) {
  using Surface = HardeningSoil::Surface;
  HardeningSoil soil;
  soil.moduli = moduli(made);
  if (std::holds_alternative<MohrCoulomb>(made)) soil.surface = Surface::pyramid;
  if (std::holds_alternative<DruckerPrager>(made)) {
    soil.surface =
        model.match == "plane_strain" ? Surface::plane_strain_cone : Surface::compression_cone;
  }
  const auto residual = [](double value, double otherwise) {
    return std::isfinite(value) ? value : otherwise;
  };
  soil.cohesion = p.cohesion;
  soil.residual_cohesion = residual(p.residual_cohesion, p.cohesion);
  soil.residual_strain = p.residual_strain;
  if (!model.frictional) return soil;
  soil.friction = radians(p.friction_angle);
  soil.residual_friction = radians(residual(p.residual_friction_angle, p.friction_angle));
  soil.dilation = radians(p.dilation_angle);
  soil.dilation_cutoff = p.dilation_cutoff;
  return soil;
}

}  // namespace

std::span<const ModelInfo> material_models() {
  return registered().models;
}

Material make_material(const MaterialParameters& p) {
  const std::vector<std::string> messages = validate(p);
  if (!messages.empty()) {
    std::string all = "material refused:";
    for (const std::string& message : messages) all += "\n  " + message;
    throw std::invalid_argument(all);
  }
  const ModelInfo* model = find_model(p.model);
  const auto number = static_cast<std::size_t>(model - material_models().data());
  const Material made = registered().makers[number](p, *model);
  const bool cohesive = parameter_info("residual_strain").is_used_by(*model);
  if (cohesive && std::isfinite(p.residual_strain)) return with_residuals(made, p, *model);
  return std::isfinite(p.tension_cutoff) ? with_cutoff(made, p.tension_cutoff) : made;
}

const ElasticModuli& moduli(const Material& material) {
  return std::visit([](const auto& m) -> const ElasticModuli& { return m.moduli; }, material);
}

}  // namespace constitutive

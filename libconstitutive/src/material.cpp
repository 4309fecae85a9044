#include "constitutive/material.hpp"

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
  for (const ModelInfo& model : M::models) {
    all.models.push_back(model);
    all.makers.push_back([](const MaterialParameters& p, const ModelInfo& of) -> Material {
      return M::make(p, of);
    });
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
  return registered().makers[static_cast<std::size_t>(model - material_models().data())](p, *model);
}

const ElasticModuli& moduli(const Material& material) {
  return std::visit([](const auto& m) -> const ElasticModuli& { return m.moduli; }, material);
}

}  // namespace constitutive

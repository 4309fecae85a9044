#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/derived.hpp"

namespace scene {

namespace {

bool is_pair(const Interface& one, const Interface& other) {
  return std::ranges::is_permutation(one.between, other.between);
}

void check_interface(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Interface& interface = scene.interface[index];
  const std::string key = fmt::format("interface.{}.between", index);
  if (!diagnosis.good({key, "material"})) return;
  if (interface.between.size() != 2 || interface.between[0] == interface.between[1]) {
    diagnosis.error(key, fmt::format("found [{}]", fmt::join(interface.between, ", ")),
                    "two materials meet: give both names");
    return;
  }
  for (const std::string& name : interface.between) {
    if (std::ranges::find(scene.material, name, &Material::name) != scene.material.end()) continue;
    std::vector<std::string> names;
    for (const Material& material : scene.material) names.push_back(material.name);
    diagnosis.error(key, fmt::format("found \"{}\"", name),
                    fmt::format("materials are {}", fmt::join(names, ", ")));
    return;
  }
  for (std::size_t other = 0; other < index; ++other) {
    if (!is_pair(scene.interface[other], interface)) continue;
    diagnosis.error(key, fmt::format("found \"{}\" again", fmt::join(interface.between, "\", \"")),
                    fmt::format("they are those of interface.{}", other));
  }
}

}  // namespace

void check_interfaces(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < scene.interface.size(); ++i) check_interface(scene, i, diagnosis);
}

}  // namespace scene

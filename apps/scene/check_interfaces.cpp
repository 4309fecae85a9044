#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"

namespace scene {

namespace {

bool is_pair(const Interface& one, const Interface& other) {
  return std::ranges::is_permutation(one.between, other.between);
}

// A body has rows of its own from three particles on.
void check_thickness(const Scene& scene, const Material& material, const std::string& key,
                     tables::Diagnosis& diagnosis) {
  constexpr double fewest = 3.0;
  const Geometry& geometry = scene.geometry;
  const double widths = geometry.layout == Layout::cell ? fewest - 0.5 : fewest - 1.0;
  if (material.region_max.size() != material.region_min.size()) return;  // refused by itself
  for (std::size_t i = 0; i < material.region_min.size(); ++i) {
    const double from = std::max(material.region_min[i], geometry.min[i]);
    const double to = std::min(material.region_max[i], geometry.max[i]);
    if (to - from >= widths * geometry.spacing - same_place(geometry)) continue;
    diagnosis.error(
        key,
        fmt::format("\"{}\" is {:.3g} wide along {}", material.name, to - from,
                    name_of(static_cast<Axis>(i))),
        fmt::format(
            "a body of its own is at least {:g} particles wide, which are {} apart: refine, "
            "or use kind = \"through\"",
            fewest, geometry.spacing));
    return;
  }
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
    const auto found = std::ranges::find(scene.material, name, &Material::name);
    if (found != scene.material.end()) {
      const bool places = box_is_good(scene, diagnosis) && diagnosis.good({"geometry.spacing"});
      if (interface.kind != InterfaceKind::through && places) {
        check_thickness(scene, *found, key, diagnosis);
      }
      continue;
    }
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

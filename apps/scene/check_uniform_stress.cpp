// One stress everywhere before the first step; what bears it at the sides, the model sees.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "scene/box.hpp"
#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"

namespace scene {
namespace {

struct Component {
  const char* key;
  const std::optional<double>& value;
};

std::array<Component, 6> components_of(const InitialStress& s) {
  return {{{"initial_stress.sigma_x", s.sigma_x},
           {"initial_stress.sigma_y", s.sigma_y},
           {"initial_stress.sigma_z", s.sigma_z},
           {"initial_stress.sigma_xy", s.sigma_xy},
           {"initial_stress.sigma_yz", s.sigma_yz},
           {"initial_stress.sigma_zx", s.sigma_zx}}};
}

// What belongs to this kind alone, and what to others.
void check_keys(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  const bool uniform = initial.kind == InitialStressKind::uniform;
  const auto refuse = [&](bool given, const char* key, const std::string& allowed) {
    if (!given || !diagnosis.good({key})) return;
    diagnosis.error(key, fmt::format("found with kind = \"{}\"", name_of(initial.kind)), allowed);
  };
  if (!uniform) {
    for (const Component& component : components_of(initial)) {
      refuse(component.value.has_value(), component.key, "it belongs to kind = \"uniform\"");
    }
    refuse(!initial.loaded_sides.empty(), "initial_stress.loaded_sides",
           "it belongs to kind = \"uniform\"");
    return;
  }
  const std::string allowed = "sigma_x, sigma_y and so on say all of a uniform stress";
  refuse(initial.K0.has_value(), "initial_stress.K0", allowed);
  refuse(initial.K0_z.has_value(), "initial_stress.K0_z", allowed);
  refuse(initial.surface.has_value(), "initial_stress.surface", allowed);
  refuse(initial.surcharge != 0.0, "initial_stress.surcharge", allowed);
}

void check_components(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  const auto components = components_of(initial);
  const bool solid = scene.geometry.dimension == 3;
  const auto need = [&](const Component& component) {
    if (component.value || !diagnosis.good({component.key})) return;
    diagnosis.error(component.key, "is missing",
                    "a uniform stress needs it [Pa], < 0 if it presses");
  };
  need(components[0]);
  need(components[1]);
  if (solid) need(components[2]);
  for (std::size_t i = 4; i < components.size() && !solid; ++i) {
    if (!components[i].value || !diagnosis.good({components[i].key})) continue;
    diagnosis.error(components[i].key, "found in 2D", "it belongs to dimension 3");
  }
  const bool is_some = std::ranges::any_of(
      components, [](const Component& component) { return component.value.value_or(0.0) != 0.0; });
  if (initial.sigma_x && initial.sigma_y && !is_some) {
    diagnosis.error("initial_stress.kind", "found uniform, and no stress",
                    "give its components, or kind = \"none\"");
  }
}

// Names of what a stress may load: sides of the outline, or faces of the box, and cutouts.
std::vector<std::string_view> loadable(const Scene& scene) {
  std::vector<std::string_view> names;
  for (int f = 0; f < 2 * scene.geometry.dimension; ++f) {
    const auto face = static_cast<Side>(f);
    if (is_face_by_itself(scene, face)) names.push_back(name_of(face));
  }
  for (const OutlineSide& side : scene.side) names.push_back(side.name);
  for (const Cutout& cutout : scene.cutout) names.push_back(cutout.name);
  return names;
}

}  // namespace

void check_uniform_stress(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"geometry.dimension", "gravity.acceleration"})) return;
  check_keys(scene, diagnosis);
  const InitialStress& initial = scene.initial_stress;
  if (initial.kind != InitialStressKind::uniform) return;
  check_components(scene, diagnosis);
  if (has_gravity(scene)) {
    diagnosis.error("initial_stress.kind", "found uniform, in ground that has weight",
                    "a stress that is the same everywhere carries none: use geostatic or gravity, "
                    "or leave the weight out");
  }
  const std::string key = "initial_stress.loaded_sides";
  if (!diagnosis.good({key, "side", "cutout"})) return;
  if (!check_known(initial.loaded_sides, loadable(scene), key, "side", diagnosis)) return;
  std::set<std::string_view> seen;
  for (const std::string& name : initial.loaded_sides) {
    if (!seen.insert(name).second) {
      diagnosis.error(key, fmt::format("found \"{}\" twice", name), "each name once");
    }
    for (int f = 0; f < 2 * scene.geometry.dimension; ++f) {
      const auto face = static_cast<Side>(f);
      if (name_of(face) != name || !is_face_by_itself(scene, face)) continue;
      if (!diagnosis.good({"symmetry"}) || !is_mirror(scene, face)) continue;
      diagnosis.error(key, fmt::format("found \"{}\", which is a mirror", name),
                      "behind it is the same ground, which bears what presses on it");
    }
    for (const OutlineSide& side : scene.side) {
      if (side.name != name) continue;
      if (side.kind == OutlineKind::symmetry || side.kind == OutlineKind::footing) {
        diagnosis.error(key,
                        fmt::format("found \"{}\", a side of kind {}", name, name_of(side.kind)),
                        "the ground goes on beyond sides that are free, loaded, fixed or roller");
      }
    }
  }
}

}  // namespace scene

// What the ground bears before the first step.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/course.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/geostatic.hpp"
#include "scene/layers.hpp"
#include "scene/names.hpp"
#include "scene/places.hpp"

namespace scene {

namespace {

/// Whether the weight above any place can be summed up.
bool ground_is_good(const Scene& scene, const tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis) || scene.material.empty() ||
      !diagnosis.good({"geometry.spacing", "initial_stress"})) {
    return false;
  }
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  for (std::size_t i = 1; i < scene.material.size() && scene.region.empty(); ++i) {
    const Material& material = scene.material[i];
    if (material.region_min.size() != n || material.region_max.size() != n) return false;
  }
  constexpr double most_slices = 1e6;
  return (surface_level(scene) - scene.geometry.min[1]) / scene.geometry.spacing < most_slices;
}

/// Whether the tractions that act from the start press on the top as much as the ground above the
/// body that the initial stress speaks of.
void check_surcharge(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  if (!diagnosis.good({"traction", "initial_stress.surcharge"})) return;
  Point top = scene.geometry.max;
  for (std::size_t i = 0; i < top.size(); ++i) {
    if (i != 1) top[i] = 0.5 * (scene.geometry.min[i] + scene.geometry.max[i]);
  }
  const double pressure = -geostatic_stress(scene, top);
  const auto& scales = scene.drive.scales;
  const bool grows = scene.drive.kind == DriveKind::load &&
                     std::find(scales.begin(), scales.end(), LoadKind::traction) != scales.end();
  const bool carried =
      std::any_of(scene.traction.begin(), scene.traction.end(), [&](const Traction& traction) {
        constexpr double of_pressure = 1e-6;  // typed with seven digits
        return traction.side == Side::top && traction.value.size() > 1 && !grows &&
               std::abs(traction.value[1] + pressure) <= of_pressure * pressure;
      });
  if (pressure <= 0.0 || carried) return;
  diagnosis.warning(initial.surcharge > 0.0 ? "initial_stress.surcharge" : "initial_stress.surface",
                    fmt::format("the initial stress carries {:.6g} Pa on the top face, but no "
                                "traction does from the start",
                                pressure),
                    fmt::format("the ground heaves: add a [[traction]] on side = \"top\" with the "
                                "normal value {:.6g}",
                                -pressure));
}

// The deepest place of a material at first, where the stress is largest.
std::optional<Point> deepest_of(const Scene& scene, std::size_t index) {
  const Geometry& geometry = scene.geometry;
  const Material& material = scene.material[index];
  Point deepest = geometry.min;
  for (std::size_t axis = 0; axis < deepest.size(); ++axis) {
    const double lower = material.region_min.empty()
                             ? geometry.min[axis]
                             : std::max(geometry.min[axis], material.region_min[axis]);
    const double upper = material.region_max.empty()
                             ? geometry.max[axis]
                             : std::min(geometry.max[axis], material.region_max[axis]);
    deepest[axis] = axis == 1 ? lower : 0.5 * (lower + upper);
  }
  if (scene.region.empty()) return deepest;
  bool is_there = false;
  for (const Region& region : scene.region) {
    if (region.material != material.name || !region_is_there(scene, 0, region.name)) continue;
    deepest[1] = is_there ? std::min(deepest[1], region.lowest) : region.lowest;
    is_there = true;
  }
  if (!is_there) return std::nullopt;
  return deepest;
}

/// Says where the initial stress is more than the ground can bear (Mohr-Coulomb in the plane).
void check_k0(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"material", "initial_stress.K0", "initial_stress.K0_z"})) return;
  const InitialStress& initial = scene.initial_stress;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const Material& material = scene.material[i];
    const std::string table = fmt::format("material.{}", i);
    // What a clay in critical states bears follows from this stress.
    if (!model_of(material).is_cohesive() ||
        !diagnosis.good({table + ".cohesion", table + ".friction_angle", table + ".poissons_ratio",
                         table + ".region_min", table + ".region_max", table + ".density"})) {
      continue;
    }
    const auto found = deepest_of(scene, i);
    if (!found) continue;
    const Point& deepest = *found;
    const double vertical = -geostatic_stress(scene, deepest);
    if (vertical < 0.0 && scene.water.pore_pressure && diagnosis.good({"water.pore_pressure"})) {
      diagnosis.warning(
          "water.pore_pressure",
          fmt::format(
              "lifts the material \"{}\" with {:.6g} Pa more than there is above y = {:.6g}",
              material.name, -vertical, deepest[1]),
          "its geostatic stress is a tension, which its cohesion bears or not");
    }
    const auto parameters = parameters_at(material, deepest);
    const double phi = parameters.friction_angle * std::numbers::pi / 180.0;
    const double Kp = std::pow(std::tan(std::numbers::pi / 4.0 + phi / 2.0), 2);
    const double cohesion = parameters.cohesion;
    const double least = vertical / Kp - 2.0 * cohesion / std::sqrt(Kp);
    const double most = vertical * Kp + 2.0 * cohesion * std::sqrt(Kp);
    constexpr double round_off = 1e-6;
    const auto look = [&](const char* key, double ratio) {
      const double horizontal = ratio * vertical;
      if (horizontal >= least - round_off * vertical && horizontal <= most + round_off * vertical) {
        return;
      }
      diagnosis.warning(key,
                        fmt::format("{:.4g} is more than the material \"{}\" bears at y = {:.6g}",
                                    ratio, material.name, deepest[1]),
                        fmt::format("it yields in the first step; it bears {:.4g} .. {:.4g} there",
                                    std::max(0.0, least / vertical), most / vertical));
    };
    if (vertical <= 0.0) continue;
    look("initial_stress.K0", resolve_k0(scene, material));
    if (initial.K0_z) look("initial_stress.K0_z", *initial.K0_z);
  }
}

}  // namespace

void check_initial_stress(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  const std::string kind = "initial_stress.kind";
  if (!diagnosis.good({kind})) return;
  check_uniform_stress(scene, diagnosis);
  if (initial.kind == InitialStressKind::none || initial.kind == InitialStressKind::uniform) return;
  if (!diagnosis.good({"gravity.acceleration", "geometry.dimension"})) return;
  const bool has_weight = has_gravity(scene);
  if (!has_weight && initial.kind == InitialStressKind::geostatic) {
    diagnosis.error(kind, "found geostatic without gravity",
                    "geostatic stress is carried weight: give gravity.acceleration");
    return;
  }
  if (!has_weight && !has_dead_loads(scene) && diagnosis.good({"traction", "side", "cutout"})) {
    diagnosis.error(kind, "found gravity with neither weight nor dead loads",
                    "they are what it leaves: give gravity.acceleration, or a pressure to "
                    "the sides where the ground goes on");
    return;
  }
  const Point& g = scene.gravity.acceleration;
  bool down = has_weight && g[1] < 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) down = down && (i == 1 || g[i] == 0.0);
  if (initial.kind == InitialStressKind::gravity) {
    const auto refuse = [&](bool given, const char* key) {
      if (!given || !diagnosis.good({key})) return;
      diagnosis.error(key, "found with kind = \"gravity\"",
                      "it belongs to geostatic: what gravity leaves is what it is");
    };
    refuse(initial.surface.has_value(), "initial_stress.surface");
    refuse(initial.surcharge != 0.0, "initial_stress.surcharge");
    if ((initial.K0 || initial.K0_z) && has_weight && !down) {
      diagnosis.error("gravity.acceleration", "found a direction other than -y",
                      fmt::format("initial_stress.{} is horizontal over vertical stress",
                                  initial.K0 ? "K0" : "K0_z"));
    }
    return;
  }
  if (!down) {
    diagnosis.error("gravity.acceleration", "found a direction other than -y",
                    "geostatic stress needs gravity along -y");
  }
  if (!diagnosis.good({"initial_stress.surface", "gravity.acceleration", "geometry.spacing"}) ||
      !box_is_good(scene, diagnosis)) {
    return;
  }
  const double top = highest_level(scene);
  if (initial.surface && *initial.surface < top) {
    diagnosis.error(
        "initial_stress.surface", fmt::format("found {}", *initial.surface),
        fmt::format("below the top face, y = {}, the soil above would be in tension", top));
    return;
  }
  if (!down || !ground_is_good(scene, diagnosis)) return;
  check_layers(scene, diagnosis);
  // What nothing carries on the surface of regions is refused once their particles are there.
  if (scene.region.empty()) check_surcharge(scene, diagnosis);
  check_k0(scene, diagnosis);
}

}  // namespace scene

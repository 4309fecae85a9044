// Ground whose stress is to be geostatic is level: of one weight and K0 at each depth.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/check.hpp"
#include "scene/course.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/layers.hpp"
#include "scene/water.hpp"

namespace scene {
namespace {

const std::string kind = "initial_stress.kind";
constexpr const char* advice = "kind = \"gravity\" settles ground of any layers";

std::string quoted(const Scene& scene, std::size_t region) {
  const std::string& name = scene.region[region].name;
  return name.empty() ? fmt::format("region {}", region) : fmt::format("\"{}\"", name);
}

void check_regions_beside(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto beside = two_beside_one_another(scene);
  if (beside.empty()) return;
  const Neighbours& first = beside.front();
  diagnosis.error(
      kind,
      fmt::format("found geostatic, and {} and {}, of another weight or K0, are both "
                  "there from y = {:.6g} to {:.6g}",
                  quoted(scene, first.one), quoted(scene, first.other), first.low, first.high),
      fmt::format("geostatic is the stress in level layers: {}", advice));
}

// Coordinates along an axis of the faces of all boxes of materials within the body.
std::vector<double> faces_along(const Scene& scene, std::size_t axis) {
  const double low = scene.geometry.min[axis], high = scene.geometry.max[axis];
  std::vector<double> faces{low, high};
  for (const Material& material : scene.material) {
    for (const Point* corner : {&material.region_min, &material.region_max}) {
      if (axis < corner->size()) faces.push_back(std::clamp((*corner)[axis], low, high));
    }
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::vector<double> middles_along(const Scene& scene, std::size_t axis) {
  if (axis >= scene.geometry.min.size()) return {0.0};
  const auto faces = faces_along(scene, axis);
  std::vector<double> middles;
  for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
    middles.push_back(0.5 * (faces[i] + faces[i + 1]));
  }
  return middles;
}

// Two materials of a box that are at one height and do not weigh alike.
std::optional<std::pair<std::size_t, std::size_t>> two_beside(const Scene& scene) {
  const auto across = middles_along(scene, 0), along = middles_along(scene, 2);
  for (const double y : middles_along(scene, 1)) {
    std::optional<std::size_t> first;
    for (const double x : across) {
      for (const double z : along) {
        const std::array<double, 3> place{x, y, z};
        const std::size_t here = material_at(scene, {place.data(), scene.geometry.min.size()});
        if (first && !weigh_alike(scene, scene.material[*first], scene.material[here])) {
          return std::pair(*first, here);
        }
        if (!first) first = here;
      }
    }
  }
  return std::nullopt;
}

// What a box has always borne by the dead load that keeps its ground at rest.
void check_boxes_beside(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto beside = two_beside(scene);
  if (!beside) return;
  diagnosis.warning(
      kind,
      fmt::format("found geostatic, and \"{}\" and \"{}\", of another weight or K0, "
                  "side by side",
                  scene.material[beside->first].name, scene.material[beside->second].name),
      fmt::format("a dead load bears what that leaves unbalanced, throughout: {}", advice));
}

bool is_there_at_first(const Scene& scene, const Material& material) {
  return scene.region.empty() || std::ranges::any_of(scene.region, [&](const Region& region) {
           return region.material == material.name && region_is_there(scene, 0, region.name);
         });
}

void check_weights(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t m = 0; m < scene.material.size(); ++m) {
    const Material& material = scene.material[m];
    const std::string key =
        fmt::format("material.{}.{}", m, material.unit_weight ? "unit_weight" : "density");
    if (is_level(material.density) || !is_there_at_first(scene, material) ||
        !diagnosis.good({key})) {
      continue;
    }
    const std::string found = "changes along x, and the initial stress is geostatic";
    if (scene.region.empty()) {
      diagnosis.warning(
          key, found,
          fmt::format("a dead load bears what that leaves unbalanced, throughout: {}", advice));
    } else {
      diagnosis.error(key, found,
                      fmt::format("allowed is a weight that changes along y alone: {}", advice));
    }
  }
}

}  // namespace

void check_layers(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"material", "region", kind})) return;
  check_weights(scene, diagnosis);
  if (scene.region.empty()) {
    check_boxes_beside(scene, diagnosis);
    return;
  }
  check_regions_beside(scene, diagnosis);
  if (scene.water.r_u && diagnosis.good({"water.r_u"})) {
    diagnosis.error("water.r_u", "found with a geostatic initial stress",
                    "a share of the overburden is for slopes, which kind = \"gravity\" settles: "
                    "under level ground give a table");
  }
}

}  // namespace scene

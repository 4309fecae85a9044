// Rules on the materials of stages: which strengths change, and what regions become.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/stages.hpp"
#include "tables/nearest_name.hpp"

namespace scene {
namespace {

// Whether a material's strength is made of what stages change.
bool has_cohesion(const Material& material) {
  return model_of(material).is_cohesive();
}

void check_list(const Point& list, const Stage& stage, const std::string& key, double least,
                double below, tables::Diagnosis& diagnosis) {
  if (list.empty() || !diagnosis.good({key})) return;
  if (list.size() != stage.materials.size()) {
    diagnosis.error(key, fmt::format("found {} values", list.size()),
                    fmt::format("one for each of materials, {}", stage.materials.size()));
    return;
  }
  for (const double value : list) {
    if (value >= least && value < below) continue;
    const std::string allowed = std::isfinite(below)
                                    ? fmt::format("allowed is {} <= value < {}", least, below)
                                    : fmt::format("allowed is a number >= {}", least);
    diagnosis.error(key, fmt::format("found {}", value), allowed);
    return;
  }
}

// What strengths become.
void check_values(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  const Stage& stage = scene.stage[s];
  const bool any =
      !stage.cohesion.empty() || !stage.friction_angle.empty() || !stage.dilation_angle.empty();
  if (stage.materials.empty()) {
    if (any) {
      diagnosis.error(key_of_stage(s, "materials"), "is missing", "needed are names of materials");
    }
    return;
  }
  if (!any) {
    diagnosis.error(key_of_stage(s, "materials"), "found without a value",
                    "needed is cohesion, friction_angle or dilation_angle, one for each");
  }
  if (!check_known(stage.materials, names_of_all(scene.material), key_of_stage(s, "materials"),
                   "material", diagnosis)) {
    return;
  }
  for (const std::string& name : stage.materials) {
    const auto material = std::ranges::find(scene.material, name, &Material::name);
    if (has_cohesion(*material)) continue;
    diagnosis.error(key_of_stage(s, "materials"), fmt::format("found \"{}\"", name),
                    fmt::format("material model {} has no cohesion or friction angle that could "
                                "change",
                                material->model));
  }
  constexpr double right_angle = 90.0;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  check_list(stage.cohesion, stage, key_of_stage(s, "cohesion"), 0.0, infinity, diagnosis);
  check_list(stage.friction_angle, stage, key_of_stage(s, "friction_angle"), 0.0, right_angle,
             diagnosis);
  check_list(stage.dilation_angle, stage, key_of_stage(s, "dilation_angle"), 0.0, right_angle,
             diagnosis);
}

// What a region is made of when a stage begins.
std::string material_before(const Scene& scene, std::size_t stage, const Region& region) {
  std::string material = region.material;
  for (std::size_t s = 0; s < stage; ++s) {
    const Stage& former = scene.stage[s];
    for (std::size_t k = 0; k < std::min(former.regions.size(), former.become.size()); ++k) {
      if (former.regions[k] == region.name) material = former.become[k];
    }
  }
  return material;
}

bool is_ever_there(const Scene& scene, std::size_t stage, const std::string& region) {
  for (std::size_t s = stage; s < scene.stage.size(); ++s) {
    if (region_is_there(scene, s + 1, region)) return true;
  }
  return false;
}

// What regions become.
void check_exchange(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  const Stage& stage = scene.stage[s];
  const std::string regions = key_of_stage(s, "regions"), become = key_of_stage(s, "become");
  if (!diagnosis.good({regions, become})) return;
  if (stage.regions.size() != stage.become.size()) {
    diagnosis.error(stage.regions.empty() ? regions : become,
                    stage.become.empty() || stage.regions.empty()
                        ? "is missing"
                        : fmt::format("found {} names", stage.become.size()),
                    stage.regions.empty() ? "needed are names of regions, one for each of become"
                                          : fmt::format("one material for each of regions, {}",
                                                        stage.regions.size()));
    return;
  }
  if (!check_known(stage.regions, names_of_all(scene.region), regions, "region", diagnosis) ||
      !check_known(stage.become, names_of_all(scene.material), become, "material", diagnosis)) {
    return;
  }
  for (std::size_t k = 0; k < stage.regions.size(); ++k) {
    const std::string& name = stage.regions[k];
    if (std::ranges::count(stage.regions, name) > 1) {
      diagnosis.error(regions, fmt::format("found \"{}\" more than once in a stage", name),
                      "a region becomes one material");
      return;
    }
    const auto region = std::ranges::find(scene.region, name, &Region::name);
    if (material_before(scene, s, *region) == stage.become[k]) {
      diagnosis.error(become, fmt::format("found \"{}\"", stage.become[k]),
                      fmt::format("region \"{}\" is made of it already", name));
      return;
    }
    if (is_ever_there(scene, s, name)) continue;
    diagnosis.error(regions, fmt::format("found \"{}\"", name),
                    "it is not there, in this stage or a later one");
    return;
  }
}

}  // namespace

std::string key_of_stage(std::size_t stage, const char* name) {
  return fmt::format("stage.{}.{}", stage, name);
}

bool check_known(const std::vector<std::string>& list, const std::vector<std::string_view>& known,
                 const std::string& key, const char* what, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({key})) return false;
  for (const std::string& name : list) {
    if (std::ranges::count(known, std::string_view(name)) > 0) continue;
    diagnosis.error(key, fmt::format("found \"{}\"", name),
                    known.empty() ? fmt::format("the scene has no {} of a name", what)
                                  : fmt::format("{}s are {}", what, tables::joined(known)),
                    tables::nearest_name(name, known));
    return false;
  }
  return true;
}

void check_materials_of_stage(const Scene& scene, std::size_t stage, tables::Diagnosis& diagnosis) {
  check_values(scene, stage, diagnosis);
  check_exchange(scene, stage, diagnosis);
}

}  // namespace scene

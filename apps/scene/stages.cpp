#include "scene/stages.hpp"

#include <algorithm>

#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

using Names = std::vector<std::string>;

bool names(const Names& list, const std::string& name) {
  return std::ranges::count(list, name) > 0;
}

// Whether what stages take away and put down is there at first: what is put down before it was
// taken away is not.
bool is_there_at_first(const Scene& scene, const std::string& name, Names Stage::*take,
                       Names Stage::*put) {
  for (const Stage& stage : scene.stage) {
    if (names(stage.*take, name)) return true;
    if (names(stage.*put, name)) return false;
  }
  return true;
}

bool is_there(const Scene& scene, std::size_t stages, const std::string& name, Names Stage::*take,
              Names Stage::*put) {
  bool there = is_there_at_first(scene, name, take, put);
  for (std::size_t s = 0; s < stages; ++s) {
    if (names(scene.stage[s].*take, name)) there = false;
    if (names(scene.stage[s].*put, name)) there = true;
  }
  return there;
}

bool begins_later(const Scene& scene, const std::string& support) {
  return std::ranges::any_of(scene.stage,
                             [&](const Stage& stage) { return names(stage.hold, support); });
}

// Sides of the outline that hold where a support does go with it.
void free_sides_of(const Support& support, Scene& scene) {
  if (scene.region.empty() || !support.side) return;
  const OutlineFaces faces(scene, outer_pieces(scene));
  for (const std::size_t s : faces.holders_of(*support.side)) {
    scene.side[s].kind = OutlineKind::free;
  }
}

void take_values(const Stage& stage, Scene& scene) {
  for (std::size_t k = 0; k < stage.materials.size(); ++k) {
    const auto has_its_name = [&](const Material& m) { return m.name == stage.materials[k]; };
    const auto material = std::ranges::find_if(scene.material, has_its_name);
    if (!stage.cohesion.empty()) material->cohesion = tables::VaryingNumber(stage.cohesion[k]);
    if (!stage.friction_angle.empty()) material->friction_angle = stage.friction_angle[k];
    if (!stage.dilation_angle.empty()) material->dilation_angle = stage.dilation_angle[k];
  }
}

// What the first so many stages have changed.
void take_changes(const Scene& whole, std::size_t stages, Scene& scene) {
  for (Region& region : scene.region) {
    region.present = is_there(whole, stages, region.name, &Stage::remove, &Stage::place);
  }
  std::vector<Support> holding;
  for (const Support& support : whole.support) {
    if (is_there(whole, stages, support.name, &Stage::release, &Stage::hold)) {
      holding.push_back(support);
      // Images would be where they were before anything moved; particles are held where they are.
      if (begins_later(whole, support.name)) holding.back().method = SupportMethod::direct;
    } else {
      free_sides_of(support, scene);
    }
  }
  scene.support = std::move(holding);
  for (std::size_t s = 0; s < stages; ++s) {
    if (!whole.stage[s].water_table.empty()) scene.water.table = whole.stage[s].water_table;
    take_values(whole.stage[s], scene);
  }
}

// The load parameter of a stage's end: that of its drive's measure, the target of a displacement.
double load_at_end(const Scene& whole, std::size_t stages) {
  double load = 0.0;
  for (std::size_t s = 0; s < stages; ++s) {
    const auto& to = whole.stage[s].to;
    if (!to) continue;
    load = whole.drive.kind == DriveKind::displacement ? *to / whole.drive.target : *to;
  }
  return load;
}

double reduction_at_end(const Scene& whole, std::size_t stages) {
  double reduction = 1.0;
  for (std::size_t s = 0; s < stages; ++s) {
    reduction = whole.stage[s].reduction.value_or(reduction);
  }
  return reduction;
}

Scene after_changes(const Scene& whole, std::size_t stages) {
  Scene scene = whole;
  // Every stage measures the same, be a support there or not.
  scene.measure = resolve_measures(whole);
  // As the whole run has it: stages differ in what is there, not in how it is computed.
  scene.hourglass.control = resolve_control(whole);
  if (resolve_stiffness_ratio(whole) > 0.0) {
    scene.hourglass.stiffness_ratio = resolve_stiffness_ratio(whole);
  }
  take_changes(whole, stages, scene);
  return scene;
}

}  // namespace

Scene scene_of_stage(const Scene& whole, std::size_t stage) {
  if (whole.stage.empty()) return whole;
  Scene scene = after_changes(whole, stage + 1);
  scene.course = {stage, load_at_end(whole, stage), load_at_end(whole, stage + 1),
                  reduction_at_end(whole, stage), reduction_at_end(whole, stage + 1)};
  const Stage& now = whole.stage[stage];
  if (now.steps) scene.programme.steps = now.steps;
  return scene;
}

std::int64_t planned_steps(const Scene& whole) {
  std::int64_t steps = 0;
  for (std::size_t s = 0; s < stage_count(whole); ++s) {
    steps += nominal_steps(scene_of_stage(whole, s));
  }
  return steps;
}

Scene scene_before_stages(const Scene& whole) {
  return whole.stage.empty() ? whole : after_changes(whole, 0);
}

}  // namespace scene

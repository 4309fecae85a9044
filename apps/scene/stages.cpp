#include "scene/stages.hpp"

#include <algorithm>

#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/grading.hpp"
#include "scene/ground.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

// Sides of the outline that hold where a support does go with it.
void free_sides_of(const Support& support, Scene& scene) {
  if (scene.region.empty() || !support.side) return;
  const OutlineFaces faces(scene, outer_pieces(scene));
  for (const std::size_t s : faces.holders_of(*support.side)) {
    scene.side[s].kind = OutlineKind::free;
  }
}

void take_materials(const Stage& stage, Scene& scene) {
  for (std::size_t k = 0; k < stage.regions.size(); ++k) {
    for (Region& region : scene.region) {
      if (region.name == stage.regions[k]) region.material = stage.become[k];
    }
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

// The weight is that of the ground at rest, aslant by kh and lifted by kv.
void take_quake(const Stage& stage, Scene& scene) {
  if (!stage.kh && !stage.kv) return;
  Point& weight = scene.gravity.acceleration;
  const double at_rest = -weight[1] / (1.0 - scene.load.kv);
  scene.load.kh = stage.kh.value_or(scene.load.kh);
  scene.load.kv = stage.kv.value_or(scene.load.kv);
  weight[0] = at_rest * scene.load.kh;
  weight[1] = at_rest * (scene.load.kv - 1.0);
}

// What the first so many stages have changed.
void take_changes(const Scene& whole, std::size_t stages, Scene& scene) {
  for (Region& region : scene.region) {
    region.present = region_is_there(whole, stages, region.name);
  }
  std::vector<Support> holding;
  for (const Support& support : whole.support) {
    if (support_is_there(whole, stages, support.name)) {
      holding.push_back(support);
      holding.back().method = resolve_method(whole, support);
    } else {
      free_sides_of(support, scene);
    }
  }
  scene.support = std::move(holding);
  for (std::size_t s = 0; s < stages; ++s) {
    if (!whole.stage[s].water_table.empty()) scene.water.table = whole.stage[s].water_table;
    if (whole.stage[s].pore_pressure) scene.water.pore_pressure = whole.stage[s].pore_pressure;
    take_quake(whole.stage[s], scene);
    take_materials(whole.stage[s], scene);
    take_values(whole.stage[s], scene);
  }
}

// The drives as a stage finds them: the one in force, and the others, with what they have come to.
void take_drives(const Scene& whole, const StageDrives& course, Scene& scene) {
  const auto drives = drives_of(whole);
  const auto as_then = [&](std::size_t d) {
    Drive drive = *drives[d].drive;
    drive.name = drives[d].name;
    drive.number = d;
    drive.later = comes_later(whole, *drives[d].drive);
    if (drive.kind == DriveKind::displacement) {
      drive.method = resolve_drive_method(whole, *drives[d].drive);
    }
    return drive;
  };
  const std::vector<std::string> weakened = whole.drive.weakened;
  scene.drive = {};
  if (course.in_force) scene.drive = as_then(*course.in_force);
  scene.drive.weakened = weakened;
  for (std::size_t d = 0; d < drives.size(); ++d) {
    if (course.in_force == d || drives[d].drive->kind == DriveKind::none) continue;
    scene.other_drives.push_back({as_then(d), course.acts[d], course.load[d], course.last[d]});
  }
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
  if (has_stage_drives(whole)) scene.grading.length = resolve_grading_length(whole);
  if (whole.grading.enabled) scene.grading.growth = resolve_growth(whole);
  // Every stage measures the same, be a support there or not.
  scene.measure = resolve_measures(whole);
  // As the whole run has it: stages differ in what is there, not in how it is computed.
  if (resolve_consistency(whole)) scene.approximation.consistency = Switch::on;
  scene.hourglass.control = resolve_control(whole);
  if (resolve_stiffness_ratio(whole) > 0.0) {
    scene.hourglass.stiffness_ratio = resolve_stiffness_ratio(whole);
  }
  take_changes(whole, stages, scene);
  // Before the first stage its drive is there, and has not moved.
  StageDrives drives = courses_of_drives(whole)[std::max<std::size_t>(stages, 1) - 1];
  if (stages == 0) std::ranges::fill(drives.load, 0.0);
  take_drives(whole, drives, scene);
  return scene;
}

}  // namespace

Scene scene_of_stage(const Scene& whole, std::size_t stage) {
  if (whole.stage.empty()) return whole;
  Scene scene = after_changes(whole, stage + 1);
  const StageDrives drives = courses_of_drives(whole)[stage];
  const std::optional<std::size_t> in_force = drives.in_force;
  scene.course = {stage, in_force ? drives.begin : 0.0, in_force ? drives.load[*in_force] : 0.0,
                  reduction_at_end(whole, stage), reduction_at_end(whole, stage + 1)};
  const Stage& now = whole.stage[stage];
  scene.course.fades = now.fades;
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

#include "scene/course.hpp"

#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

std::size_t stage_count(const Scene& scene) {
  return std::max<std::size_t>(1, scene.stage.size());
}

bool changes_ground(const Stage& stage) {
  return !stage.remove.empty() || !stage.place.empty() || !stage.release.empty() ||
         !stage.hold.empty() || !stage.water_table.empty() || stage.pore_pressure || stage.kh ||
         stage.kv || !stage.materials.empty() || !stage.regions.empty() || stage.drive.has_value();
}

bool changes_ground(const Scene& scene) {
  return std::ranges::any_of(scene.stage, [](const Stage& stage) { return changes_ground(stage); });
}

bool has_new_ground(const Scene& scene) {
  return std::ranges::any_of(scene.stage, [](const Stage& stage) {
    return !stage.place.empty() || !stage.regions.empty();
  });
}

bool tries_ground(const Scene& scene) {
  return std::ranges::any_of(scene.stage, [](Stage stage) {
    stage.drive.reset();
    stage.hold.clear();
    return changes_ground(stage);
  });
}

bool region_is_there(const Scene& whole, std::size_t stages, const std::string& region) {
  return is_there(whole, stages, region, &Stage::remove, &Stage::place);
}

bool support_is_there(const Scene& whole, std::size_t stages, const std::string& support) {
  return is_there(whole, stages, support, &Stage::release, &Stage::hold);
}

bool holds_in_stage(const Scene& whole, std::size_t stage, const std::string& support) {
  return whole.stage.empty() || support_is_there(whole, stage + 1, support);
}

bool begins_later(const Scene& whole, const std::string& support) {
  return std::ranges::any_of(whole.stage,
                             [&](const Stage& stage) { return names(stage.hold, support); });
}

bool reduces_strength(const Scene& scene) {
  return scene.drive.kind == DriveKind::strength ||
         std::ranges::any_of(scene.stage,
                             [](const Stage& stage) { return stage.reduction.has_value(); });
}

bool is_weakened(const Scene& scene, const std::string& material) {
  return scene.drive.weakened.empty() || std::ranges::count(scene.drive.weakened, material) > 0;
}

std::string stage_title(const Scene& scene, std::size_t stage) {
  return fmt::format("stage {} of {}, \"{}\"", stage + 1, scene.stage.size(),
                     scene.stage[stage].name);
}

double reduction_at(const Course& course, double progress) {
  if (progress >= 1.0) return course.reduction_end;
  return course.reduction_begin + progress * (course.reduction_end - course.reduction_begin);
}

}  // namespace scene

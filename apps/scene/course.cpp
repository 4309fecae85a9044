#include "scene/course.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/scene.hpp"

namespace scene {

std::size_t stage_count(const Scene& scene) {
  return std::max<std::size_t>(1, scene.stage.size());
}

bool changes_ground(const Stage& stage) {
  return !stage.remove.empty() || !stage.place.empty() || !stage.release.empty() ||
         !stage.hold.empty() || !stage.water_table.empty() || !stage.materials.empty() ||
         stage.drive.has_value();
}

bool changes_ground(const Scene& scene) {
  return std::ranges::any_of(scene.stage, [](const Stage& stage) { return changes_ground(stage); });
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

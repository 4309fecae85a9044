#include "scene/changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/derived.hpp"
#include "scene/grading.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/table.hpp"

namespace scene {

namespace {

constexpr std::array<std::string_view, 6> free_tables{"measure.",   "programme.", "solver.",
                                                      "re_search.", "output.",    "limit."};
constexpr std::array<std::string_view, 2> free_keys{"title", "drive.target"};

std::string text_at(const SceneTable& table, const tables::Field<Scene>& field, const Scene& scene,
                    std::size_t index) {
  if (index >= table.size(scene)) return "absent";
  const auto value = field.read(scene, index);
  return value ? tables::value_text(*value, field.kind) : "absent";
}

// Whether a key is the measure of a drive of which stages say how far it goes: it follows from all
// of them, those to come among them.
bool is_measure(const SceneTable& table, std::string_view key, const Scene& before,
                const Scene& after, std::size_t index) {
  const auto goes_to = [&](const Scene& scene) {
    return index < scene.stage.size() && scene.stage[index].to;
  };
  return table.name == "stage" && key == "drive.target" && goes_to(before) && goes_to(after);
}

// Of a long text what is around the place from which on it differs from another.
std::string around_change(const std::string& text, const std::string& other) {
  constexpr std::size_t longest = 200, before = 40, shown = 100;
  if (text.size() <= longest) return text;
  const auto differs =
      static_cast<std::size_t>(std::ranges::mismatch(text, other).in1 - text.begin());
  const std::size_t from = std::min(differs - std::min(differs, before), text.size() - shown);
  return fmt::format("{}{}{} ({} characters)", from > 0 ? "... " : "", text.substr(from, shown),
                     from + shown < text.size() ? " ..." : "", text.size());
}

}  // namespace

std::string SceneChange::text() const {
  return fmt::format("{}: {} -> {}", key, before, after);
}

bool may_change_on_resume(std::string_view key) {
  return std::ranges::find(free_keys, key) != free_keys.end() ||
         std::ranges::any_of(free_tables, [&](auto table) { return key.starts_with(table); });
}

std::string what_may_change() {
  return fmt::format("{}, {}*; stages that have not begun; the number of threads; nothing else",
                     fmt::join(free_keys, ", "), fmt::join(free_tables, "*, "));
}

namespace {

bool has_same_control(const Scene& one, const Scene& other) {
  return resolve_control(one) == resolve_control(other) &&
         resolve_stiffness_ratio(one) == resolve_stiffness_ratio(other);
}

// Also where what a later stage is now to do would change it.
void keep_control(const Scene& before, Scene& scene) {
  Hourglass& hourglass = scene.hourglass;
  if (hourglass.control == HourglassControl::automatic) {
    hourglass.control = before.hourglass.control;
  }
  if (!hourglass.stiffness_ratio) hourglass.stiffness_ratio = before.hourglass.stiffness_ratio;
  if (has_same_control(before, scene)) return;
  if (hourglass.control == HourglassControl::automatic) {
    hourglass.control = resolve_control(before);
  }
  const double ratio = resolve_stiffness_ratio(before);
  if (!hourglass.stiffness_ratio && ratio > 0.0) hourglass.stiffness_ratio = ratio;
}

}  // namespace

void keep_methods(const Scene& before, Scene& scene) {
  for (std::size_t i = 0; i < std::min(before.support.size(), scene.support.size()); ++i) {
    SupportMethod& method = scene.support[i].method;
    if (method == SupportMethod::automatic) method = before.support[i].method;
  }
  if (scene.drive.method == DriveMethod::automatic) scene.drive.method = before.drive.method;
  // A growth by default was a number in files of before, and is the rule's in others.
  std::optional<double>& growth = scene.grading.growth;
  if (!growth || *growth == resolve_growth(before)) growth = before.grading.growth;
  keep_control(before, scene);
}

std::vector<SceneChange> scene_changes(const Scene& before, const Scene& after, std::size_t stage) {
  std::vector<SceneChange> changes;
  for (const SceneTable& table : scene_tables()) {
    const std::size_t count = std::max(table.size(before), table.size(after));
    for (std::size_t i = 0; i < count; ++i) {
      for (const tables::Field<Scene>& field : table.fields) {
        SceneChange change{table.path(i, field.key), text_at(table, field, before, i),
                           text_at(table, field, after, i), false};
        if (change.before == change.after) continue;
        // A default that is written out is none.
        const bool is_control = field.key == "control" || field.key == "stiffness_ratio";
        if (table.name == "hourglass" && is_control && has_same_control(before, after)) continue;
        const std::string former = change.before;
        change.before = around_change(former, change.after);
        change.after = around_change(change.after, former);
        change.allowed = may_change_on_resume(change.key) || (table.name == "stage" && i > stage) ||
                         is_measure(table, field.key, before, after, i);
        changes.push_back(std::move(change));
      }
    }
  }
  return changes;
}

}  // namespace scene

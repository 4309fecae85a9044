#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scene {

struct Scene;

/// A key whose value differs between two scenes.
struct SceneChange {
  std::string key;     // dotted, as --set takes it
  std::string before;  // as TOML, or `absent`; if that is long, of it where it changes
  std::string after;
  bool allowed = false;  // see may_change_on_resume

  /// `re_search.enabled: false -> true`.
  [[nodiscard]] std::string text() const;
  bool operator==(const SceneChange&) const = default;
};

/// Whether a run may go on from a checkpoint with another value of this key: how far it is driven,
/// in which steps, how each is solved, the rule of re-search, and all output, besides stages that
/// have not begun. Never what the stored
/// state belongs to: body, approximation, materials, supports, loads.
[[nodiscard]] bool may_change_on_resume(std::string_view key);

/// These keys in words.
[[nodiscard]] std::string what_may_change();

/// What `scene` leaves to `auto` of how sides are held and driven and of hourglass control becomes
/// what `before`, with which the run began, says: before there was `auto`, no method meant direct.
void keep_methods(const Scene& before, Scene& scene);

/// Every key whose value differs, in the order of the scene file.
/// @param stage  that the run has come to: later ones may change
[[nodiscard]] std::vector<SceneChange> scene_changes(const Scene& before, const Scene& after,
                                                     std::size_t stage = 0);

}  // namespace scene

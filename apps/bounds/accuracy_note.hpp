#pragma once

#include <filesystem>
#include <string>

namespace scene {
struct Scene;
}

namespace bounds {

/// What the ladder of --accuracy said of this very scene, from the accuracy.json it left in a run's
/// folder: the value with its error bar and the parts of it. "" if there is none, or of another
/// scene.
[[nodiscard]] std::string accuracy_note(const std::filesystem::path& folder,
                                        const scene::Scene& scene);

}  // namespace bounds

#pragma once

#include <filesystem>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace scene {
struct Scene;
}

namespace study {

/// Reads a scene with settings and more of them after those; nothing, with every complaint said, if
/// it is refused.
[[nodiscard]] std::shared_ptr<const scene::Scene> read_varied(const std::filesystem::path& file,
                                                              std::vector<std::string> settings,
                                                              const std::vector<std::string>& more,
                                                              std::ostream& err);

}  // namespace study

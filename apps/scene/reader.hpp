#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tables/diagnosis.hpp"

namespace scene {

struct Scene;

/// What came of reading a scene: the scene if there is no error, and every complaint. Who only
/// hands the scene on need not see its type.
struct SceneReading {
  std::shared_ptr<const Scene> scene;
  std::vector<tables::Complaint> errors;
  std::vector<tables::Complaint> warnings;
};

/// The text of a scene file, or why it cannot be read, with a file of a similar name.
[[nodiscard]] std::variant<std::string, tables::Complaint> text_of(
    const std::filesystem::path& file);

/// Reads a scene file and applies settings (`geometry.spacing=0.02`, `material.0.cohesion=1e3`,
/// `material.soil.cohesion=1e3`) to it, in order. Never throws for what the user wrote; a file that
/// cannot be read is an error of the reading.
[[nodiscard]] SceneReading read_scene(const std::filesystem::path& file,
                                      std::span<const std::string> settings = {});

/// The same from text; `source` is the name that messages show.
[[nodiscard]] SceneReading parse_scene(std::string_view text, const std::string& source,
                                       std::span<const std::string> settings = {});

/// The same into a diagnosis, for who judges the scene further. Nothing if there is an error, or if
/// the text is no TOML: `unreadable` says so then.
[[nodiscard]] std::optional<Scene> parse_scene(std::string_view text,
                                               std::span<const std::string> settings,
                                               tables::Diagnosis& diagnosis,
                                               std::optional<tables::Complaint>& unreadable);

/// A complaint about a scene that was read without errors, for who finds one later on: with where
/// the file or a setting gives the key, or the nearest table around it.
[[nodiscard]] tables::Complaint complaint_about(const std::string& key, const std::string& found,
                                                const std::string& allowed,
                                                const std::filesystem::path& file,
                                                std::span<const std::string> settings);

}  // namespace scene

#include "scene/reader.hpp"

#include "scene/check.hpp"
#include "scene/tables.hpp"
#include "tables/reader.hpp"

namespace scene {

std::optional<Scene> parse_scene(std::string_view text, std::span<const std::string> settings,
                                 tables::Diagnosis& diagnosis,
                                 std::optional<tables::Problem>& unreadable) {
  Scene scene;
  unreadable = tables::read_tables(text, settings, scene_tables(), scene, diagnosis);
  if (unreadable) return std::nullopt;
  check_scene(scene, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  return scene;
}

SceneReading parse_scene(std::string_view text, const std::string& source,
                         std::span<const std::string> settings) {
  SceneReading reading;
  tables::Diagnosis diagnosis(source);
  std::optional<tables::Problem> unreadable;
  reading.scene = parse_scene(text, settings, diagnosis, unreadable);
  reading.errors = diagnosis.errors();
  reading.warnings = diagnosis.warnings();
  if (unreadable) reading.errors = {*unreadable};
  return reading;
}

SceneReading read_scene(const std::filesystem::path& file, std::span<const std::string> settings) {
  const auto text = tables::text_of(file);
  if (const auto* problem = std::get_if<tables::Problem>(&text)) {
    SceneReading reading;
    reading.errors.push_back(*problem);
    return reading;
  }
  return parse_scene(std::get<std::string>(text), file.string(), settings);
}

}  // namespace scene

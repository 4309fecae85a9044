#include "scene/reader.hpp"

#include "scene/check.hpp"
#include "scene/tables.hpp"
#include "tables/reader.hpp"

namespace scene {

SceneReading parse_scene(std::string_view text, const std::string& source,
                         std::span<const std::string> settings) {
  SceneReading reading;
  Scene scene;
  tables::Diagnosis diagnosis(source);
  if (const auto problem = tables::read_tables(text, settings, scene_tables(), scene, diagnosis)) {
    reading.errors.push_back(*problem);
    return reading;
  }
  check_scene(scene, diagnosis);
  reading.errors = diagnosis.errors();
  reading.warnings = diagnosis.warnings();
  if (reading.errors.empty()) reading.scene = std::move(scene);
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

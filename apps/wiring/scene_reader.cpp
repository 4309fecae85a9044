#include "wiring/scene_reader.hpp"

#include "wiring/scene_check.hpp"
#include "wiring/table_reader.hpp"

namespace wiring {

SceneReading parse_scene(std::string_view text, const std::string& source,
                         std::span<const std::string> settings) {
  SceneReading reading;
  Scene scene;
  const TableSink sink{
      [&](const TableInfo& table, std::size_t count) { table.resize(scene, count); },
      [&](const TableInfo&, std::size_t index, const Field& field, const Value& value) {
        field.write(scene, index, value);
      }};
  Diagnosis diagnosis(source);
  if (const auto problem = read_tables(text, settings, scene_tables(), sink, diagnosis)) {
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
  const auto text = text_of(file);
  if (const auto* problem = std::get_if<Problem>(&text)) {
    SceneReading reading;
    reading.errors.push_back(*problem);
    return reading;
  }
  return parse_scene(std::get<std::string>(text), file.string(), settings);
}

}  // namespace wiring

#include "scene/reader.hpp"

#include <algorithm>

#include "files/durable_file.hpp"
#include "scene/check.hpp"
#include "scene/complete.hpp"
#include "scene/mesh_groups.hpp"
#include "scene/sample_files.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/nearest_name.hpp"
#include "tables/reader.hpp"

namespace scene {

std::optional<Scene> parse_scene(std::string_view text, std::span<const std::string> settings,
                                 tables::Diagnosis& diagnosis,
                                 std::optional<tables::Complaint>& unreadable) {
  Scene scene;
  unreadable = tables::read_tables(text, settings, scene_tables(), scene, diagnosis);
  if (unreadable) return std::nullopt;
  const int dimension = take_groups(scene.mesh, scene.region, scene.side, diagnosis);
  check_mesh(scene, dimension, diagnosis);
  take_sample_files(scene_tables(), scene, diagnosis);
  complete(scene, diagnosis);
  // Of ground that is none nothing else can be judged.
  if (scene.region.empty() || diagnosis.errors().empty()) check_scene(scene, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  return scene;
}

SceneReading parse_scene(std::string_view text, const std::string& source,
                         std::span<const std::string> settings) {
  SceneReading reading;
  tables::Diagnosis diagnosis(source);
  std::optional<tables::Complaint> unreadable;
  if (std::optional<Scene> scene = parse_scene(text, settings, diagnosis, unreadable)) {
    reading.scene = std::make_shared<const Scene>(std::move(*scene));
  }
  reading.errors = diagnosis.errors();
  reading.warnings = diagnosis.warnings();
  if (unreadable) reading.errors = {*unreadable};
  return reading;
}

namespace {

tables::Complaint unreadable(const std::filesystem::path& file, const std::string& why) {
  tables::Complaint complaint{file.string(), "", why, "allowed is a TOML file", ""};
  std::vector<std::string> siblings;
  std::error_code ignored;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".toml") siblings.push_back(entry.path().filename().string());
  }
  std::sort(siblings.begin(), siblings.end());
  const std::vector<std::string_view> names(siblings.begin(), siblings.end());
  const std::string nearest = tables::nearest_name(file.filename().string(), names);
  if (!nearest.empty()) complaint.nearest = (file.parent_path() / nearest).string();
  return complaint;
}

}  // namespace

std::variant<std::string, tables::Complaint> text_of(const std::filesystem::path& file) {
  try {
    return files::read_text(file);
  } catch (const files::FileError& failure) {
    return unreadable(file, failure.reason());
  }
}

SceneReading read_scene(const std::filesystem::path& file, std::span<const std::string> settings) {
  const auto text = text_of(file);
  if (const auto* complaint = std::get_if<tables::Complaint>(&text)) {
    SceneReading reading;
    reading.errors.push_back(*complaint);
    return reading;
  }
  return parse_scene(std::get<std::string>(text), file.string(), settings);
}

tables::Complaint complaint_about(const std::string& key, const std::string& found,
                                  const std::string& allowed, const std::filesystem::path& file,
                                  std::span<const std::string> settings) {
  tables::Diagnosis diagnosis(file.string());
  const auto text = text_of(file);
  if (const auto* readable = std::get_if<std::string>(&text)) {
    std::optional<tables::Complaint> ignored;
    static_cast<void>(parse_scene(*readable, settings, diagnosis, ignored));
  }
  return {diagnosis.where(key), key, found, allowed, ""};
}

}  // namespace scene

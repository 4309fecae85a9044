#include "scene/print.hpp"

#include <fmt/format.h>

#include <iterator>

#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/table.hpp"

namespace scene {

namespace {

constexpr std::size_t value_column = 44;  // where comments begin, for shorter values

std::string note_of(const tables::Field<Scene>& field) {
  std::string note = field.allowed_text();
  if (!field.notes.absent.empty()) note += fmt::format("; absent: {}", field.notes.absent);
  return note;
}

/// What an `auto` or absent key comes to in this scene, or "".
std::string resolution_of(const SceneTable& table, const tables::Field<Scene>& field,
                          std::size_t index, const Scene& scene) {
  if (table.name == "hourglass" && field.key == "control" &&
      scene.hourglass.control == HourglassControl::automatic) {
    return fmt::format("here {}; ", name_of(resolve_control(scene)));
  }
  if (table.name == "hourglass" && field.key == "stiffness_ratio") {
    return fmt::format("here {}; ", resolve_stiffness_ratio(scene));
  }
  if (table.name == "support" && field.key == "method" &&
      scene.support[index].method == SupportMethod::automatic) {
    return fmt::format("here {}; ", name_of(resolve_method(scene, scene.support[index])));
  }
  if (table.name == "approximation" && field.key == "consistency" &&
      scene.approximation.consistency == Switch::automatic && resolve_consistency(scene)) {
    return "here on; ";
  }
  if (table.name == "stage" && field.key == "drive.method") {
    const auto& drive = scene.stage[index].drive;
    if (drive && drive->kind == DriveKind::displacement &&
        drive->method == DriveMethod::automatic) {
      return fmt::format("here {}; ", name_of(resolve_drive_method(scene, *drive)));
    }
  }
  if (table.name == "drive" && field.key == "method" &&
      scene.drive.kind == DriveKind::displacement && scene.drive.method == DriveMethod::automatic) {
    return fmt::format("here {}; ", name_of(resolve_drive_method(scene)));
  }
  if (table.name == "programme" && field.key == "steps") {
    return fmt::format("here {}; ", nominal_steps(scene));
  }
  return "";
}

void print_entry(std::string& out, const SceneTable& table, std::size_t index, const Scene& scene) {
  if (!table.name.empty()) out += fmt::format("\n{}\n", table.title());
  for (const tables::Field<Scene>& field : table.fields) {
    const auto value = field.read(scene, index);
    const std::string assignment =
        value ? fmt::format("{} = {}", field.key, tables::value_text(*value, field.kind))
              : fmt::format("# {} =", field.key);
    fmt::format_to(std::back_inserter(out), "{:<{}}  # {}{}\n", assignment, value_column,
                   resolution_of(table, field, index, scene), note_of(field));
  }
}

/// Pipes would end a Markdown cell.
std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

std::string default_of(const SceneTable& table, const tables::Field<Scene>& field) {
  if (field.notes.need == tables::Need::required) return "required";
  if (field.notes.need == tables::Need::optional)
    return fmt::format("absent: {}", field.notes.absent);
  Scene scene;
  table.resize(scene, 1);
  const auto value = field.read(scene, 0);
  return value ? fmt::format("`{}`", tables::value_text(*value, field.kind)) : "absent";
}

void print_reference(std::string& out, const SceneTable& table) {
  const std::string heading = table.name.empty() ? "Top level" : fmt::format("`{}`", table.title());
  out +=
      fmt::format("\n## {}\n\n{}{}{}\n\n", heading, table.doc, table.required ? " Required." : "",
                  table.repeated ? " May be given several times." : "");
  out += "| key | allowed | default | meaning |\n|---|---|---|---|\n";
  for (const tables::Field<Scene>& field : table.fields) {
    std::string meaning(field.notes.doc);
    if (!field.notes.source.empty()) meaning += fmt::format(" Source: {}.", field.notes.source);
    out += fmt::format("| `{}` | {} | {} | {} |\n", field.key, cell(field.allowed_text()),
                       cell(default_of(table, field)), cell(meaning));
  }
}

}  // namespace

std::string effective_toml(const Scene& scene) {
  std::string out = "# SI units; tension positive; y points up.\n";
  for (const SceneTable& table : scene_tables()) {
    const std::size_t count = table.size(scene);
    for (std::size_t i = 0; i < count; ++i) print_entry(out, table, i, scene);
  }
  return out;
}

std::string scene_reference() {
  std::string out =
      "# The scene file\n\n"
      "A scene is a TOML file in SI units; tension is positive, y points up. This page is written\n"
      "by `fpm-run --scene-reference` from the table that also reads the file. Every key can be\n"
      "set on the command line: `--set geometry.spacing=0.02`, `--set material.0.cohesion=3e3`,\n"
      "or by name, `--set material.soil.cohesion=3e3`. Unknown keys are errors.\n"
      "`fpm-run SCENE --print-effective` shows a scene with all defaults.\n";
  for (const SceneTable& table : scene_tables()) print_reference(out, table);
  return out;
}

}  // namespace scene

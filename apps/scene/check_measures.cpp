#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"

namespace scene {

namespace {

bool needs_point(MeasureKind kind) {
  return kind == MeasureKind::displacement || kind == MeasureKind::stress ||
         kind == MeasureKind::particle_stress || kind == MeasureKind::plastic_strain;
}

void check_name(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const std::string& name = scene.measure[index].name;
  const std::string key = fmt::format("measure.{}.name", index);
  if (!diagnosis.good({key})) return;
  const auto plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || !std::ranges::all_of(name, plain)) {
    diagnosis.error(key, fmt::format("found \"{}\"", name), "allowed are letters, digits and _");
  }
  for (std::size_t other = 0; other < index; ++other) {
    if (scene.measure[other].name != name) continue;
    diagnosis.error(key, fmt::format("found \"{}\" again", name),
                    fmt::format("it is the name of measure.{}", other));
    return;
  }
}

// The one key that says what is measured, or where, and no other.
void check_key(bool given, bool needed, const std::string& key, MeasureKind kind,
               tables::Diagnosis& diagnosis) {
  if (given == needed || !diagnosis.good({key})) return;
  diagnosis.error(key, given ? "found" : "absent",
                  fmt::format("a measure of kind {} {}", name_of(kind),
                              needed ? "needs it" : "does not have it"));
}

void check_support_name(const Scene& scene, const std::string& name, const std::string& key,
                        tables::Diagnosis& diagnosis) {
  std::vector<std::string> names;
  for (const Support& support : scene.support) names.push_back(support.name);
  for (const std::string& tied : tied_surfaces(scene)) names.push_back(tied);
  for (const NamedDrive& drive : drives_of(scene)) {
    const bool pushes = drive.drive->kind == DriveKind::displacement || loads_plate(*drive.drive);
    if (pushes && has_stage_drives(scene)) names.push_back(drive.name);
  }
  if (std::ranges::find(names, name) != names.end() || !diagnosis.good({key})) return;
  diagnosis.error(key, fmt::format("found \"{}\"", name),
                  names.empty() ? "the scene has no support"
                                : fmt::format("the supports are {}", fmt::join(names, ", ")));
}

void check_measure(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Measure& measure = scene.measure[index];
  const std::string table = fmt::format("measure.{}", index);
  check_name(scene, index, diagnosis);
  if (!diagnosis.good({table + ".kind"})) return;
  const MeasureKind kind = measure.kind;
  check_key(!measure.at.empty(), needs_point(kind), table + ".at", kind, diagnosis);
  check_key(measure.support.has_value(), kind == MeasureKind::reaction, table + ".support", kind,
            diagnosis);
  check_key(measure.side.has_value(), kind == MeasureKind::resultant, table + ".side", kind,
            diagnosis);
  check_at(measure.at, table + ".at", scene, diagnosis);
  if (measure.support) {
    check_support_name(scene, *measure.support, table + ".support", diagnosis);
  }
  if (measure.side) check_side(*measure.side, table + ".side", scene, diagnosis);
  const bool plastic = std::ranges::any_of(
      scene.material, [](const Material& material) { return yields(material); });
  if (kind == MeasureKind::plastic_strain && !plastic && !scene.material.empty()) {
    diagnosis.error(table + ".kind", "found plastic_strain", "every material is elastic");
  }
}

}  // namespace

void check_measures(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < scene.measure.size(); ++i) check_measure(scene, i, diagnosis);
}

}  // namespace scene

// Rules on drives that stages carry, and on what each of several moves or lets grow.
#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/names.hpp"
#include "scene/stages.hpp"
#include "tables/nearest_name.hpp"

namespace scene {
namespace {

bool is_plate(const Drive& drive) {
  return drive.kind == DriveKind::displacement || loads_plate(drive);
}

std::vector<std::string> names_of_loads(const Scene& scene) {
  std::vector<std::string> names;
  for (const Traction& traction : scene.traction) names.push_back(traction.name);
  for (const OutlineSide& side : scene.side) {
    if (side.live_pressure != 0.0 || side.live_shear != 0.0) names.push_back(side.name);
  }
  for (const Cutout& cutout : scene.cutout) {
    if (cutout.pressure != 0.0 || cutout.shear != 0.0) names.push_back(cutout.name);
  }
  return names;
}

void check_loads_of(const Scene& scene, const NamedDrive& named, tables::Diagnosis& diagnosis) {
  const Drive& drive = *named.drive;
  const std::string key = named.key + ".loads";
  if (drive.loads.empty() || !diagnosis.good({key, named.key + ".scales"})) return;
  if (drive.kind != DriveKind::load || std::ranges::count(drive.scales, LoadKind::traction) == 0) {
    diagnosis.error(key, "found without traction among what grows",
                    "they grow in a drive of kind load with traction among its scales");
    return;
  }
  const std::vector<std::string> known = names_of_loads(scene);
  const std::vector<std::string_view> views(known.begin(), known.end());
  for (const std::string& name : drive.loads) {
    if (std::ranges::count(known, name) > 0) continue;
    diagnosis.error(key, fmt::format("found \"{}\"", name),
                    views.empty() ? "the scene has no load that could grow"
                                  : fmt::format("loads are {}", tables::joined(views)),
                    tables::nearest_name(name, views));
    return;
  }
}

// A load grows with one drive.
void check_claims(const Scene& scene, const std::vector<NamedDrive>& drives, LoadKind kind,
                  const std::string& name, tables::Diagnosis& diagnosis) {
  const NamedDrive* first = nullptr;
  for (const NamedDrive& drive : drives) {
    if (!grows_with(scene, *drive.drive, kind, name)) continue;
    if (first == nullptr) {
      first = &drive;
      continue;
    }
    const std::string key = drive.key + (drive.drive->loads.empty() ? ".scales" : ".loads");
    const std::string what =
        kind == LoadKind::traction ? fmt::format("\"{}\"", name) : std::string(name_of(kind));
    if (!diagnosis.good({key})) return;
    diagnosis.error(key, fmt::format("lets {} grow, as \"{}\" does", what, first->name),
                    fmt::format("a load grows with one drive: go on with that one by "
                                "drive.name = \"{}\"{}",
                                first->name,
                                kind == LoadKind::traction ? ", or say in loads whose it is" : ""));
    return;
  }
}

std::string place_of_name(const NamedDrive& drive, const tables::Diagnosis& diagnosis) {
  return diagnosis.given(drive.key + ".name") ? drive.key + ".name" : drive.key;
}

void check_not_a_support(const Scene& scene, const NamedDrive& named,
                         tables::Diagnosis& diagnosis) {
  const std::string where = place_of_name(named, diagnosis);
  if (named.drive->kind == DriveKind::none || !diagnosis.good({where})) return;
  if (std::ranges::count(scene.support, named.name, &Support::name) == 0) return;
  diagnosis.error(where, fmt::format("is called \"{}\", as is a support", named.name),
                  "stages release drives and supports, and measures know them, by their names: "
                  "give another one");
}

void check_names_of_drives(const std::vector<NamedDrive>& drives, tables::Diagnosis& diagnosis) {
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const std::string where = place_of_name(drives[d], diagnosis);
    const std::string& name = drives[d].name;
    if (!diagnosis.good({where})) continue;
    for (std::size_t other = 0; other < d; ++other) {
      const bool unused = drives[other].drive->kind == DriveKind::none;
      if (drives[other].name != name || unused) continue;
      diagnosis.error(
          where, fmt::format("is called \"{}\", as is {}", name, drives[other].key),
          "names of drives are unique; a name alone goes on with the drive of that name");
    }
  }
}

bool meet(const Scene& scene, const Drive& one, const Drive& other) {
  if (one.side != other.side || one.level != other.level) return false;
  if (one.range_min.empty() || other.range_min.empty()) return true;
  const double slack = same_place(scene.geometry);
  for (std::size_t k = 0; k < one.range_min.size(); ++k) {
    if (one.range_max[k] <= other.range_min[k] + slack ||
        other.range_max[k] <= one.range_min[k] + slack) {
      return false;
    }
  }
  return true;
}

// What one plate still holds another one cannot move.
void check_plates_apart(const Scene& scene, const std::vector<NamedDrive>& drives,
                        tables::Diagnosis& diagnosis) {
  const auto courses = courses_of_drives(scene);
  for (std::size_t s = 0; s < courses.size(); ++s) {
    const StageDrives& now = courses[s];
    if (!now.in_force || !is_plate(*drives[*now.in_force].drive)) continue;
    for (std::size_t d = 0; d < drives.size(); ++d) {
      if (d == *now.in_force || !now.acts[d] || !is_plate(*drives[d].drive)) continue;
      if (!meet(scene, *drives[*now.in_force].drive, *drives[d].drive)) continue;
      diagnosis.error(drives[*now.in_force].key,
                      fmt::format("lies where \"{}\" still holds the side", drives[d].name),
                      fmt::format("release = [\"{0}\"], or go on with it by drive.name = \"{0}\"",
                                  drives[d].name));
      return;
    }
  }
}

// One that begins later, or comes back: the ground has moved, and images would not know it.
void check_later(const Scene& scene, const std::vector<NamedDrive>& drives,
                 tables::Diagnosis& diagnosis) {
  const auto courses = courses_of_drives(scene);
  for (std::size_t s = 1; s < courses.size(); ++s) {
    if (!courses[s].in_force || courses[s].since[*courses[s].in_force] == 0) continue;
    const NamedDrive& drive = drives[*courses[s].in_force];
    const std::string key = drive.key + ".method";
    if (drive.drive->kind != DriveKind::displacement ||
        drive.drive->method != DriveMethod::ghosts || !diagnosis.good({key})) {
      continue;
    }
    diagnosis.error(
        key, fmt::format("found ghosts, and \"{}\" begins after the first stage", drive.name),
        "images would be where they were before anything moved: allowed are auto, "
        "direct, contact and tied");
    return;
  }
}

// The scene as if a drive were its only one, with the supports that hold while it acts.
Scene as_only_drive(const Scene& scene, const NamedDrive& named, std::size_t number) {
  Scene with_it = scene;
  with_it.drive = *named.drive;
  const auto courses = courses_of_drives(scene);
  for (Support& support : with_it.support) {
    bool beside = false;
    for (std::size_t s = 0; s < courses.size(); ++s) {
      beside = beside || (courses[s].acts[number] && holds_in_stage(scene, s, support.name));
    }
    if (!beside) support.directions.clear();
  }
  return with_it;
}

void check_own(const Scene& scene, const NamedDrive& named, std::size_t number,
               tables::Diagnosis& diagnosis) {
  const Scene with_it = as_only_drive(scene, named, number);
  tables::Diagnosis inner = diagnosis.with_table_as(named.key, "drive");
  check_drive(with_it, inner);
  check_drive_in_place(with_it, inner);
  diagnosis.take(inner, named.key, "drive");
}

// What names a drive there is none of, or says more of one that there is.
void check_kind(const Scene& scene, const std::vector<NamedDrive>& drives, std::size_t s,
                tables::Diagnosis& diagnosis) {
  const auto& own = scene.stage[s].drive;
  const std::string table = fmt::format("stage.{}.drive", s);
  if (!own || *own == Drive()) {
    const bool is_empty = diagnosis.given(table) && !diagnosis.given(table + ".kind");
    const bool is_good = std::ranges::none_of(
        diagnosis.errors(), [&](const auto& error) { return error.key.starts_with(table); });
    if (!is_empty || !is_good) return;
    diagnosis.error(table, "has neither kind nor name",
                    "a new drive needs its kind, displacement or load, one that goes on its name; "
                    "kind = \"none\" ends the one in force");
    return;
  }
  if (own->kind != DriveKind::none || is_reference(scene, s)) return;
  if (!diagnosis.good({table, table + ".name", table + ".kind"})) return;
  std::vector<std::string_view> names;
  for (const NamedDrive& drive : drives) {
    const bool before = drive.key == "drive" || drive.stage < s;
    if (before && drive.drive->kind != DriveKind::none) names.push_back(drive.name);
  }
  Drive bare;
  bare.name = own->name;
  if (*own == bare && !names.empty()) {
    diagnosis.error(
        table + ".name", fmt::format("found \"{}\"", own->name),
        fmt::format("drives before are {}; a new one has its kind", tables::joined(names)),
        tables::nearest_name(own->name, names));
    return;
  }
  diagnosis.error(
      table + ".kind", diagnosis.given(table + ".kind") ? "found none" : "is missing",
      "a new drive needs it, displacement or load; one that goes on has nothing but its "
      "name");
}

}  // namespace

void check_drives(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto drives = drives_of(scene);
  for (const NamedDrive& drive : drives) {
    check_loads_of(scene, drive, diagnosis);
    check_not_a_support(scene, drive, diagnosis);
  }
  if (!scene.stage.empty()) {
    check_drive_in_place(as_only_drive(scene, drives.front(), 0), diagnosis);
  }
  for (std::size_t s = 0; s < scene.stage.size(); ++s) check_kind(scene, drives, s, diagnosis);
  if (!has_stage_drives(scene)) return;
  for (std::size_t d = 1; d < drives.size(); ++d) check_own(scene, drives[d], d, diagnosis);
  if (!diagnosis.errors().empty()) return;
  check_names_of_drives(drives, diagnosis);
  for (const std::string& name : names_of_loads(scene)) {
    check_claims(scene, drives, LoadKind::traction, name, diagnosis);
  }
  check_claims(scene, drives, LoadKind::gravity, "", diagnosis);
  check_plates_apart(scene, drives, diagnosis);
  check_later(scene, drives, diagnosis);
  for (const StageDrives& course : courses_of_drives(scene)) {
    if (course.in_force == 0U || scene.drive.kind == DriveKind::none) return;
  }
  diagnosis.warning("drive.kind",
                    fmt::format("found {}, which no stage is driven by", name_of(scene.drive.kind)),
                    "all stages have drives of their own: leave it out, or go on with it by name");
}

}  // namespace scene

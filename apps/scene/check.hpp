#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.hpp"
#include "tables/diagnosis.hpp"

namespace constitutive {
struct MaterialParameters;
}  // namespace constitutive

namespace scene {

/// Judges the rules that join several keys; single keys have been judged when they were read. A
/// rule is silent when one of its keys is already bad.
void check_scene(const Scene& scene, tables::Diagnosis& diagnosis);

/// Judges what a scene says of its mesh, before regions are joined.
/// @param dimension  of the mesh; 0: there is none
void check_mesh(const Scene& scene, int dimension, tables::Diagnosis& diagnosis);

// The parts of check_scene.
void check_geometry(const Scene& scene, tables::Diagnosis& diagnosis);
void check_cutouts(const Scene& scene, tables::Diagnosis& diagnosis);
void check_grading(const Scene& scene, tables::Diagnosis& diagnosis);
void check_materials(const Scene& scene, tables::Diagnosis& diagnosis);
void check_interfaces(const Scene& scene, tables::Diagnosis& diagnosis);
void check_hourglass(const Scene& scene, tables::Diagnosis& diagnosis);
void check_boundaries(const Scene& scene, tables::Diagnosis& diagnosis);
void check_loads(const Scene& scene, tables::Diagnosis& diagnosis);
void check_initial_stress(const Scene& scene, tables::Diagnosis& diagnosis);
void check_layers(const Scene& scene, tables::Diagnosis& diagnosis);
void check_uniform_stress(const Scene& scene, tables::Diagnosis& diagnosis);
void check_quake(const Scene& scene, tables::Diagnosis& diagnosis);
void check_water(const Scene& scene, tables::Diagnosis& diagnosis);
void check_drive(const Scene& scene, tables::Diagnosis& diagnosis);
void check_reduction(const Scene& scene, tables::Diagnosis& diagnosis);
void check_drives(const Scene& scene, tables::Diagnosis& diagnosis);
void check_stages(const Scene& scene, tables::Diagnosis& diagnosis);
void check_materials_of_stage(const Scene& scene, std::size_t stage, tables::Diagnosis& diagnosis);
void check_plate(const Scene& scene, tables::Diagnosis& diagnosis);
void check_places(const Scene& scene, tables::Diagnosis& diagnosis);
void check_measures(const Scene& scene, tables::Diagnosis& diagnosis);
void check_run(const Scene& scene, tables::Diagnosis& diagnosis);

/// The part of check_places that is about the drive.
void check_drive_in_place(const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether `point` has one entry per dimension; reports otherwise. An empty (absent) point passes.
bool check_length(const Point& point, std::size_t wanted, const std::string& key,
                  const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether the box of `table`.region_min/region_max is whole, not empty and meets the body; reports
/// otherwise. Both absent passes.
bool check_region(const Point& region_min, const Point& region_max, const std::string& table,
                  const Scene& scene, tables::Diagnosis& diagnosis);

/// Reports values of a material that change from place to place and are less than allowed in some.
void check_varying(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis);
/// Parameters of a material with the least strength that it has anywhere, for rules that join them.
/// What a linear value comes to, and how much it may dilate, is `check_varying`'s.
[[nodiscard]] constitutive::MaterialParameters least_parameters(const Scene& scene,
                                                                std::size_t index,
                                                                const tables::Diagnosis& diagnosis);
/// Where a material would dilate by more than its friction angle, `has 20, and dilates by 25`; ""
/// if it does nowhere. Of two that are told by samples one must not exceed the other anywhere,
/// unless they are the same.
[[nodiscard]] std::string dilation_objection(const Scene& scene, std::size_t index,
                                             const tables::Diagnosis& diagnosis);
/// [deg] The largest friction angle of a material, 0 if it has none.
[[nodiscard]] double most_friction(const Scene& scene, std::size_t index,
                                   const tables::Diagnosis& diagnosis);

/// Whether a place is whole and in the body; reports otherwise. An empty (absent) one passes.
bool check_at(const Point& at, const std::string& key, const Scene& scene,
              tables::Diagnosis& diagnosis);

/// Whether a part of a side, `table`.range_min/range_max, is whole, not empty and within the side;
/// reports otherwise. Both absent (the whole side) passes.
bool check_range(Side side, const Point& range_min, const Point& range_max,
                 const std::string& table, const Scene& scene, tables::Diagnosis& diagnosis);

/// Reports a part of a side that is driven, pushed or loaded, if it is none or has no particles.
void check_driven_part(const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether a side exists in this dimension; reports otherwise.
bool check_side(Side side, const std::string& key, const Scene& scene,
                tables::Diagnosis& diagnosis);

/// `stage.2.name`.
[[nodiscard]] std::string key_of_stage(std::size_t stage, const char* name);

/// The names of those that have one.
template <class Entry>
std::vector<std::string_view> names_of_all(const std::vector<Entry>& entries) {
  std::vector<std::string_view> names;
  for (const Entry& entry : entries) {
    if (!entry.name.empty()) names.push_back(entry.name);
  }
  return names;
}

/// Whether all of a list are among the known names of `what`; reports the first that is not.
bool check_known(const std::vector<std::string>& list, const std::vector<std::string_view>& known,
                 const std::string& key, const char* what, tables::Diagnosis& diagnosis);

/// Refuses a name that an earlier entry of `table` has.
template <class Entry>
void check_names(const std::vector<Entry>& entries, const char* table,
                 tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t other = 0; other < i && !entries[i].name.empty(); ++other) {
      if (entries[other].name != entries[i].name) continue;
      diagnosis.error(fmt::format("{}.{}.name", table, i),
                      fmt::format("found \"{}\" again", entries[i].name),
                      fmt::format("names of {}s are unique", table));
      break;
    }
  }
}

/// Whether the box itself is well formed, so that places can be compared with it.
[[nodiscard]] bool box_is_good(const Scene& scene, const tables::Diagnosis& diagnosis);

}  // namespace scene

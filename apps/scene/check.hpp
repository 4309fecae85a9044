#pragma once

#include "scene/scene.hpp"
#include "tables/problem.hpp"

namespace scene {

/// Judges the rules that join several keys; single keys have been judged when they were read. A
/// rule is silent when one of its keys is already bad.
void check_scene(const Scene& scene, tables::Diagnosis& diagnosis);

// The parts of check_scene.
void check_geometry(const Scene& scene, tables::Diagnosis& diagnosis);
void check_materials(const Scene& scene, tables::Diagnosis& diagnosis);
void check_hourglass(const Scene& scene, tables::Diagnosis& diagnosis);
void check_boundaries(const Scene& scene, tables::Diagnosis& diagnosis);
void check_loads(const Scene& scene, tables::Diagnosis& diagnosis);
void check_drive(const Scene& scene, tables::Diagnosis& diagnosis);
void check_measures(const Scene& scene, tables::Diagnosis& diagnosis);
void check_run(const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether `point` has one entry per dimension; reports otherwise. An empty (absent) point passes.
bool check_length(const Point& point, std::size_t wanted, const std::string& key,
                  const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether the box of `table`.region_min/region_max is whole, not empty and meets the body; reports
/// otherwise. Both absent passes.
bool check_region(const Point& region_min, const Point& region_max, const std::string& table,
                  const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether a part of a side, `table`.range_min/range_max, is whole, not empty and within the side;
/// reports otherwise. Both absent (the whole side) passes.
bool check_range(Side side, const Point& range_min, const Point& range_max,
                 const std::string& table, const Scene& scene, tables::Diagnosis& diagnosis);

/// Whether a side exists in this dimension; reports otherwise.
bool check_side(Side side, const std::string& key, const Scene& scene,
                tables::Diagnosis& diagnosis);

/// Whether the box itself is well formed, so that places can be compared with it.
[[nodiscard]] bool box_is_good(const Scene& scene, const tables::Diagnosis& diagnosis);

}  // namespace scene

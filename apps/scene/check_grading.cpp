#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/grading.hpp"
#include "scene/names.hpp"

namespace scene {

namespace {

/// Whether a length [m] is no finer than the finest spacing; reports otherwise.
void check_not_finer(double value, const std::string& key, const Scene& scene,
                     tables::Diagnosis& diagnosis) {
  const double finest = scene.geometry.spacing;
  if (!diagnosis.good({key, "geometry.spacing"}) || value >= finest - same_place(scene.geometry)) {
    return;
  }
  diagnosis.error(key, fmt::format("found {}", value),
                  fmt::format("it must not be below geometry.spacing, {}, the finest", finest));
}

void check_refine(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Refine& refine = scene.refine[index];
  const std::string table = fmt::format("refine.{}", index);
  const auto key = [&](const char* name) { return table + "." + name; };
  const int ways = (refine.side ? 1 : 0) + (refine.at.empty() ? 0 : 1) +
                   (refine.region_min.empty() && refine.region_max.empty() ? 0 : 1);
  const bool read = diagnosis.good({key("side"), key("at"), key("region_min"), key("region_max")});
  if (ways != 1 && read) {
    diagnosis.error(table,
                    fmt::format("{} of side, region_min with region_max, and at are given",
                                ways == 0 ? "none" : "several"),
                    "exactly one says where particles are fine");
    return;
  }
  if (refine.side) {
    if (check_side(*refine.side, key("side"), scene, diagnosis)) {
      check_range(*refine.side, refine.range_min, refine.range_max, table, scene, diagnosis);
    }
  } else if (!refine.range_min.empty() || !refine.range_max.empty()) {
    diagnosis.error(refine.range_min.empty() ? key("range_max") : key("range_min"),
                    "found without a side", "a range is a part of a side");
  }
  check_region(refine.region_min, refine.region_max, table, scene, diagnosis);
  check_at(refine.at, key("at"), scene, diagnosis);
  if (refine.spacing) check_not_finer(*refine.spacing, key("spacing"), scene, diagnosis);
}

/// Whether coordinates in finest spacings have room in the tree's keys; reports otherwise.
void check_extent(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis) || !diagnosis.good({"geometry.spacing", "geometry.max"})) {
    return;
  }
  const double most = scene.geometry.dimension == 2 ? 0x1.0p29 : 0x1.0p19;
  for (std::size_t i = 0; i < scene.geometry.min.size(); ++i) {
    const double cells = (scene.geometry.max[i] - scene.geometry.min[i]) / scene.geometry.spacing;
    if (cells < most) continue;
    diagnosis.error("geometry.spacing",
                    fmt::format("found {}, which is {:.3g} times in the extent along {}",
                                scene.geometry.spacing, cells, name_of(static_cast<Axis>(i))),
                    fmt::format("allowed are less than {:.0f} where particles are graded", most));
    return;
  }
}

/// Whether there are surfaces that are fine by themselves: cutouts, bores in regions.
bool has_hollows(const Scene& scene) {
  if (scene.region.empty()) return !scene.cutout.empty();
  const Geometry& geometry = scene.geometry;
  return std::isfinite(body_of(scene).distance_to_hollows({geometry.min[0], geometry.min[1]},
                                                          {geometry.max[0], geometry.max[1]}));
}

}  // namespace

void check_grading(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Grading& grading = scene.grading;
  for (std::size_t i = 0; i < scene.refine.size(); ++i) check_refine(scene, i, diagnosis);
  if (!diagnosis.good({"grading.enabled"})) return;
  if (!grading.enabled) {
    if (!scene.refine.empty()) {
      diagnosis.error("refine.0", "found without grading",
                      "particles are refined where grading.enabled = true");
    }
    return;
  }
  if (scene.geometry.layout != Layout::cell && diagnosis.good({"geometry.layout"})) {
    diagnosis.error("grading.enabled", "found true with geometry.layout = \"vertex\"",
                    "graded particles are those of cells: layout = \"cell\"");
  }
  if (grading.coarsest) {
    check_not_finer(*grading.coarsest, "grading.coarsest", scene, diagnosis);
  }
  if (scene.approximation.consistency == Switch::off) {
    diagnosis.warning("approximation.consistency", "found off with graded particles",
                      "loads are wrong by tens of per cent without it where widths change");
  }
  check_extent(scene, diagnosis);
  if (!diagnosis.good({"drive", "traction", "refine", "drive.side", "drive.range_min",
                       "drive.range_max", "geometry.spacing", "geometry.min", "geometry.max"}) ||
      !box_is_good(scene, diagnosis)) {
    return;
  }
  for (std::size_t i = 0; i < scene.traction.size(); ++i) {
    const std::string table = fmt::format("traction.{}", i);
    if (!diagnosis.good({table + ".side", table + ".range_min", table + ".range_max"})) return;
  }
  for (std::size_t i = 0; i < scene.refine.size(); ++i) {
    const std::string table = fmt::format("refine.{}", i);
    if (!diagnosis.good({table, table + ".side", table + ".range_min", table + ".range_max"})) {
      return;
    }
  }
  // No body is known of regions with errors.
  if (fine_places(scene).empty() && (scene.region.empty() || diagnosis.errors().empty()) &&
      !has_hollows(scene)) {
    diagnosis.error("grading.enabled", "found true, and no plate or load ends within a side",
                    "say in [[refine]] where particles are to be fine");
  }
}

}  // namespace scene

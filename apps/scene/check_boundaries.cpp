#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/outline_faces.hpp"
#include "scene/places.hpp"

namespace scene {

namespace {

void check_axis(Axis axis, const std::string& key, const Scene& scene,
                tables::Diagnosis& diagnosis) {
  if (axis == Axis::z && scene.geometry.dimension == 2 &&
      diagnosis.good({key, "geometry.dimension"})) {
    diagnosis.error(key, "found z in 2D", "allowed are x, y");
  }
}

void check_symmetry(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Symmetry& symmetry = scene.symmetry[index];
  const std::string table = fmt::format("symmetry.{}", index);
  check_axis(symmetry.axis, table + ".axis", scene, diagnosis);
  if (!diagnosis.good({table + ".axis", table + ".position", "geometry.spacing"}) ||
      !box_is_good(scene, diagnosis)) {
    return;
  }
  const auto axis = static_cast<std::size_t>(symmetry.axis);
  const double lower = scene.geometry.min[axis], upper = scene.geometry.max[axis];
  const double slack = same_place(scene.geometry);
  if (std::abs(symmetry.position - lower) > slack && std::abs(symmetry.position - upper) > slack) {
    diagnosis.error(table + ".position", fmt::format("found {}", symmetry.position),
                    fmt::format("a mirror is at a face of the body, {} = {} or {}",
                                name_of(symmetry.axis), lower, upper));
    return;
  }
  for (std::size_t other = 0; other < index; ++other) {
    const Symmetry& before = scene.symmetry[other];
    if (before.axis == symmetry.axis && std::abs(before.position - symmetry.position) <= slack) {
      diagnosis.error(table + ".position", fmt::format("found {} again", symmetry.position),
                      fmt::format("it is the mirror of symmetry.{}", other));
    }
  }
}

void check_support_choice(const Scene& scene, const Support& support, const std::string& table,
                          tables::Diagnosis& diagnosis) {
  const int ways = (support.side ? 1 : 0) + (support.at.empty() ? 0 : 1) +
                   (support.region_min.empty() && support.region_max.empty() ? 0 : 1);
  const bool read = diagnosis.good(
      {table + ".side", table + ".at", table + ".region_min", table + ".region_max"});
  if (ways != 1 && read) {
    diagnosis.error(table,
                    fmt::format("{} of side, region_min with region_max, and at are given",
                                ways == 0 ? "none" : "several"),
                    "exactly one chooses the particles");
    return;
  }
  if (support.side) check_side(*support.side, table + ".side", scene, diagnosis);
  check_region(support.region_min, support.region_max, table, scene, diagnosis);
  check_at(support.at, table + ".at", scene, diagnosis);
}

/// What is held by images is a whole side, and across it.
void check_ghosts(const Scene& scene, const Support& support, const std::string& table,
                  tables::Diagnosis& diagnosis) {
  if (support.method != SupportMethod::ghosts) return;
  const std::string key = table + ".method";
  if (!diagnosis.good({key, table + ".side", table + ".directions", table})) return;
  if (!support.side) {
    diagnosis.error(key, "found ghosts without a side",
                    "images lie behind a side: give one, or hold particles by direct");
    return;
  }
  const auto across = static_cast<Axis>(axis_of(*support.side));
  const bool held_across =
      std::any_of(scene.support.begin(), scene.support.end(), [&](const Support& other) {
        const bool images = other.method == SupportMethod::ghosts ||
                            other.method == SupportMethod::automatic;  // which follows
        return other.side == support.side && images &&
               std::count(other.directions.begin(), other.directions.end(), across) > 0;
      });
  if (held_across) return;
  diagnosis.error(key,
                  fmt::format("found ghosts, and {} not among the directions", name_of(across)),
                  "images hold a side across it at least: add the direction, or hold particles by "
                  "direct");
}

/// What touches is a whole side, across it.
void check_contact(const Support& support, const std::string& table, tables::Diagnosis& diagnosis) {
  if (support.method != SupportMethod::contact) return;
  const std::string key = table + ".method";
  if (!diagnosis.good({key, table + ".side", table + ".directions", table})) return;
  if (!support.side) {
    diagnosis.error(key, "found contact without a side", "a body touches at a side: give one");
    return;
  }
  const auto across = static_cast<Axis>(axis_of(*support.side));
  if (support.directions == std::vector<Axis>{across}) return;
  diagnosis.error(table + ".directions", "found others than that across the side",
                  fmt::format("a contact holds along {}; what it does along the side is its "
                              "friction_angle's and adhesion's",
                              name_of(across)));
}

void check_support(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Support& support = scene.support[index];
  const std::string table = fmt::format("support.{}", index);
  check_support_choice(scene, support, table, diagnosis);
  for (const Axis axis : support.directions) {
    check_axis(axis, table + ".directions", scene, diagnosis);
    if (std::count(support.directions.begin(), support.directions.end(), axis) > 1) {
      diagnosis.error(table + ".directions", fmt::format("found {} twice", name_of(axis)),
                      "each direction once");
      break;
    }
  }
  check_ghosts(scene, support, table, diagnosis);
  check_contact(support, table, diagnosis);
}

/// Whether anything keeps the body from moving freely along an axis.
bool is_held(const Scene& scene, Axis axis) {
  for (const Symmetry& symmetry : scene.symmetry) {
    if (symmetry.axis == axis) return true;
  }
  for (const Support& support : scene.support) {
    const auto& d = support.directions;
    if (std::find(d.begin(), d.end(), axis) != d.end()) return true;
  }
  if (!tied_surfaces(scene).empty()) return true;
  if (scene.drive.kind != DriveKind::displacement) return false;
  const auto i = static_cast<std::size_t>(axis);
  return scene.drive.lateral == Lateral::fixed ||
         (i < scene.drive.direction.size() && scene.drive.direction[i] != 0.0);
}

/// Whether a side that lies along an axis is held by contact that bears shear.
bool rubs(const Scene& scene, int axis) {
  return std::ranges::any_of(scene.support, [&](const Support& support) {
    return support.method == SupportMethod::contact && support.side &&
           axis_of(*support.side) != axis &&
           (support.contact.friction_angle > 0.0 || support.contact.adhesion > 0.0);
  });
}

}  // namespace

bool check_side(Side side, const std::string& key, const Scene& scene,
                tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({key, "geometry.dimension"})) return false;
  if (axis_of(side) < scene.geometry.dimension) return true;
  diagnosis.error(key, fmt::format("found {} in 2D", name_of(side)),
                  "allowed are left, right, bottom, top");
  return false;
}

bool check_range(Side side, const Point& range_min, const Point& range_max,
                 const std::string& table, const Scene& scene, tables::Diagnosis& diagnosis) {
  const std::string lower = table + ".range_min", upper = table + ".range_max";
  if (!diagnosis.good({lower, upper, table + ".side"})) return false;
  if (range_min.empty() && range_max.empty()) return true;
  if (range_min.empty() || range_max.empty()) {
    diagnosis.error(range_min.empty() ? lower : upper, "is missing",
                    "a part of a side needs range_min and range_max");
    return false;
  }
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  const bool lower_fits = check_length(range_min, n - 1, lower, scene, diagnosis);
  const bool upper_fits = check_length(range_max, n - 1, upper, scene, diagnosis);
  if (!lower_fits || !upper_fits || !box_is_good(scene, diagnosis)) return false;
  const double slack = same_place(scene.geometry);
  for (std::size_t axis = 0, i = 0; axis < n; ++axis) {
    if (axis == static_cast<std::size_t>(axis_of(side))) continue;
    const double from = scene.geometry.min[axis], to = scene.geometry.max[axis];
    const auto name = name_of(static_cast<Axis>(axis));
    if (range_min[i] >= range_max[i]) {
      diagnosis.error(upper, fmt::format("found {} along {}", range_max[i], name),
                      fmt::format("it must be above range_min, {}", range_min[i]));
      return false;
    }
    if (range_min[i] < from - slack || range_max[i] > to + slack) {
      const bool low = range_min[i] < from - slack;
      diagnosis.error(low ? lower : upper,
                      fmt::format("found {} along {}", low ? range_min[i] : range_max[i], name),
                      fmt::format("the side {} is from {} to {}", name_of(side), from, to));
      return false;
    }
    ++i;
  }
  return true;
}

void check_driven_part(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  if (!check_side(drive.side, "drive.side", scene, diagnosis)) return;
  const bool fits =
      check_range(drive.side, drive.range_min, drive.range_max, "drive", scene, diagnosis);
  if (!fits || drive.range_min.empty() || !diagnosis.good({"geometry.spacing"})) return;
  if (lattice_layer(scene.geometry, drive.side, drive.range_min, drive.range_max).empty()) {
    diagnosis.error("drive.range_max", "no particle lies between range_min and range_max",
                    fmt::format("particles are {} apart", scene.geometry.spacing));
  }
}

void check_boundaries(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!scene.symmetry.empty() && scene.geometry.layout == Layout::vertex &&
      diagnosis.good({"geometry.layout", "symmetry"})) {
    diagnosis.error("symmetry.0", "found with geometry.layout = \"vertex\"",
                    "particles must not lie on the mirror: use layout = \"cell\", or a support "
                    "that fixes the normal direction");
  }
  for (std::size_t i = 0; i < scene.symmetry.size(); ++i) check_symmetry(scene, i, diagnosis);
  for (std::size_t i = 0; i < scene.support.size(); ++i) check_support(scene, i, diagnosis);
  check_names(scene.support, "support", diagnosis);
  if (!diagnosis.good({"geometry.dimension", "support", "symmetry", "drive"})) return;
  for (int i = 0; i < scene.geometry.dimension; ++i) {
    if (is_held(scene, static_cast<Axis>(i))) continue;
    if (rubs(scene, i)) {
      diagnosis.warning(
          "support",
          fmt::format("only friction holds the body along {}", name_of(static_cast<Axis>(i))),
          "where it slides, the forces along it are right to solver.tolerance of the largest there "
          "are: take 1e-5 for pushes far below the weight");
      continue;
    }
    diagnosis.warning("support",
                      fmt::format("nothing holds the body along {}", name_of(static_cast<Axis>(i))),
                      "without a support, a symmetry or a fixed drive it moves freely");
  }
}

}  // namespace scene

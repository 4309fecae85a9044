// Rules on a rigid plate that only touches the body: where it is pushed, and what it may be loaded
// by.
#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/places.hpp"

namespace scene {

namespace {

bool sticks(const Drive& drive) {
  const Contact& contact = drive.contact;
  if (drive.method == DriveMethod::tied) return drive.lateral == Lateral::fixed;
  return contact.friction_angle > 0.0 || contact.adhesion > 0.0;
}

// Axes along a side, in their order.
std::vector<std::size_t> axes_along(const Scene& scene, Side side) {
  std::vector<std::size_t> axes;
  for (int i = 0; i < scene.geometry.dimension; ++i) {
    if (i != axis_of(side)) axes.push_back(static_cast<std::size_t>(i));
  }
  return axes;
}

void check_at(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  const std::string key = "drive.at";
  if (drive.at.empty() || !diagnosis.good({key, "drive.side", "drive.method"})) return;
  if (drive.kind == DriveKind::none || !is_rigid_body(drive)) {
    diagnosis.error(key, "found without a plate that only touches",
                    "a plate turns that is pushed or loaded by method = \"contact\", or tied");
    return;
  }
  const auto axes = axes_along(scene, drive.side);
  if (!check_length(drive.at, axes.size(), key, scene, diagnosis) ||
      !box_is_good(scene, diagnosis) || !diagnosis.good({"drive.range_min", "drive.range_max"})) {
    return;
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const std::size_t axis = axes[k];
    const auto name = name_of(static_cast<Axis>(axis));
    const double from = drive.range_min.empty() ? scene.geometry.min[axis] : drive.range_min[k];
    const double to = drive.range_max.empty() ? scene.geometry.max[axis] : drive.range_max[k];
    const double slack = same_place(scene.geometry);
    if (drive.at[k] < from - slack || drive.at[k] > to + slack) {
      diagnosis.error(key, fmt::format("found {} along {}", drive.at[k], name),
                      fmt::format("the plate is from {} to {}", from, to));
    }
    for (const Symmetry& symmetry : scene.symmetry) {
      const bool halves = static_cast<std::size_t>(symmetry.axis) == axis &&
                          (std::abs(symmetry.position - from) <= slack ||
                           std::abs(symmetry.position - to) <= slack);
      if (!halves) continue;
      diagnosis.error(key, fmt::format("found for a plate that a mirror across {} halves", name),
                      "the whole one does not turn: leave it out, or model the whole plate");
    }
  }
}

void check_force(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  const std::string key = "drive.force";
  if (!diagnosis.good({key, "drive.side", "drive.scales"})) return;
  if (!loads_plate(drive)) {
    if (drive.force.empty()) return;
    diagnosis.error(key, "found without a loaded plate",
                    "give kind = \"load\" and scales = [\"plate\"], or leave it out");
    return;
  }
  if (!is_rigid_body(drive) && diagnosis.good({"drive.method"})) {
    diagnosis.error("drive.method",
                    fmt::format("found {} with a loaded plate", name_of(drive.method)),
                    "it is a body of its own: use contact, or tied");
  }
  if (drive.force.empty()) {
    diagnosis.error(key, "is missing", "a loaded plate needs its force, [0, -1e3] presses down");
    return;
  }
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  if (!check_length(drive.force, n, key, scene, diagnosis)) return;
  const bool guided = drive.lateral == Lateral::fixed || !sticks(drive);
  for (const std::size_t axis : axes_along(scene, drive.side)) {
    if (drive.force[axis] == 0.0 || !guided) continue;
    diagnosis.error(
        key, fmt::format("found {} along {}", drive.force[axis], name_of(static_cast<Axis>(axis))),
        "along its side a plate takes it with lateral = \"free\" and friction or adhesion "
        "only");
    return;
  }
}

}  // namespace

void check_plate(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_at(scene, diagnosis);
  check_force(scene, diagnosis);
  const Drive& drive = scene.drive;
  if (!loads_plate(drive) || !diagnosis.good({"drive.side", "drive.scales"})) return;
  check_driven_part(scene, diagnosis);
}

}  // namespace scene

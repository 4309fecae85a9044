// Rules on where things are: whom a region holds, who is held and moved at once, what lies on a
// mirror.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"
#include "scene/places.hpp"

namespace scene {

namespace {

void refuse_empty(const LatticeBox& box, const std::string& table, const Scene& scene,
                  tables::Diagnosis& diagnosis) {
  if (!box.empty()) return;
  diagnosis.error(table + ".region_min", "no particle lies between region_min and region_max",
                  fmt::format("particles are {} apart", scene.geometry.spacing));
}

void check_regions(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto region_is_good = [&](const std::string& table) {
    return diagnosis.good({table + ".region_min", table + ".region_max", table});
  };
  for (std::size_t i = 1; i < scene.material.size(); ++i) {
    const Material& material = scene.material[i];
    const std::string table = fmt::format("material.{}", i);
    if (material.region_min.empty() || !region_is_good(table)) continue;
    refuse_empty(lattice_box(scene.geometry, material.region_min, material.region_max), table,
                 scene, diagnosis);
  }
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const std::string table = fmt::format("support.{}", i);
    if (scene.support[i].region_min.empty() || !region_is_good(table)) continue;
    refuse_empty(lattice_box(scene.geometry, scene.support[i]), table, scene, diagnosis);
  }
}

/// A drive and a support may not both say how far a particle moves along an axis.
void check_held_and_moved(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  if (drive.kind != DriveKind::displacement || !diagnosis.good({"drive"})) return;
  if (drive.level) return;  // its particles are those of no face of the box
  if (!diagnosis.good({"drive.direction", "drive.side", "drive.range_min", "drive.range_max"})) {
    return;
  }
  const LatticeBox moved =
      lattice_layer(scene.geometry, drive.side, drive.range_min, drive.range_max);
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const Support& support = scene.support[i];
    const std::string table = fmt::format("support.{}", i);
    const bool read = diagnosis.good({table, table + ".side", table + ".at", table + ".region_min",
                                      table + ".region_max", table + ".directions"});
    if (!read || !moved.meets(lattice_box(scene.geometry, support))) continue;
    for (const Axis axis : support.directions) {
      if (drive.direction[static_cast<std::size_t>(axis)] == 0.0) continue;
      diagnosis.error(
          table + ".directions",
          fmt::format("found {}, along which the drive moves some of its particles", name_of(axis)),
          "a particle is held or moved: leave out the direction, or end the range of "
          "the drive or the support before the other");
    }
  }
}

/// Nothing moves through a mirror, and what presses on it is borne by the other half.
void check_mirrors(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"symmetry"})) return;
  for (std::size_t i = 0; i < scene.traction.size(); ++i) {
    const Traction& traction = scene.traction[i];
    const std::string table = fmt::format("traction.{}", i);
    if (!diagnosis.good({table + ".side", table + ".value"}) || !is_mirror(scene, traction.side) ||
        traction.value[static_cast<std::size_t>(axis_of(traction.side))] == 0.0) {
      continue;
    }
    diagnosis.error(table + ".side",
                    fmt::format("found {}, which is a mirror", name_of(traction.side)),
                    "a normal traction on a mirror does nothing: the other half bears it");
  }
}

void check_not_through_mirror(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  const bool moves = drive.kind == DriveKind::displacement &&
                     diagnosis.good({"symmetry", "drive.side", "drive.direction"}) &&
                     is_mirror(scene, drive.side) &&
                     drive.direction[static_cast<std::size_t>(axis_of(drive.side))] != 0.0;
  if (moves) {
    diagnosis.error("drive.side", fmt::format("found {}, which is a mirror", name_of(drive.side)),
                    "no particle moves through a mirror: drive another side");
  }
}

/// Whether a support holds its side by images, and is read.
bool has_images(const Support& support, const std::string& table,
                const tables::Diagnosis& diagnosis) {
  return support.method == SupportMethod::ghosts && support.side &&
         diagnosis.good({table + ".side", table + ".method"});
}

/// A side has images once: of a mirror, of the drive, or of its supports.
void check_images(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"symmetry"})) return;
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const std::string table = fmt::format("support.{}", i);
    if (!has_images(scene.support[i], table, diagnosis)) continue;
    if (!is_mirror(scene, *scene.support[i].side)) continue;
    diagnosis.error(table + ".method", "found ghosts on a mirror",
                    "it has images of its own, which hold the side across it: leave the support "
                    "out, or use direct");
  }
}

/// Particles next to a mirror would stay where they are, half a spacing within.
void check_supports_on_mirrors(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"symmetry"})) return;
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const Support& support = scene.support[i];
    const std::string table = fmt::format("support.{}", i);
    if (!support.side || support.method != SupportMethod::automatic) continue;
    if (!diagnosis.good({table + ".side", table + ".method", table + ".directions"})) continue;
    const auto across = static_cast<Axis>(axis_of(*support.side));
    if (!is_mirror(scene, *support.side)) continue;
    if (std::ranges::count(support.directions, across) == 0) continue;
    diagnosis.error(table + ".directions",
                    fmt::format("found {}, which is across a mirror", name_of(across)),
                    "the mirror holds its side across: leave the direction out, or name the "
                    "method direct");
  }
}

void check_images_of_drive(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  if (drive.kind != DriveKind::displacement || drive.method != DriveMethod::ghosts) return;
  if (!diagnosis.good({"symmetry", "drive.side", "drive.method"})) return;
  if (is_mirror(scene, drive.side)) {
    diagnosis.error("drive.method", "found ghosts on a mirror",
                    "it has images of its own: drive another side, or by direct");
    return;
  }
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const Support& support = scene.support[i];
    const std::string table = fmt::format("support.{}", i);
    const bool holds = !support.directions.empty();  // not of one that is gone while it is driven
    if (!holds || !has_images(support, table, diagnosis) || drive.side != *support.side) continue;
    diagnosis.error(table + ".method", "found ghosts on the side that the drive moves by ghosts",
                    "a side has images once: let the drive hold it by lateral = \"fixed\", or use "
                    "direct");
  }
}

}  // namespace

void check_places(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis)) return;
  if (!diagnosis.good({"geometry.spacing", "geometry.layout", "geometry.jitter"})) return;
  check_regions(scene, diagnosis);
  // With stages each drive is judged beside the supports that hold while it acts (check_drives).
  if (scene.stage.empty()) check_drive_in_place(scene, diagnosis);
  check_mirrors(scene, diagnosis);
  check_images(scene, diagnosis);
  check_supports_on_mirrors(scene, diagnosis);
}

void check_drive_in_place(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis)) return;
  if (!diagnosis.good({"geometry.spacing", "geometry.layout", "geometry.jitter"})) return;
  check_held_and_moved(scene, diagnosis);
  check_not_through_mirror(scene, diagnosis);
  check_images_of_drive(scene, diagnosis);
}

}  // namespace scene

#include "scene/complete.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "scene/box.hpp"
#include "scene/check.hpp"
#include "scene/complete_elements.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"
#include "tables/nearest_name.hpp"
#include "tables/table.hpp"

namespace scene {
namespace {

constexpr double earth = 9.81;  // [m/s2]

double size_of(const Point& vector) {
  double square = 0.0;
  for (const double x : vector) square += x * x;
  return std::sqrt(square);
}

// Whether two numbers are told alike and are the same, but for rounding.
bool agree(const tables::VaryingNumber& one, const tables::VaryingNumber& other) {
  constexpr double round_off = 1e-9;
  const auto near = [](double a, double b) { return std::abs(a - b) <= round_off * std::abs(a); };
  if (one.is_linear() != other.is_linear() || !near(one.value, other.value)) return false;
  if (one.is_linear()) {
    return one.at == other.at && std::ranges::equal(one.gradient, other.gradient, near);
  }
  tables::Samples same = *one.samples;
  if (!std::ranges::equal(same.values, other.samples->values, near)) return false;
  same.values = other.samples->values;
  return same == *other.samples;
}

// Unit weights are densities, and without [gravity] gravity is the earth's, aslant in an
// earthquake.
void complete_weights(Scene& scene, tables::Diagnosis& diagnosis) {
  const bool weighs = std::ranges::any_of(scene.material, [](const Material& material) {
    return material.unit_weight &&
           (material.unit_weight->value > 0.0 || material.unit_weight->varies());
  });
  if (!weighs || !diagnosis.good({"material", "gravity", "gravity.acceleration", "load.kh",
                                  "load.kv", "geometry.dimension"})) {
    return;
  }
  const bool shaken = scene.load.sought != Sought::earthquake;
  Point& acceleration = scene.gravity.acceleration;
  if (acceleration.empty()) {
    acceleration.assign(static_cast<std::size_t>(scene.geometry.dimension), 0.0);
    acceleration[0] = shaken ? earth * scene.load.kh : 0.0;
    acceleration[1] = earth * (scene.load.kv - 1.0);
  }
  // Of the ground at rest: the weight aslant is more.
  const double kh = shaken ? scene.load.kh : 0.0;
  const double still = size_of(acceleration) / std::hypot(kh, scene.load.kv - 1.0);
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    Material& material = scene.material[i];
    const std::string key = fmt::format("material.{}.unit_weight", i);
    if (!material.unit_weight || !diagnosis.good({key, fmt::format("material.{}.density", i)})) {
      continue;
    }
    const auto density =
        still > 0.0 ? material.unit_weight->scaled(1.0, still) : tables::VaryingNumber();
    if (material.density == tables::VaryingNumber()) {
      material.density = density;
    } else if (!agree(density, material.density)) {
      diagnosis.error(key,
                      fmt::format("found {:g}, and a density of {:g}", material.unit_weight->value,
                                  material.density.value),
                      fmt::format("it would be {:.6g} with gravity's {:.6g} m/s2: give one of them",
                                  material.density.value * still, still));
    }
  }
}

// Whether prisms have their length.
bool complete_depth(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Point& depth = scene.geometry.depth;
  if (!diagnosis.good({"geometry.depth", "geometry.dimension"})) return false;
  if (depth.size() == 2 && depth[0] < depth[1]) return true;
  diagnosis.error("geometry.depth",
                  depth.empty() ? "is missing, with a [[region]] in 3D" : "is no length along z",
                  "regions of polygons in 3D are prisms: needed is [from, to] along z [m], from "
                  "below to; other bodies are volumes of a solid mesh");
  return false;
}

// What only a body of regions has or has not.
bool is_ground(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (scene.region.empty()) {
    if (!scene.side.empty()) {
      diagnosis.error("side.0", "found without a [[region]]",
                      "sides are parts of the outline of regions; the faces of a box are left, "
                      "right, bottom, top");
    }
    for (const char* key : {"geometry.min", "geometry.max"}) {
      const Point& corner = key[10] == 'i' ? scene.geometry.min : scene.geometry.max;
      if (corner.empty() && diagnosis.good({key, "geometry"})) {
        diagnosis.error(key, "is missing",
                        "needed is a list of numbers [m], unless [[region]]s are the body");
      }
    }
    return false;
  }
  const auto refuse = [&](bool refused, const std::string& key, const std::string& found,
                          const std::string& allowed) {
    if (refused && diagnosis.good({key})) diagnosis.error(key, found, allowed);
  };
  if (is_extruded(scene) && !complete_depth(scene, diagnosis)) return false;
  refuse(!is_extruded(scene) && !scene.geometry.depth.empty(), "geometry.depth",
         is_solid(scene) ? "found with volumes of a mesh" : "found in a plane",
         "it belongs to polygons in dimension 3");
  refuse(is_extruded(scene) && scene.geometry.jitter > 0.0, "geometry.jitter",
         "found with regions in 3D", "particles of prisms are not moved");
  refuse(scene.geometry.layout != Layout::cell, "geometry.layout", "found vertex with a [[region]]",
         "particles of regions are those of cells: layout = \"cell\"");
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const Material& material = scene.material[i];
    refuse(
        !material.region_min.empty() || !material.region_max.empty(),
        fmt::format("material.{}.{}", i, material.region_min.empty() ? "region_max" : "region_min"),
        "found in a body of regions", "a [[region]] says where its material is");
  }
  return diagnosis.good({"geometry.dimension", "geometry.layout", "region", "side"});
}

void check_regions(const Scene& scene, tables::Diagnosis& diagnosis) {
  std::vector<std::string_view> names;
  for (const Material& material : scene.material) names.push_back(material.name);
  for (std::size_t r = 0; r < scene.region.size(); ++r) {
    const std::string key = fmt::format("region.{}.material", r);
    const std::string& name = scene.region[r].material;
    if (!diagnosis.good({key}) || std::ranges::count(names, std::string_view(name)) > 0) continue;
    diagnosis.error(key, fmt::format("found \"{}\"", name),
                    "materials are " + tables::joined(names), tables::nearest_name(name, names));
  }
}

void check_sides(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_names(scene.side, "side", diagnosis);
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    const OutlineSide& side = scene.side[i];
    const auto key = [&](const char* name) { return fmt::format("side.{}.{}", i, name); };
    const auto belongs = [&](const char* name, bool is_given, bool allowed, const char* to) {
      if (!is_given || allowed || !diagnosis.good({key("kind"), key(name)})) return;
      diagnosis.error(key(name), fmt::format("given for a side of kind {}", name_of(side.kind)),
                      fmt::format("it belongs to {}", to));
    };
    const bool loaded = side.kind == OutlineKind::loaded;
    const bool footing = side.kind == OutlineKind::footing;
    belongs("pressure", side.pressure != 0.0, loaded, "kind loaded");
    belongs("shear", side.shear != 0.0, loaded, "kind loaded");
    belongs("live_pressure", side.live_pressure != 0.0, loaded, "kind loaded");
    belongs("live_shear", side.live_shear != 0.0, loaded, "kind loaded");
    belongs("base", side.base != Base::rough, footing, "kind footing");
    belongs("tension", !side.tension, footing, "kind footing");
    if (side.along.size() == 1) {
      diagnosis.error(key("along"), "found one point", "allowed are 2 or more");
    }
    const bool grows = scene::grows(scene, LoadKind::traction, side.name);
    for (const auto& [name, value] : {std::pair("live_pressure", side.live_pressure),
                                      std::pair("live_shear", side.live_shear)}) {
      if (value == 0.0 || grows || !diagnosis.good({key(name), "drive.kind", "drive.scales"}))
        continue;
      diagnosis.error(key(name), fmt::format("found {}, which nothing lets grow", value),
                      "it grows in a drive of kind load with traction among its scales; what is "
                      "there from the start is pressure or shear");
    }
  }
}

// The box around regions: their lower corner, and a whole number of spacings to their upper one.
void complete_box(Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"geometry.spacing", "geometry.min", "geometry.max"})) return;
  Point low(2, std::numeric_limits<double>::infinity()), high(2, -low[0]);
  const std::size_t n = is_extruded(scene) ? 3 : 2;
  for (const Region& region : scene.region) {
    for (const PlanePoint& place : region.outline) {
      low = {std::min(low[0], place.x()), std::min(low[1], place.y())};
      high = {std::max(high[0], place.x()), std::max(high[1], place.y())};
    }
  }
  Geometry& geometry = scene.geometry;
  if (n == 3) {
    low.push_back(geometry.depth[0]);
    high.push_back(geometry.depth[1]);
  }
  if (geometry.min.empty()) geometry.min = low;
  if (geometry.min.size() != n) return;
  if (geometry.max.empty()) {
    constexpr double round_off = 1e-9;
    constexpr double most_cells = 1e9;
    for (std::size_t i = 0; i < n; ++i) {
      const double cells = (high[i] - geometry.min[i]) / geometry.spacing;
      const bool is_whole = std::abs(cells - std::round(cells)) <= round_off * cells;
      geometry.max.push_back(is_whole || cells > most_cells || i == 2
                                 ? high[i]
                                 : geometry.min[i] + std::ceil(cells) * geometry.spacing);
    }
  }
  if (geometry.max.size() != n) return;
  const double slack = same_place(geometry);
  for (std::size_t i = 0; i < n; ++i) {
    const bool below = geometry.min[i] > low[i] + slack;
    if (!below && geometry.max[i] >= high[i] - slack) continue;
    diagnosis.error(below ? "geometry.min" : "geometry.max",
                    fmt::format("regions reach beyond it, to {} along {}", below ? low[i] : high[i],
                                name_of(static_cast<Axis>(i))),
                    "the box holds all regions: leave it out");
    return;
  }
}

// From which level to which each region goes.
void complete_levels(Scene& scene, const std::optional<ElementBody>& elements) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (Region& region : scene.region) {
    region.lowest = infinity;
    region.highest = -infinity;
  }
  const auto reach = [&](Region& region, double y) {
    region.lowest = std::min(region.lowest, y);
    region.highest = std::max(region.highest, y);
  };
  if (!is_solid(scene)) {
    for (Region& region : scene.region) {
      for (const PlanePoint& place : region.outline) reach(region, place.y());
    }
    return;
  }
  for (const shape::MeshPart& part : elements->joined.parts) {
    Region& region = scene.region[static_cast<std::size_t>(part.region)];
    for (const int node : elements->mesh.elements[static_cast<std::size_t>(part.element)].nodes) {
      reach(region, elements->mesh.at(node).y());
    }
  }
}

void complete_supports(Scene& scene, const OutlineFaces& faces) {
  std::vector<Axis> all{Axis::x, Axis::y};
  if (scene.geometry.dimension == 3) all.push_back(Axis::z);
  for (int f = 0; f < 2 * scene.geometry.dimension; ++f) {
    const auto face = static_cast<Side>(f);
    const auto holders = faces.holders_of(face);
    if (holders.empty()) continue;
    const OutlineKind kind = scene.side[holders.front()].kind;
    const auto across = static_cast<Axis>(axis_of(face));
    if (kind == OutlineKind::symmetry) {
      if (!is_mirror(scene, face)) {
        scene.symmetry.push_back({across, side_position(scene.geometry, face)});
      }
      continue;
    }
    Support support;
    support.name = faces.name_of_holders(holders, face);
    support.side = face;
    support.directions = kind == OutlineKind::fixed ? all : std::vector<Axis>{across};
    const bool is_known = std::ranges::any_of(scene.support, [&](const Support& known) {
      return known.name == support.name && known.side == face;
    });
    if (!is_known) scene.support.push_back(std::move(support));
  }
}

// Where the base of a footing is: its face, as of a box around the ground under it, and its
// coordinate across it.
struct BasePlace {
  Side face = Side::top;
  double position = 0.0;
};

// Where a straight piece of a base is, which has the ground to its left; nothing if it is aslant.
std::optional<BasePlace> base_at(const shape::Point& from, const shape::Point& to, double slack) {
  const shape::Point along = to - from;
  if (std::abs(along.y()) <= slack)
    return BasePlace{along.x() < 0.0 ? Side::top : Side::bottom, from.y()};
  if (std::abs(along.x()) <= slack)
    return BasePlace{along.y() > 0.0 ? Side::right : Side::left, from.x()};
  return std::nullopt;
}

std::optional<BasePlace> base_of(const shape::Outline& outline, std::size_t side,
                                 tables::Diagnosis& diagnosis) {
  std::optional<BasePlace> base;
  const double slack = outline.tolerance();
  for (const shape::OutlineSegment& segment : outline.segments) {
    if (segment.right >= 0 || segment.side != static_cast<int>(side)) continue;
    const auto here = base_at(outline.at(segment.first), outline.at(segment.second), slack);
    if (here && (!base || (base->face == here->face &&
                           std::abs(base->position - here->position) <= slack))) {
      base = here;
      continue;
    }
    const shape::Point& at = outline.at(segment.first);
    diagnosis.error(fmt::format("side.{}.along", side),
                    fmt::format("the base at ({:.6g}, {:.6g}) is {}", at.x(), at.y(),
                                here ? "beside the rest of it" : "aslant"),
                    "a footing of fpm-run has one straight base, level or upright");
    return std::nullopt;
  }
  return base;
}

// Whether there is at most one footing, which something moves or loads.
bool check_footing(Scene& scene, tables::Diagnosis& diagnosis) {
  const auto s = footing_of(scene);
  if (!s) return true;
  const std::string key = fmt::format("side.{}.kind", *s);
  if (std::ranges::count(scene.side, OutlineKind::footing, &OutlineSide::kind) > 1) {
    diagnosis.error(key, "a footing among several", "one footing at most");
    return false;
  }
  if (drive_of_footing(scene) != nullptr) return true;
  diagnosis.error(key, "found a footing that nothing moves or loads",
                  "a footing wants [drive] kind = \"displacement\", or \"load\" with plate among "
                  "its scales");
  return false;
}

// The one footing of a scene is where its drive acts.
void complete_drive(Scene& scene, const shape::Outline& outline, tables::Diagnosis& diagnosis) {
  const auto s = footing_of(scene);
  if (!s) return;
  Drive& drive = *drive_of_footing(scene);
  const auto base = base_of(outline, *s, diagnosis);
  if (!base) return;
  drive.on_footing = true;
  const OutlineSide& footing = scene.side[*s];
  const int across = axis_of(base->face);
  const auto along = [&](const PlanePoint& place) { return across == 1 ? place.x() : place.y(); };
  const auto [low, high] = std::ranges::minmax(footing.along, {}, along);
  drive.side = base->face;
  drive.range_min = {along(low)};
  drive.range_max = {along(high)};
  const double away = base->position - side_position(scene.geometry, base->face);
  if (std::abs(away) > outline.tolerance()) drive.level = base->position;
  if (drive.kind == DriveKind::displacement && drive.direction.empty()) {
    drive.direction.assign(static_cast<std::size_t>(scene.geometry.dimension), 0.0);
    drive.direction[static_cast<std::size_t>(across)] = is_upper(base->face) ? -1.0 : 1.0;
  }
  const bool extruded = is_extruded(scene);
  const double depth = extruded ? scene.geometry.max[2] - scene.geometry.min[2] : 1.0;
  if (extruded) {
    drive.range_min.push_back(scene.geometry.min[2]);
    drive.range_max.push_back(scene.geometry.max[2]);
  }
  if (!drive.width) drive.width = (along(high) - along(low)) * depth;
  drive.lateral = footing.base == Base::rough ? Lateral::fixed : Lateral::free;
  const bool later = comes_later(scene, drive);  // which images cannot
  if ((!footing.tension || later) && drive.method == DriveMethod::automatic) {
    choose_plate(footing, drive);
  }
  if (drive.level && drive.kind == DriveKind::displacement &&
      resolve_drive_method(scene, drive) == DriveMethod::direct) {
    diagnosis.error("drive.method", "found direct, with a footing on no face of the box",
                    "allowed are ghosts, which hold it across its base, and contact");
  }
}

// The measure of a displacement in stages is its largest one.
void complete_course(Scene& scene) {
  if (scene.drive.kind == DriveKind::strength) scene.course.reduction_end = scene.drive.target;
  const auto drives = drives_of(scene);
  std::vector<double> farthest(drives.size(), 0.0);
  const auto courses = courses_of_drives(scene);
  for (std::size_t s = 0; s < courses.size(); ++s) {
    if (!courses[s].in_force) continue;
    double& far = farthest[*courses[s].in_force];
    far = std::max(far, std::abs(scene.stage[s].to.value_or(0.0)));
  }
  const auto complete = [&](Drive& drive) {
    for (std::size_t d = 0; d < drives.size(); ++d) {
      const bool open = drive.kind == DriveKind::displacement && drive.target == 0.0;
      if (drives[d].drive == &drive && open) drive.target = farthest[d];
    }
  };
  complete(scene.drive);
  for (Stage& stage : scene.stage) {
    if (stage.drive) complete(*stage.drive);
  }
}

}  // namespace

void complete(Scene& scene, tables::Diagnosis& diagnosis) {
  complete_course(scene);
  complete_weights(scene, diagnosis);
  if (!has_elements(scene) && scene.geometry.spacing == 0.0 &&
      diagnosis.good({"geometry", "geometry.spacing", "mesh", "mesh.particles"})) {
    diagnosis.error("geometry.spacing", "is missing", "needed is a number > 0 [m]");
  }
  if (!is_ground(scene, diagnosis)) return;
  check_regions(scene, diagnosis);
  check_sides(scene, diagnosis);
  if (!diagnosis.errors().empty()) return;
  shape::Outline outline;
  if (!is_solid(scene)) outline = join_regions(scene, diagnosis);
  if (!diagnosis.errors().empty()) return;
  std::optional<ElementBody> elements;
  if (has_elements(scene)) {
    elements = read_elements(scene, diagnosis);
    if (!elements) return;
    complete_box_of_elements(scene, *elements, diagnosis);
  } else {
    complete_box(scene, diagnosis);
  }
  if (!diagnosis.errors().empty()) return;
  complete_levels(scene, elements);
  const OutlineFaces faces(
      scene, is_solid(scene) ? outer_pieces(scene, *elements) : outer_pieces(scene, outline));
  complete_supports(scene, faces);
  if (!check_footing(scene, diagnosis)) return;
  if (is_solid(scene)) {
    complete_drive_of_solid(scene, *elements, diagnosis);
  } else {
    complete_drive(scene, outline, diagnosis);
  }
}

}  // namespace scene

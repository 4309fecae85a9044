#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"

namespace scene {

namespace {

// Components of a unit vector typed with six digits.
constexpr double unit_length = 1e-5;

std::size_t dimension_of(const Scene& scene) {
  return static_cast<std::size_t>(scene.geometry.dimension);
}

bool has_gravity(const Scene& scene) {
  const Point& g = scene.gravity.acceleration;
  return std::any_of(g.begin(), g.end(), [](double component) { return component != 0.0; });
}

void check_gravity(const Scene& scene, tables::Diagnosis& diagnosis) {
  const std::string key = "gravity.acceleration";
  if (!check_length(scene.gravity.acceleration, dimension_of(scene), key, scene, diagnosis)) return;
  if (!has_gravity(scene)) return;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const std::string density = fmt::format("material.{}.density", i);
    if (scene.material[i].density > 0.0 || !diagnosis.good({density})) continue;
    diagnosis.error(density, "found 0 with gravity",
                    "a body that has weight needs its density: give it, or leave out [gravity]");
  }
}

void check_initial_stress(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  const std::string kind = "initial_stress.kind";
  if (initial.kind != InitialStressKind::geostatic || !diagnosis.good({kind})) return;
  if (!diagnosis.good({"gravity.acceleration", "geometry.dimension"})) return;
  if (!has_gravity(scene)) {
    diagnosis.error(kind, "found geostatic without gravity",
                    "geostatic stress is carried weight: give gravity.acceleration");
    return;
  }
  const Point& g = scene.gravity.acceleration;
  bool down = g[1] < 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) down = down && (i == 1 || g[i] == 0.0);
  if (!down) {
    diagnosis.error("gravity.acceleration", "found a direction other than -y",
                    "geostatic stress needs gravity along -y");
  }
  if (!initial.surface || !diagnosis.good({"initial_stress.surface"}) ||
      !box_is_good(scene, diagnosis)) {
    return;
  }
  if (*initial.surface < scene.geometry.max[1]) {
    diagnosis.error("initial_stress.surface", fmt::format("found {}", *initial.surface),
                    fmt::format("below the top face, y = {}, the soil above would be in tension",
                                scene.geometry.max[1]));
  }
}

void check_tractions(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < scene.traction.size(); ++i) {
    const Traction& traction = scene.traction[i];
    const std::string table = fmt::format("traction.{}", i);
    check_length(traction.value, dimension_of(scene), table + ".value", scene, diagnosis);
    if (!check_side(traction.side, table + ".side", scene, diagnosis)) continue;
    check_range(traction.side, traction.range_min, traction.range_max, table, scene, diagnosis);
    const bool follows = traction.follower && diagnosis.good({table + ".follower"});
    if (follows && scene.approximation.kinematics == KinematicsKind::small_strain) {
      diagnosis.error(table + ".follower", "found true with small_strain kinematics",
                      "a geometrically linear body does not change its faces");
    }
  }
}

void check_direction(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Point& direction = scene.drive.direction;
  const std::string key = "drive.direction";
  if (!diagnosis.good({key})) return;
  if (direction.empty()) {
    diagnosis.error(key, "is missing", "a displacement needs its direction, [0, -1] is down");
    return;
  }
  if (!check_length(direction, dimension_of(scene), key, scene, diagnosis)) return;
  double square = 0.0;
  for (const double component : direction) square += component * component;
  if (std::abs(std::sqrt(square) - 1.0) > unit_length) {
    diagnosis.error(key, fmt::format("found a vector of length {:.6g}", std::sqrt(square)),
                    "it must be a unit vector");
  }
}

/// Whether a particle of the side lies in the driven range (cell or vertex positions).
bool range_holds_particle(const Scene& scene) {
  const Geometry& geometry = scene.geometry;
  const double first = geometry.layout == Layout::cell ? 0.5 : 0.0;
  for (std::size_t axis = 0, i = 0; axis < dimension_of(scene); ++axis) {
    if (axis == static_cast<std::size_t>(axis_of(scene.drive.side))) continue;
    // Index of the first particle at or after range_min, to a rounding error.
    constexpr double round_off = 1e-9;
    const double at = (scene.drive.range_min[i] - geometry.min[axis]) / geometry.spacing - first;
    const double next = std::max(0.0, std::ceil(at - round_off));
    const double position = geometry.min[axis] + (next + first) * geometry.spacing;
    if (position > scene.drive.range_max[i] + round_off * geometry.spacing) return false;
    ++i;
  }
  return true;
}

void check_displacement(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  check_direction(scene, diagnosis);
  if (drive.target == 0.0 && diagnosis.good({"drive.target"})) {
    diagnosis.error("drive.target", diagnosis.given("drive.target") ? "found 0" : "is missing",
                    "a displacement needs how far it goes, a number > 0 [m]");
  }
  if (!drive.width && diagnosis.good({"drive.width"})) {
    diagnosis.error("drive.width", "is missing",
                    "the mean pressure of a displacement drive is its reaction over this width");
  }
  if (!drive.scales.empty()) {
    diagnosis.warning("drive.scales", "found with kind = \"displacement\"",
                      "it has no effect: tractions and gravity are constant");
  }
  if (!check_side(drive.side, "drive.side", scene, diagnosis)) return;
  const bool fits =
      check_range(drive.side, drive.range_min, drive.range_max, "drive", scene, diagnosis);
  if (!fits || drive.range_min.empty() || !diagnosis.good({"geometry.spacing"})) return;
  if (!range_holds_particle(scene)) {
    diagnosis.error("drive.range_max", "no particle lies between range_min and range_max",
                    fmt::format("particles are {} apart", scene.geometry.spacing));
  }
}

void check_load(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto& scales = scene.drive.scales;
  if (!diagnosis.good({"drive.scales"})) return;
  if (scales.empty()) {
    diagnosis.error("drive.scales", "is missing",
                    "a load needs what grows: \"traction\", \"gravity\" or both");
  }
  const auto scaled = [&](LoadKind kind) {
    return std::find(scales.begin(), scales.end(), kind) != scales.end();
  };
  if (scaled(LoadKind::traction) && scene.traction.empty() && diagnosis.good({"traction"})) {
    diagnosis.error("drive.scales", "found traction, but the scene has none", "add a [[traction]]");
  }
  if (scaled(LoadKind::gravity) && diagnosis.good({"gravity.acceleration"})) {
    if (!has_gravity(scene)) {
      diagnosis.error("drive.scales", "found gravity, but the scene has none",
                      "give gravity.acceleration");
    } else if (scene.initial_stress.kind == InitialStressKind::geostatic) {
      diagnosis.error("drive.scales", "found gravity with geostatic initial stress",
                      "the initial stress already carries the whole weight");
    }
  }
  const auto steps = scene.programme.steps.value_or(0);
  if (steps == 0 && diagnosis.good({"programme.steps"})) {
    diagnosis.error("programme.steps",
                    diagnosis.given("programme.steps") ? "found 0" : "is missing",
                    "a load drive needs the number of its steps, >= 1");
  }
}

}  // namespace

void check_loads(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_tractions(scene, diagnosis);
  check_gravity(scene, diagnosis);
  check_initial_stress(scene, diagnosis);
}

void check_drive(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"drive.kind"})) return;
  if (scene.drive.kind == DriveKind::displacement) check_displacement(scene, diagnosis);
  if (scene.drive.kind == DriveKind::load) check_load(scene, diagnosis);
}

void check_run(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Programme& programme = scene.programme;
  if (programme.maximum_increment_ratio < programme.minimum_increment_ratio &&
      diagnosis.good({"programme.maximum_increment_ratio", "programme.minimum_increment_ratio"})) {
    diagnosis.error("programme.maximum_increment_ratio",
                    fmt::format("found {}", programme.maximum_increment_ratio),
                    fmt::format("it must not be below minimum_increment_ratio, {}",
                                programme.minimum_increment_ratio));
  }
  if (programme.easy_evaluations >= programme.hard_evaluations &&
      diagnosis.good({"programme.easy_evaluations", "programme.hard_evaluations"})) {
    diagnosis.error(
        "programme.easy_evaluations", fmt::format("found {}", programme.easy_evaluations),
        fmt::format("it must be below hard_evaluations, {}", programme.hard_evaluations));
  }
  const SolverSettings solver = resolve_solver(scene.solver);
  if (solver.preconditioner == PreconditionerKind::none &&
      solver.method != SolverMethod::newton_krylov &&
      diagnosis.good({"solver.preset", "solver.method", "solver.preconditioner"})) {
    diagnosis.error("solver.preconditioner",
                    fmt::format("found none with the method {}", name_of(solver.method)),
                    "multisecant iterations need one: use two_level or block_jacobi, or method = "
                    "\"newton_krylov\"");
  }
  if (scene.research.enabled && scene.approximation.kinematics == KinematicsKind::small_strain &&
      diagnosis.good({"research.enabled", "approximation.kinematics"})) {
    diagnosis.error("research.enabled", "found true with small_strain kinematics",
                    "a geometrically linear body keeps its neighbours: use finite_strain");
  }
  const bool footing = scene.geometry.dimension == 2 && scene.drive.kind == DriveKind::displacement;
  if (scene.limit.check && !footing &&
      diagnosis.good({"limit.check", "drive.kind", "geometry.dimension"})) {
    diagnosis.error("limit.check", "found true",
                    "bounds are computed for a plane footing that is driven by a displacement");
  }
}

void check_scene(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_geometry(scene, diagnosis);
  check_materials(scene, diagnosis);
  check_hourglass(scene, diagnosis);
  check_boundaries(scene, diagnosis);
  check_loads(scene, diagnosis);
  check_drive(scene, diagnosis);
  check_measures(scene, diagnosis);
  check_run(scene, diagnosis);
}

}  // namespace scene

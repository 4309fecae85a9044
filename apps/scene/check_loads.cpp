#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/names.hpp"
#include "scene/places.hpp"

namespace scene {

namespace {

// Components of a unit vector typed with six digits.
constexpr double unit_length = 1e-5;

// More are a slip of the pen.
constexpr double most_steps = 1e9;

std::size_t dimension_of(const Scene& scene) {
  return static_cast<std::size_t>(scene.geometry.dimension);
}

void check_gravity(const Scene& scene, tables::Diagnosis& diagnosis) {
  const std::string key = "gravity.acceleration";
  if (!check_length(scene.gravity.acceleration, dimension_of(scene), key, scene, diagnosis)) return;
  if (!has_gravity(scene)) return;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const std::string density = fmt::format("material.{}.density", i);
    const tables::VaryingNumber& told = scene.material[i].density;
    if (told.value > 0.0 || told.varies() || !diagnosis.good({density})) continue;
    diagnosis.error(density, "found 0 with gravity",
                    "a body that has weight needs its density: give it, or leave out [gravity]");
  }
}

/// A load that follows the boundary is a pressure.
void check_following(const Traction& traction, const std::string& table,
                     tables::Diagnosis& diagnosis) {
  if (!traction.follower || !diagnosis.good({table + ".value", table + ".follower"})) return;
  for (std::size_t i = 0; i < traction.value.size(); ++i) {
    if (i == static_cast<std::size_t>(axis_of(traction.side)) || traction.value[i] == 0.0) continue;
    diagnosis.error(table + ".value",
                    fmt::format("found {} along the side, with follower = true", traction.value[i]),
                    "what follows the boundary is a pressure: give the part along the side as a "
                    "dead load, a [[traction]] of its own");
    return;
  }
}

void check_tractions(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < scene.traction.size(); ++i) {
    const Traction& traction = scene.traction[i];
    const std::string table = fmt::format("traction.{}", i);
    check_length(traction.value, dimension_of(scene), table + ".value", scene, diagnosis);
    if (!check_side(traction.side, table + ".side", scene, diagnosis)) continue;
    check_range(traction.side, traction.range_min, traction.range_max, table, scene, diagnosis);
    check_following(traction, table, diagnosis);
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
    return;
  }
  const auto along = std::count_if(direction.begin(), direction.end(),
                                   [](double component) { return component != 0.0; });
  if (scene.drive.lateral == Lateral::free && along > 1 && diagnosis.good({"drive.lateral"})) {
    diagnosis.error("drive.lateral", "found free with an oblique direction",
                    "particles are free across x, y or z: drive along one of them, or use fixed");
  }
}

/// A side driven by images is driven across it; the paper's viscosity knows no moving images.
void check_driven_by_ghosts(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  const std::string key = "drive.method";
  if (drive.method != DriveMethod::ghosts) return;
  if (!diagnosis.good({key, "drive.side", "drive.direction", "drive.lateral"})) return;
  const auto across = static_cast<std::size_t>(axis_of(drive.side));
  if (drive.lateral == Lateral::free && across < drive.direction.size() &&
      drive.direction[across] == 0.0) {
    diagnosis.error(key, "found ghosts, with a drive along its side and lateral = \"free\"",
                    "images hold a side across it at least: use lateral = \"fixed\", or direct");
  }
  if (diagnosis.good({"hourglass.control"}) &&
      resolve_control(scene) == HourglassControl::viscosity) {
    diagnosis.error(key, "found ghosts with hourglass.control = \"viscosity\"",
                    "that control drives by direct only");
  }
}

/// A plate that only touches is driven across its side.
void check_driven_by_contact(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  if (!is_rigid_body(drive)) return;
  if (!diagnosis.good({"drive.method", "drive.side", "drive.direction"})) return;
  const auto across = static_cast<std::size_t>(axis_of(drive.side));
  if (across < drive.direction.size() && drive.direction[across] == 0.0) {
    diagnosis.error("drive.method",
                    fmt::format("found {}, with a drive along its side", name_of(drive.method)),
                    "a plate that touches pushes across its side: use ghosts or direct");
  }
}

void check_displacement(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  check_direction(scene, diagnosis);
  check_driven_by_ghosts(scene, diagnosis);
  check_driven_by_contact(scene, diagnosis);
  if (drive.target == 0.0 && diagnosis.good({"drive.target", "stage"})) {
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
  check_driven_part(scene, diagnosis);
}

// Stages say their own.
void need_steps(const Scene& scene, const char* what, tables::Diagnosis& diagnosis) {
  const auto steps = scene.programme.steps.value_or(0);
  if (steps > 0 || !scene.stage.empty() || !diagnosis.good({"programme.steps"})) return;
  diagnosis.error("programme.steps", diagnosis.given("programme.steps") ? "found 0" : "is missing",
                  fmt::format("{} needs the number of its steps, >= 1", what));
}

void check_load(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto& scales = scene.drive.scales;
  if (!diagnosis.good({"drive.scales"})) return;
  if (scales.empty()) {
    diagnosis.error("drive.scales", "is missing",
                    "a load needs what grows: \"traction\", \"gravity\" or \"plate\"");
  }
  const auto scaled = [&](LoadKind kind) {
    return std::find(scales.begin(), scales.end(), kind) != scales.end();
  };
  const bool has_traction =
      !scene.traction.empty() ||
      std::ranges::any_of(
          scene.cutout,
          [](const Cutout& cutout) { return cutout.pressure != 0.0 || cutout.shear != 0.0; }) ||
      std::ranges::any_of(scene.side, [](const OutlineSide& side) {
        return side.live_pressure != 0.0 || side.live_shear != 0.0;
      });
  if (scaled(LoadKind::traction) && !has_traction && diagnosis.good({"traction"})) {
    diagnosis.error("drive.scales", "found traction, but the scene has none",
                    scene.region.empty() ? "add a [[traction]]"
                                         : "give a loaded [[side]] a live_pressure or live_shear");
  }
  if (scaled(LoadKind::gravity) && diagnosis.good({"gravity.acceleration"})) {
    if (!has_gravity(scene)) {
      diagnosis.error("drive.scales", "found gravity, but the scene has none",
                      "give gravity.acceleration");
    } else if (scene.initial_stress.kind != InitialStressKind::none) {
      diagnosis.error(
          "drive.scales",
          fmt::format("found gravity with {} initial stress", name_of(scene.initial_stress.kind)),
          "the initial stress already carries the whole weight");
    }
  }
  need_steps(scene, "a load drive", diagnosis);
}

}  // namespace

void check_loads(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_tractions(scene, diagnosis);
  check_names(scene.traction, "traction", diagnosis);
  check_gravity(scene, diagnosis);
  check_initial_stress(scene, diagnosis);
}

void check_drive(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"drive.kind"})) return;
  if (scene.drive.kind == DriveKind::displacement) check_displacement(scene, diagnosis);
  if (scene.drive.kind == DriveKind::load) check_load(scene, diagnosis);
  if (scene.drive.kind == DriveKind::strength) {
    check_reduction(scene, diagnosis);
    need_steps(scene, "a strength drive", diagnosis);
  }
  check_plate(scene, diagnosis);
}

/// Unbalanced forces of the tolerance are borne by friction Kp times over.
void check_tolerance(const Scene& scene, tables::Diagnosis& diagnosis) {
  constexpr double steepest = 60.0;  // [deg] below, the default tolerance costs 1 % at most
  constexpr double error_of_load = 0.01;
  const double tolerance = resolve_solver(scene).tolerance;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const std::string key = fmt::format("material.{}.friction_angle", i);
    if (!diagnosis.good({key, "solver.tolerance", fmt::format("material.{}.model", i)})) continue;
    const double phi = most_friction(scene, i, diagnosis);
    const double half = phi / 2.0 * std::numbers::pi / 180.0;
    const double Kp = std::pow(std::tan(std::numbers::pi / 4.0 + half), 2);
    if (!yields(scene.material[i]) || phi < steepest || tolerance * Kp <= error_of_load) continue;
    diagnosis.error(key, fmt::format("found {}, with solver.tolerance = {}", phi, tolerance),
                    fmt::format("loads would be off by tolerance x tan^2(45 + phi/2) = {:.2g}: "
                                "allowed is solver.tolerance <= {:.2g}, or an angle below {}",
                                tolerance * Kp, error_of_load / Kp, steepest));
  }
}

void check_run(const Scene& scene, tables::Diagnosis& diagnosis) {
  check_tolerance(scene, diagnosis);
  const Programme& programme = scene.programme;
  const double steps =
      scene.drive.target / (programme.increment_over_spacing * scene.geometry.spacing);
  if (programme.steps.value_or(0) == 0 && scene.drive.kind == DriveKind::displacement &&
      steps > most_steps &&
      diagnosis.good({"programme.increment_over_spacing", "geometry.spacing", "drive.target",
                      "programme.steps"})) {
    diagnosis.error(
        "programme.increment_over_spacing",
        fmt::format("found {}, which makes {:.3g} steps", programme.increment_over_spacing, steps),
        fmt::format("allowed are at most {:.0f}", most_steps));
  }
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
  const SolverSettings solver = resolve_solver(scene);
  if (solver.preconditioner == PreconditionerKind::none &&
      solver.method != SolverMethod::newton_krylov &&
      diagnosis.good({"solver.preset", "solver.method", "solver.preconditioner"})) {
    diagnosis.error("solver.preconditioner",
                    fmt::format("found none with the method {}", name_of(solver.method)),
                    "multisecant iterations need one: use two_level or block_jacobi, or method = "
                    "\"newton_krylov\"");
  }
  if (scene.re_search.enabled && scene.approximation.kinematics == KinematicsKind::small_strain &&
      diagnosis.good({"re_search.enabled", "approximation.kinematics"})) {
    diagnosis.error("re_search.enabled", "found true with small_strain kinematics",
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
  check_interfaces(scene, diagnosis);
  check_hourglass(scene, diagnosis);
  check_boundaries(scene, diagnosis);
  check_water(scene, diagnosis);
  check_loads(scene, diagnosis);
  check_drive(scene, diagnosis);
  check_drives(scene, diagnosis);
  check_stages(scene, diagnosis);
  check_quake(scene, diagnosis);
  check_places(scene, diagnosis);
  check_measures(scene, diagnosis);
  check_cutouts(scene, diagnosis);
  check_grading(scene, diagnosis);
  check_run(scene, diagnosis);
}

}  // namespace scene

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/derived.hpp"
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
    const tables::VaryingNumber& told = scene.material[i].density;
    if (told.value > 0.0 || told.varies() || !diagnosis.good({density})) continue;
    diagnosis.error(density, "found 0 with gravity",
                    "a body that has weight needs its density: give it, or leave out [gravity]");
  }
}

/// Whether the weight above any place can be summed up.
bool ground_is_good(const Scene& scene, const tables::Diagnosis& diagnosis) {
  if (!box_is_good(scene, diagnosis) || scene.material.empty() ||
      !diagnosis.good({"geometry.spacing", "initial_stress"})) {
    return false;
  }
  const auto n = dimension_of(scene);
  for (std::size_t i = 1; i < scene.material.size(); ++i) {
    const Material& material = scene.material[i];
    if (material.region_min.size() != n || material.region_max.size() != n) return false;
  }
  constexpr double most_slices = 1e6;
  const double surface = scene.initial_stress.surface.value_or(scene.geometry.max[1]);
  return (surface - scene.geometry.min[1]) / scene.geometry.spacing < most_slices;
}

/// Whether the tractions that act from the start press on the top as much as the ground above the
/// body that the initial stress speaks of.
void check_surcharge(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  if (!diagnosis.good({"traction", "initial_stress.surcharge"})) return;
  Point top = scene.geometry.max;
  for (std::size_t i = 0; i < top.size(); ++i) {
    if (i != 1) top[i] = 0.5 * (scene.geometry.min[i] + scene.geometry.max[i]);
  }
  const double pressure = -geostatic_stress(scene, top);
  const auto& scales = scene.drive.scales;
  const bool grows = scene.drive.kind == DriveKind::load &&
                     std::find(scales.begin(), scales.end(), LoadKind::traction) != scales.end();
  const bool carried =
      std::any_of(scene.traction.begin(), scene.traction.end(), [&](const Traction& traction) {
        constexpr double of_pressure = 1e-6;  // typed with seven digits
        return traction.side == Side::top && traction.value.size() > 1 && !grows &&
               std::abs(traction.value[1] + pressure) <= of_pressure * pressure;
      });
  if (pressure <= 0.0 || carried) return;
  diagnosis.warning(initial.surcharge > 0.0 ? "initial_stress.surcharge" : "initial_stress.surface",
                    fmt::format("the initial stress carries {:.6g} Pa on the top face, but no "
                                "traction does from the start",
                                pressure),
                    fmt::format("the ground heaves: add a [[traction]] on side = \"top\" with the "
                                "normal value {:.6g}",
                                -pressure));
}

/// Says where the initial stress is more than the ground can bear (Mohr-Coulomb in the plane).
void check_k0(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"material", "initial_stress.K0"})) return;
  const Geometry& geometry = scene.geometry;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    const Material& material = scene.material[i];
    const std::string table = fmt::format("material.{}", i);
    // What a clay in critical states bears follows from this stress.
    if (!model_of(material).is_cohesive() ||
        !diagnosis.good({table + ".cohesion", table + ".friction_angle", table + ".poissons_ratio",
                         table + ".region_min", table + ".region_max", table + ".density"})) {
      continue;
    }
    // The deepest place of the material, where the stress is largest.
    Point deepest = geometry.min;
    for (std::size_t axis = 0; axis < deepest.size(); ++axis) {
      const double lower = material.region_min.empty()
                               ? geometry.min[axis]
                               : std::max(geometry.min[axis], material.region_min[axis]);
      const double upper = material.region_max.empty()
                               ? geometry.max[axis]
                               : std::min(geometry.max[axis], material.region_max[axis]);
      deepest[axis] = axis == 1 ? lower : 0.5 * (lower + upper);
    }
    const double vertical = -geostatic_stress(scene, deepest);
    const double horizontal = resolve_k0(scene, material) * vertical;
    const auto parameters = parameters_at(material, deepest);
    const double phi = parameters.friction_angle * std::numbers::pi / 180.0;
    const double Kp = std::pow(std::tan(std::numbers::pi / 4.0 + phi / 2.0), 2);
    const double cohesion = parameters.cohesion;
    const double least = vertical / Kp - 2.0 * cohesion / std::sqrt(Kp);
    const double most = vertical * Kp + 2.0 * cohesion * std::sqrt(Kp);
    constexpr double round_off = 1e-6;
    if (vertical <= 0.0 ||
        (horizontal >= least - round_off * vertical && horizontal <= most + round_off * vertical)) {
      continue;
    }
    diagnosis.warning("initial_stress.K0",
                      fmt::format("{:.4g} is more than the material \"{}\" bears at y = {:.6g}",
                                  horizontal / vertical, material.name, deepest[1]),
                      fmt::format("it yields in the first step; it bears {:.4g} .. {:.4g} there",
                                  std::max(0.0, least / vertical), most / vertical));
  }
}

void check_initial_stress(const Scene& scene, tables::Diagnosis& diagnosis) {
  const InitialStress& initial = scene.initial_stress;
  const std::string kind = "initial_stress.kind";
  if (initial.kind == InitialStressKind::none || !diagnosis.good({kind})) return;
  if (!diagnosis.good({"gravity.acceleration", "geometry.dimension"})) return;
  if (!has_gravity(scene)) {
    diagnosis.error(kind, fmt::format("found {} without gravity", name_of(initial.kind)),
                    "geostatic stress is carried weight: give gravity.acceleration");
    return;
  }
  const Point& g = scene.gravity.acceleration;
  bool down = g[1] < 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) down = down && (i == 1 || g[i] == 0.0);
  if (initial.kind == InitialStressKind::gravity) {
    const auto refuse = [&](bool given, const char* key) {
      if (!given || !diagnosis.good({key})) return;
      diagnosis.error(key, "found with kind = \"gravity\"",
                      "it belongs to geostatic: what gravity leaves is what it is");
    };
    refuse(initial.surface.has_value(), "initial_stress.surface");
    refuse(initial.surcharge != 0.0, "initial_stress.surcharge");
    if (initial.K0 && !down) {
      diagnosis.error("gravity.acceleration", "found a direction other than -y",
                      "initial_stress.K0 is horizontal over vertical stress");
    }
    return;
  }
  if (!down) {
    diagnosis.error("gravity.acceleration", "found a direction other than -y",
                    "geostatic stress needs gravity along -y");
  }
  if (!diagnosis.good({"initial_stress.surface", "gravity.acceleration", "geometry.spacing"}) ||
      !box_is_good(scene, diagnosis)) {
    return;
  }
  if (!initial.surface || *initial.surface >= scene.geometry.max[1]) {
    if (!down || !ground_is_good(scene, diagnosis)) return;
    check_surcharge(scene, diagnosis);
    check_k0(scene, diagnosis);
  } else {
    diagnosis.error("initial_stress.surface", fmt::format("found {}", *initial.surface),
                    fmt::format("below the top face, y = {}, the soil above would be in tension",
                                scene.geometry.max[1]));
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
  check_places(scene, diagnosis);
  check_measures(scene, diagnosis);
  check_cutouts(scene, diagnosis);
  check_grading(scene, diagnosis);
  check_run(scene, diagnosis);
}

}  // namespace scene

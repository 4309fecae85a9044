#include "scene/derived.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "constitutive/parameters.hpp"
#include "scene/contacts.hpp"
#include "scene/course.hpp"
#include "scene/driven_side.hpp"
#include "scene/factors.hpp"
#include "scene/ground.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"

namespace scene {

const constitutive::ModelInfo& model_of(const Material& material) {
  const auto* model = constitutive::find_model(material.model, material.match);
  if (model == nullptr) throw std::invalid_argument("no model " + material.model);
  return *model;
}

constitutive::MaterialParameters parameters_of(const Material& material) {
  const constitutive::ModelInfo& model = model_of(material);
  constitutive::MaterialParameters p;
  p.model = model.name;
  p.youngs_modulus = material.youngs_modulus.value;
  p.poissons_ratio = material.poissons_ratio;
  p.cohesion = material.cohesion.value_or(p.cohesion).value;
  p.friction_angle = material.friction_angle.value_or(p.friction_angle).value;
  p.dilation_angle = material.dilation_angle.value_or(p.dilation_angle).value;
  p.density = material.density.value;
  p.dilation_cutoff = material.dilation_cutoff.value_or(p.dilation_cutoff);
  const auto take = [&](const char* name, const std::optional<double>& value) {
    const constitutive::ParameterInfo& info = constitutive::parameter_info(name);
    if (value && info.is_used_by(model)) p.*info.member = *value;
  };
  take("tension_cutoff", material.tension_cutoff);
  take("residual_strain", material.residual_strain);
  take("residual_cohesion", material.residual_cohesion);
  take("residual_friction_angle", material.residual_friction_angle);
  take("compression_index", material.compression_index);
  take("swelling_index", material.swelling_index);
  take("critical_stress_ratio", material.critical_stress_ratio);
  material.curve.for_each(
      [&](const char* name, const std::optional<double>& value, bool) { take(name, value); });
  // The scene has been warned of what has no effect. An elastic material is archived with it.
  if (model.yields && !model.frictional) p.friction_angle = p.dilation_angle = 0.0;
  return p;
}

bool varies(const Material& material) {
  const auto changes = [](const auto& number) { return number && number->varies(); };
  return material.youngs_modulus.varies() || changes(material.cohesion) ||
         changes(material.friction_angle) || changes(material.dilation_angle);
}

constitutive::MaterialParameters parameters_at(const Material& material,
                                               std::span<const double> place) {
  constitutive::MaterialParameters p = parameters_of(material);
  p.youngs_modulus = material.youngs_modulus.at_place(place);
  if (material.cohesion) p.cohesion = material.cohesion->at_place(place);
  const constitutive::ModelInfo& model = model_of(material);
  if (model.yields && !model.frictional) return p;
  if (material.friction_angle) p.friction_angle = material.friction_angle->at_place(place);
  if (material.dilation_angle) p.dilation_angle = material.dilation_angle->at_place(place);
  return p;
}

bool yields(const Material& material) {
  return model_of(material).yields;
}

namespace {

// Whether more and more is asked of the ground, and no plate keeps it from giving way.
bool ends_in_collapse(const Scene& scene) {
  return reduces_strength(scene) || std::ranges::any_of(all_drives(scene), [](const Drive* drive) {
           return drive->kind == DriveKind::load;
         });
}

}  // namespace

HourglassControl resolve_control(const Scene& scene) {
  if (scene.hourglass.control != HourglassControl::automatic) return scene.hourglass.control;
  const auto all = [&](auto&& holds) {
    return std::all_of(scene.material.begin(), scene.material.end(), holds);
  };
  if (!std::any_of(scene.material.begin(), scene.material.end(), yields)) {
    // What is put down on ground that has moved must not remember where that was.
    return has_new_ground(scene) ? HourglassControl::incremental : HourglassControl::stiffness;
  }
  // Ground that gives way does so by a mechanism of narrow bands, which sub-points bear too well.
  if (ends_in_collapse(scene) || tries_ground(scene)) return HourglassControl::incremental;
  // What does not yield is at home with either: it must not decide for the ground that does.
  const bool has_sub_points =
      scene.geometry.dimension == 2 && all([](const Material& m) {
        const bool one = model_of(m).one_pressure && !m.tension_cutoff && !m.residual_strain;
        return one || !yields(m);
      });
  return has_sub_points ? HourglassControl::mixed : HourglassControl::incremental;
}

bool is_nearly_incompressible(const Material& material) {
  constexpr double nearly = 0.45;
  return material.poissons_ratio > nearly;
}

double largest_poissons_ratio(const Scene& scene) {
  double largest = -1.0;
  for (const Material& material : scene.material) {
    largest = std::max(largest, material.poissons_ratio);
  }
  return largest;
}

double resolve_stiffness_ratio(const Scene& scene) {
  if (scene.hourglass.stiffness_ratio) return *scene.hourglass.stiffness_ratio;
  switch (resolve_control(scene)) {
    case HourglassControl::stiffness:
      // What the control bears comes back as a mean stress that alternates, the more the stiffer
      // the volume is.
      return scene.geometry.dimension == 2 && largest_poissons_ratio(scene) > 0.49 ? 0.03 : 0.1;
    case HourglassControl::incremental:
      // No plate keeps what collapses from going on, borne by the control. Stages may end in a
      // collapse, and more often do not: their displacements want a stiffer one.
      if (has_new_ground(scene) && std::ranges::none_of(scene.material, yields)) return 0.1;
      if (ends_in_collapse(scene)) return 0.001;
      return tries_ground(scene) && std::ranges::any_of(scene.material, yields) ? 0.01 : 0.1;
    case HourglassControl::mixed:
      return 0.01;
    default:
      return 0.0;
  }
}

bool is_controlled_for_collapse(const Scene& scene) {
  return !scene.hourglass.stiffness_ratio && (ends_in_collapse(scene) || tries_ground(scene)) &&
         !reduces_strength(scene) && resolve_control(scene) == HourglassControl::incremental &&
         std::ranges::any_of(scene.material, yields);
}

namespace {

// Particles on a face are prescribed themselves; the paper's viscosity drives by direct only.
bool may_have_images(const Scene& scene) {
  return scene.geometry.layout == Layout::cell &&
         resolve_control(scene) != HourglassControl::viscosity;
}

// Whether a support holds while a drive acts.
bool acts_beside(const Scene& scene, const Drive& drive, const std::string& support) {
  const auto drives = drives_of(scene);
  const auto is_it = [&](const NamedDrive& named) { return named.drive == &drive; };
  const auto d = static_cast<std::size_t>(std::ranges::find_if(drives, is_it) - drives.begin());
  if (d == drives.size()) return true;
  const auto courses = courses_of_drives(scene);
  for (std::size_t s = 0; s < courses.size(); ++s) {
    if (courses[s].acts[d] && holds_in_stage(scene, s, support)) return true;
  }
  return courses.empty();
}

bool moves(const Drive& drive, Side side) {
  return (drive.kind == DriveKind::displacement || loads_plate(drive)) && drive.side == side &&
         !drive.level;
}

bool holds_by_images(const Scene& scene) {
  const auto moves_by_images = [&](const Drive* drive) {
    return drive->kind == DriveKind::displacement &&
           resolve_drive_method(scene, *drive) == DriveMethod::ghosts;
  };
  return std::ranges::any_of(all_drives(scene), moves_by_images) ||
         std::ranges::any_of(scene.support, [&](const Support& support) {
           return resolve_method(scene, support) == SupportMethod::ghosts;
         });
}

}  // namespace

SupportMethod resolve_method(const Scene& scene, const Support& support) {
  if (support.method != SupportMethod::automatic) return support.method;
  // Images would be where they were before anything moved; particles are held where they are.
  if (begins_later(scene, support.name)) return SupportMethod::direct;
  const bool free_side =
      support.side && may_have_images(scene) && !is_mirror(scene, *support.side) &&
      std::ranges::none_of(all_drives(scene),
                           [&](const Drive* drive) { return moves(*drive, *support.side); });
  if (!free_side) return SupportMethod::direct;
  const auto across = static_cast<Axis>(axis_of(*support.side));
  const auto holds_across = [&](const Support& other) {
    const bool images =
        other.method == SupportMethod::automatic || other.method == SupportMethod::ghosts;
    return images && other.side == support.side && std::ranges::count(other.directions, across) > 0;
  };
  // In all the stages in which it holds.
  for (std::size_t s = 0; s < stage_count(scene); ++s) {
    const auto holds_then = [&](const Support& other) {
      return holds_across(other) && holds_in_stage(scene, s, other.name);
    };
    if (holds_in_stage(scene, s, support.name) && std::ranges::none_of(scene.support, holds_then)) {
      return SupportMethod::direct;
    }
  }
  return SupportMethod::ghosts;
}

DriveMethod resolve_drive_method(const Scene& scene) {
  return resolve_drive_method(scene, scene.drive);
}

std::optional<ActingDrive> drive_by_images(const Scene& scene) {
  for (const ActingDrive& acting : acting_drives(scene)) {
    if (acting.drive->kind == DriveKind::displacement &&
        resolve_drive_method(scene, *acting.drive) == DriveMethod::ghosts) {
      return acting;
    }
  }
  return std::nullopt;
}

namespace {

// Whether the drive prescribes what its side does across itself, by images or by particles.
bool is_held_across(const Scene& scene, const Drive& drive) {
  const DriveMethod method = resolve_drive_method(scene, drive);
  if (method == DriveMethod::ghosts) return true;
  const auto across = static_cast<std::size_t>(axis_of(drive.side));
  return method == DriveMethod::direct &&
         (drive.lateral == Lateral::fixed || drive.direction[across] != 0.0);
}

}  // namespace

bool drives_wall(const Scene& scene) {
  const Drive& drive = scene.drive;
  if (drive.kind != DriveKind::displacement || drive.later || drive.level) return false;
  if (axis_of(drive.side) == 1 || !is_held_across(scene, drive)) return false;
  // Ground without weight settles under its loads alone.
  if (scene.initial_stress.kind == InitialStressKind::gravity && !has_gravity(scene)) return false;
  return !is_pressed_from_the_start(scene, drive.side);
}

DriveMethod resolve_drive_method(const Scene& scene, const Drive& drive) {
  if (drive.method != DriveMethod::automatic) return drive.method;
  // As a support's.
  if (drive.later || comes_later(scene, drive)) return DriveMethod::direct;
  const auto across = static_cast<std::size_t>(axis_of(drive.side));
  const bool held_across = drive.lateral == Lateral::fixed ||
                           (across < drive.direction.size() && drive.direction[across] != 0.0);
  const auto is_there = [&](const Support& support) {
    return support.side == drive.side && acts_beside(scene, drive, support.name);
  };
  const bool alone = drive.level || (std::ranges::none_of(scene.support, is_there) &&
                                     !is_mirror(scene, drive.side));
  return held_across && alone && may_have_images(scene) ? DriveMethod::ghosts : DriveMethod::direct;
}

bool resolve_consistency(const Scene& scene) {
  if (scene.approximation.consistency == Switch::automatic) {
    return scene.geometry.jitter > 0.0 || scene.grading.enabled || is_cut(scene) ||
           holds_by_images(scene);
  }
  return scene.approximation.consistency == Switch::on;
}

bool is_cut(const Scene& scene) {
  return !scene.cutout.empty() || !scene.region.empty();
}

bool may_give_way(const Scene& scene) {
  const bool is_tried = ends_in_collapse(scene) || tries_ground(scene);
  return is_tried && (std::ranges::any_of(scene.material, yields) || has_contact(scene));
}

namespace {

// What is left unbalanced bears load where the ground fails, and is measured against the loads and
// reactions of all of it: a corner of a cut can owe it some per cent of what it bears.
double usual_tolerance(const Scene& scene) {
  const bool paper = scene.solver.preset == SolverPreset::appendix_a;
  return may_give_way(scene) && !paper ? 1e-4 : 1e-3;
}

}  // namespace

SolverSettings resolve_solver(const Scene& scene) {
  const Solver& solver = scene.solver;
  SolverSettings settings;
  const bool paper = solver.preset == SolverPreset::appendix_a;
  settings.tolerance = solver.tolerance.value_or(usual_tolerance(scene));
  settings.method =
      solver.method.value_or(paper ? SolverMethod::newton_krylov : SolverMethod::hybrid);
  settings.jacobian =
      solver.jacobian.value_or(paper ? JacobianKind::finite_difference : JacobianKind::analytic);
  const bool is_elastic = std::ranges::none_of(scene.material, yields);
  const PreconditionerKind usual = wants_factors(scene, largest_poissons_ratio(scene), is_elastic)
                                       ? PreconditionerKind::factors
                                       : PreconditionerKind::two_level;
  settings.preconditioner =
      solver.preconditioner.value_or(paper ? PreconditionerKind::none : usual);
  return settings;
}

std::array<std::int64_t, 3> lattice_counts(const Geometry& geometry) {
  std::array<std::int64_t, 3> counts{1, 1, 1};
  for (std::size_t i = 0; i < geometry.min.size(); ++i) {
    const double cells = (geometry.max[i] - geometry.min[i]) / geometry.spacing;
    counts[i] = std::llround(cells) + (geometry.layout == Layout::vertex ? 1 : 0);
  }
  return counts;
}

std::int64_t particle_count(const Geometry& geometry) {
  const auto counts = lattice_counts(geometry);
  return counts[0] * counts[1] * counts[2];
}

std::int64_t nominal_steps(const Scene& scene) {
  if (scene.programme.steps.value_or(0) > 0) return *scene.programme.steps;
  if (scene.drive.kind != DriveKind::displacement) return 1;
  const double increment = scene.programme.increment_over_spacing * scene.geometry.spacing;
  const double way = scene.drive.target * std::abs(scene.course.load_end - scene.course.load_begin);
  // A quotient a rounding error above a whole number is that number.
  constexpr double round_off = 1e-9;
  return std::max<std::int64_t>(1,
                                static_cast<std::int64_t>(std::ceil(way / increment - round_off)));
}

std::string column_name(const std::string& name) {
  std::string column = name;
  for (char& c : column) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return column;
}

std::vector<Measure> resolve_measures(const Scene& scene) {
  const bool several = has_stage_drives(scene);
  // Be it the one in force, or one that was let go: all stages measure the same.
  const bool displaces = std::ranges::any_of(
      all_drives(scene), [](const Drive* drive) { return drive->kind == DriveKind::displacement; });
  if (!scene.measure.empty() || (displaces && !several)) return scene.measure;
  std::vector<Measure> all{{.name = "body", .kind = MeasureKind::max_displacement}};
  std::vector<std::string> supports;
  for (const NamedDrive& drive : drives_of(scene)) {
    const bool pushes = drive.drive->kind == DriveKind::displacement || loads_plate(*drive.drive);
    if (several && pushes) supports.push_back(drive.name);
  }
  for (const Support& support : scene.support) supports.push_back(support.name);
  for (const std::string& tied : tied_surfaces(scene)) supports.push_back(tied);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    std::string name = column_name(supports[i]);
    const auto taken = [&](const Measure& other) { return other.name == name; };
    if (std::ranges::any_of(all, taken)) name.append(1, '_').append(std::to_string(i));
    all.push_back({.name = name, .kind = MeasureKind::reaction, .support = supports[i]});
  }
  return all;
}

std::size_t material_at(const Scene& scene, std::span<const double> place) {
  if (!scene.region.empty()) return material_of_region_at(scene, outline_of(scene), place);
  const double slack = same_place(scene.geometry);
  const auto holds = [&](const Material& material) {
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (place[i] < material.region_min[i] - slack || place[i] > material.region_max[i] + slack) {
        return false;
      }
    }
    return true;
  };
  std::size_t m = scene.material.size() - 1;
  while (m > 0 && !holds(scene.material[m])) --m;
  return m;
}

double resolve_k0(const Scene& scene, const Material& material) {
  return scene.initial_stress.K0.value_or(material.poissons_ratio /
                                          (1.0 - material.poissons_ratio));
}

double resolve_k0_z(const Scene& scene, const Material& material) {
  return scene.initial_stress.K0_z.value_or(resolve_k0(scene, material));
}

std::array<double, 6> uniform_stress(const Scene& scene, const Material& material) {
  const InitialStress& s = scene.initial_stress;
  const double x = s.sigma_x.value_or(0.0), y = s.sigma_y.value_or(0.0);
  return {x,
          y,
          s.sigma_z.value_or(material.poissons_ratio * (x + y)),
          s.sigma_xy.value_or(0.0),
          s.sigma_yz.value_or(0.0),
          s.sigma_zx.value_or(0.0)};
}

Interface interface_between(const Scene& scene, std::size_t one, std::size_t other) {
  const std::string& first = scene.material[one].name;
  const std::string& second = scene.material[other].name;
  for (const Interface& interface : scene.interface) {
    const auto& names = interface.between;
    if ((names[0] == first && names[1] == second) || (names[0] == second && names[1] == first)) {
      return interface;
    }
  }
  Interface otherwise;
  otherwise.between = {first, second};
  otherwise.kind = scene.approximation.interfaces;
  return otherwise;
}

double resolve_stiffness_factor(const Contact& contact, bool yields) {
  return contact.stiffness_factor.value_or(yields ? 10.0 : 100.0);
}

double modulus_ratio_of_springs(const Material& material) {
  const double nu = material.poissons_ratio;
  return is_nearly_incompressible(material) ? (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) : 1.0;
}

bool is_associated(const Scene& scene) {
  return std::all_of(scene.material.begin(), scene.material.end(), [](const Material& material) {
    if (model_of(material).curve != constitutive::Curve::none) {
      return material.curve.dilation_ratio == 1.0;
    }
    const tables::VaryingNumber none;
    return material.dilation_angle.value_or(none) == material.friction_angle.value_or(none);
  });
}

}  // namespace scene

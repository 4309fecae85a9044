#include "model/build.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "model/bodies.hpp"
#include "model/cut_body.hpp"
#include "model/cut_prisms.hpp"
#include "model/elements.hpp"
#include "model/extrude.hpp"
#include "model/grid_cells.hpp"
#include "model/holders.hpp"
#include "model/initial_stress.hpp"
#include "model/interfaces.hpp"
#include "model/loads.hpp"
#include "model/planes.hpp"
#include "model/pore_water.hpp"
#include "model/selection.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/grading.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace model {
namespace {

template <int Dim>
fpm::Vector<Dim> to_vector(const scene::Point& p) {
  return Eigen::Map<const fpm::Vector<Dim>>(p.data());
}

fpm::Kernel to_kernel(scene::KernelKind kind) {
  switch (kind) {
    case scene::KernelKind::quintic_spline:
      return fpm::Kernel::quintic_spline;
    case scene::KernelKind::wendland_c2:
      return fpm::Kernel::wendland_c2;
    case scene::KernelKind::cubic_spline:
      break;
  }
  return fpm::Kernel::cubic_spline;
}

// The section of prisms, with its materials and bodies.
Model<2> section_of(const scene::Scene& scene) {
  Model<2> section;
  section.spacing = scene.geometry.spacing;
  section.cells = cells_of<2>(scene);
  section.particles = fpm::make_particles(section.cells);
  cut_body(scene, section);
  part_into_bodies(scene, section);
  return section;
}

void place_prisms(const scene::Scene& scene, Model<3>& model) {
  if (!scene.grading.enabled) return extrude(section_of(scene), model);
  model.cells = cells_of<3>(scene);
  cut_prisms(scene, model);
  // The tree itself goes on where the body does not: behind an aslant side that is held it would
  // ask for half as many evaluations again, and more.
  model.background = cells_behind(model);
}

template <int Dim>
void place_particles(const scene::Scene& scene, Model<Dim>& model) {
  const scene::Geometry& geometry = scene.geometry;
  model.box_min = to_vector<Dim>(geometry.min);
  model.box_max = to_vector<Dim>(geometry.max);
  model.spacing = geometry.spacing;
  model.row_options.kernel = to_kernel(scene.approximation.kernel);
  model.row_options.support_radius = scene.approximation.support_over_spacing * geometry.spacing;
  model.row_options.spacing = geometry.spacing;
  if (scene::has_elements(scene)) {
    place_elements(scene, model);
  } else if (scene::is_extruded(scene)) {
    if constexpr (Dim == 3) place_prisms(scene, model);
  } else {
    model.cells = cells_of<Dim>(scene);
    model.particles = fpm::make_particles(model.cells);
    if (scene::is_cut(scene)) cut_body(scene, model);
  }
  // Rows may widen their support, and re-searched rows reach for particles that have moved.
  model.ghosts = fpm::make_ghosts(model.particles, ghost_planes<Dim>(scene), model.row_options);
  model.plane_side = sides_of_planes(scene, model);
}

template <int Dim>
void assign_materials(const scene::Scene& scene, Model<Dim>& model) {
  const Eigen::Index n = model.size();
  const bool known = !model.material.empty();  // of regions
  model.material.resize(static_cast<std::size_t>(n), 0);
  model.mass.resize(n);
  // By where its cell is: jitter moves no particle into another material. What is left of a cell
  // that was cut is where its particle is.
  for (Eigen::Index a = 0; a < n; ++a) {
    fpm::Vector<Dim> place = model.particles.position.row(a).transpose();
    const bool is_whole_cell =
        model.cells.size() > 0 &&
        (model.surface.empty() || model.particles.volume[a] == std::pow(model.spacing_at(a), Dim));
    if (is_whole_cell) place = model.cells.site(static_cast<fpm::Index>(a));
    if (!known) {
      model.material[static_cast<std::size_t>(a)] =
          static_cast<MaterialIndex>(scene::material_at(scene, {place.data(), Dim}));
    }
    const scene::Material& material = scene.material[model.material[static_cast<std::size_t>(a)]];
    model.mass[a] = material.density.at_place({place.data(), Dim}) * model.particles.volume[a];
  }
}

bool is_consolidated(const scene::Material& material) {
  return scene::model_of(material).critical_state;
}

// Whether particles of a material may differ in their law.
bool changes(const scene::Material& material) {
  return scene::varies(material) || is_consolidated(material);
}

// The laws of particles. Equal values are one law, so that rows of a lattice along which nothing
// changes go on to be worked on side by side.
template <int Dim>
void assign_laws(const scene::Scene& scene, Model<Dim>& model) {
  const bool reduces = scene::reduces_strength(scene);
  const auto add = [&](const scene::Material& material,
                       const constitutive::MaterialParameters& parameters) {
    model.laws.push_back(constitutive::make_material(parameters));
    model.youngs_modulus.push_back(parameters.youngs_modulus);
    const auto law = static_cast<LawIndex>(model.laws.size() - 1);
    if (reduces && scene::yields(material) && scene::is_weakened(scene, material.name)) {
      model.reduced_laws.push_back({law, parameters});
    }
    return law;
  };
  std::vector<LawIndex> uniform(scene.material.size());
  for (std::size_t m = 0; m < scene.material.size(); ++m) {
    const scene::Material& material = scene.material[m];
    if (!changes(material)) uniform[m] = add(material, scene::parameters_of(material));
  }
  model.law.resize(model.material.size());
  std::map<std::tuple<MaterialIndex, std::array<double, 5>>, LawIndex> known;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const MaterialIndex m = model.material[static_cast<std::size_t>(a)];
    model.law[static_cast<std::size_t>(a)] = uniform[m];
    if (!changes(scene.material[m])) continue;
    const fpm::Vector<Dim> place = model.particles.position.row(a).transpose();
    auto parameters = scene::parameters_at(scene.material[m], {place.data(), Dim});
    if (is_consolidated(scene.material[m])) {
      parameters.preconsolidation_pressure =
          *scene.material[m].overconsolidation_ratio *
          constitutive::yield_pressure<Dim>(parameters.critical_stress_ratio,
                                            initial_stress_at<Dim>(scene, place, m));
    }
    const auto [at, is_new] = known.try_emplace(
        {m,
         {parameters.cohesion, parameters.friction_angle, parameters.dilation_angle,
          parameters.youngs_modulus, parameters.preconsolidation_pressure}},
        0);
    if (is_new) at->second = add(scene.material[m], parameters);
    model.law[static_cast<std::size_t>(a)] = at->second;
  }
}

template <int Dim>
void choose_integration(const scene::Scene& scene, Model<Dim>& model) {
  model.control = scene::resolve_control(scene);
  model.pair_control.stiffness_ratio = scene::resolve_stiffness_ratio(scene);
  model.pair_control.modulus_factor = scene.hourglass.modulus_factor;
  model.viscosity = scene.hourglass.viscosity;
  model.layout.finite = scene.approximation.kinematics == scene::KinematicsKind::finite_strain;
  model.layout.plastic =
      std::any_of(scene.material.begin(), scene.material.end(),
                  [](const scene::Material& m) { return scene::model_of(m).yields; });
  model.layout.subpoints = model.control == scene::HourglassControl::mixed;
  model.layout.incremental = model.control == scene::HourglassControl::incremental ||
                             model.control == scene::HourglassControl::mixed;
  model.layout.staged = scene::changes_ground(scene);
  model.channels.second = model.layout.subpoints;
  model.channels.pair =
      model.pair_control.stiffness_ratio > 0.0 &&
      (model.layout.incremental || model.control == scene::HourglassControl::stiffness);
  model.row_options.second = model.channels.second;
}

// The particles of a drive's side, or its images.
template <int Dim>
void displace(const scene::Scene& scene, const scene::ActingDrive& acting, Model<Dim>& model) {
  const Eigen::Index n = model.size();
  const scene::Drive& drive = *acting.drive;
  const fpm::Vector<Dim> direction = to_vector<Dim>(drive.direction).normalized();
  const double moved = acting.moves ? drive.target : 0.0;
  const double measured = acting.reported ? 1.0 : 0.0;
  if (scene::resolve_drive_method(scene, drive) == scene::DriveMethod::ghosts) {
    const std::size_t count = model.ghosts.planes().size();
    model.plane_drive.assign(count, fpm::Vector<Dim>::Zero());
    model.plane_measure.assign(count, fpm::Vector<Dim>::Zero());
    model.plane_drive[driven_plane] = moved * direction;
    model.plane_measure[driven_plane] = measured * direction;
    if (!acting.moves) {
      model.plane_held.assign(count, fpm::Vector<Dim>::Zero());
      model.plane_held[driven_plane] = acting.held * drive.target * direction;
    }
    if (scene.geometry.layout == scene::Layout::cell) return;  // else particles are on its face
  }
  for (const Eigen::Index a : driven_particles(scene, drive, model)) {
    model.driven_particle[static_cast<std::size_t>(a)] = 1;
    for (int i = 0; i < Dim; ++i) {
      if (drive.lateral == scene::Lateral::free && direction[i] == 0.0) continue;
      const Eigen::Index k = i * n + a;
      model.prescribed[static_cast<std::size_t>(k)] = 1;
      model.drive[k] = direction[i] * moved;
      model.measure[k] = direction[i] * measured;
    }
  }
}

// Departure: rows are prescribed directly unless a penalty is asked for
// (share/doc/decisions/prescribed-rows.md).
template <int Dim>
void constrain(const scene::Scene& scene, Model<Dim>& model) {
  const Eigen::Index n = model.size();
  // Behind a held plane there are images of the others; particles on it move as it does.
  const bool on_face = scene.geometry.layout == scene::Layout::vertex;
  model.prescribed.assign(static_cast<std::size_t>(model.unknowns()), 0);
  model.drive.setZero(model.unknowns());
  model.measure.setZero(model.unknowns());
  model.driven_particle.assign(static_cast<std::size_t>(n), 0);
  const auto prescribe = [&](Eigen::Index a, int i) {
    model.prescribed[static_cast<std::size_t>(i * n + a)] = 1;
  };
  for (const scene::Support& support : scene.support) {
    if (support.method == scene::SupportMethod::penalty ||  // loads.cpp
        support.method == scene::SupportMethod::contact) {  // interfaces.cpp
      continue;
    }
    const bool ghosts = scene::resolve_method(scene, support) == scene::SupportMethod::ghosts;
    for (const Eigen::Index a : supported_particles(scene, support, model)) {
      if (ghosts && !on_face) continue;
      for (const scene::Axis axis : support.directions) prescribe(a, static_cast<int>(axis));
    }
  }
  const auto acting = scene::acting_drives(scene);
  // What the one in force moves none of the others holds: it comes last.
  for (auto drive = acting.rbegin(); drive != acting.rend(); ++drive) {
    if (drive->drive->kind == scene::DriveKind::displacement &&
        !scene::is_rigid_body(*drive->drive)) {
      displace(scene, *drive, model);
    }
  }
}

// The widest spacing [m] at which three cells fit across the regions that a box of space meets.
double fitting_spacing(const shape::Body& body, const shape::Point& low, const shape::Point& high,
                       double finest) {
  constexpr double fewest = 3.0;
  double widest = std::numeric_limits<double>::infinity();
  for (int r = 0; r < body.regions(); ++r) {
    if (body.distance_to_region(low, high, r) > 0.0) continue;
    widest = std::min(widest, std::max(finest, body.thickness(r) / fewest));
  }
  return widest;
}

}  // namespace

template <int Dim>
fpm::Cells<Dim> cells_of(const scene::Scene& scene) {
  const scene::Geometry& geometry = scene.geometry;
  fpm::LatticeOptions<Dim> lattice;
  lattice.min = to_vector<Dim>(geometry.min);
  lattice.max = to_vector<Dim>(geometry.max);
  lattice.spacing = geometry.spacing;
  lattice.layout = geometry.layout == scene::Layout::cell ? fpm::LatticeLayout::cell
                                                          : fpm::LatticeLayout::vertex;
  lattice.jitter = geometry.jitter;
  lattice.seed = static_cast<std::uint64_t>(geometry.seed);
  const bool cut = scene::is_cut(scene) && (Dim == 2 || scene::is_extruded(scene));
  if (!scene.grading.enabled) {
    // A tree of equal cells can lose some of them.
    if (cut) return {lattice, [&](const auto& /*lower*/, const auto& /*upper*/) { return 0.0; }};
    return fpm::Cells<Dim>(lattice);
  }
  const auto places = scene::fine_places(scene);
  std::optional<shape::Body> body;
  if (cut) body = scene::body_of(scene);
  return {lattice, [&](const fpm::Vector<Dim>& lower, const fpm::Vector<Dim>& upper) {
            const auto wanted = [&](double to_hollows) {
              return scene::wanted_spacing(scene, places, {lower.data(), Dim}, {upper.data(), Dim},
                                           to_hollows);
            };
            if (!body) return wanted(std::numeric_limits<double>::infinity());
            const shape::Point low = lower.template head<2>(), high = upper.template head<2>();
            return std::min(wanted(body->distance_to_hollows(low, high)),
                            fitting_spacing(*body, low, high, geometry.spacing));
          }};
}

std::int64_t particle_count(const scene::Scene& scene) {
  const auto count = [&](auto model) {
    place_particles(scene, model);
    return static_cast<std::int64_t>(model.size());
  };
  if (scene::is_solid(scene) || scene::is_extruded(scene)) return count(Model<3>());
  if (scene::is_cut(scene)) return count(Model<2>());
  if (!scene.grading.enabled) return scene::particle_count(scene.geometry);
  return scene.geometry.dimension == 2 ? cells_of<2>(scene).size() : cells_of<3>(scene).size();
}

template <int Dim>
Model<Dim> build_model(const scene::Scene& scene) {
  Model<Dim> model;
  place_particles(scene, model);
  assign_materials(scene, model);
  assign_laws(scene, model);
  add_pore_water(scene, model);
  choose_integration(scene, model);
  part_into_bodies(scene, model);
  constrain(scene, model);
  add_loads(scene, model);
  add_initial_stress(scene, model);
  add_interfaces(scene, model);
  const bool parted = !model.particles.body.empty();
  model.consistency = scene::resolve_consistency(scene) ||
                      (parted && scene.approximation.consistency == scene::Switch::automatic);
  if (model.consistency) model.area_vector = boundary_area_vectors(scene, model);
  model.layout.thin = Holders<Dim>(scene, model).are_opposite();
  return model;
}

template <int Dim>
State<Dim> initial_state(const Model<Dim>& model) {
  State<Dim> state;
  state.layout = model.layout;
  state.resize(model.size(), model.interface_points(), model.penalty_points(), model.plates());
  state.rows = fpm::Rows<Dim>(model.particles, model.ghosts, model.row_options);
  if (model.initial_stress.size() > 0) state.stress = model.initial_stress;
  if (model.layout.subpoints) {
    for (Eigen::Index a = 0; a < model.size(); ++a) {
      const constitutive::StressVector<Dim> s =
          constitutive::deviator(constitutive::StressVector<Dim>(state.stress.col(a)));
      for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(fpm::subpoint_count); ++k) {
        state.subpoint_deviator.col(a).template segment<State<Dim>::stress_rows>(
            State<Dim>::stress_rows * k) = s;
      }
    }
  }
  return state;
}

template fpm::Cells<2> cells_of<2>(const scene::Scene&);
template fpm::Cells<3> cells_of<3>(const scene::Scene&);
template Model<2> build_model<2>(const scene::Scene&);
template Model<3> build_model<3>(const scene::Scene&);
template State<2> initial_state<2>(const Model<2>&);
template State<3> initial_state<3>(const Model<3>&);

}  // namespace model

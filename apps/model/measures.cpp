#include "model/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>

#include "model/initial_stress.hpp"
#include "model/penalty_targets.hpp"
#include "model/selection.hpp"
#include "model/side_points.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace model {

namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
constexpr std::array<std::string_view, 6> stresses{"xx", "yy", "zz", "xy", "yz", "zx"};

constexpr const char* stage_column = "stage";

}  // namespace

template <int Dim>
Measures<Dim>::Measures(const scene::Scene& scene, const Model<Dim>& model)
    : model_(model),
      holders_(scene, model),
      course_(scene.course),
      has_stages_(!scene.stage.empty()),
      reduces_strength_(scene::reduces_strength(scene)) {
  if (has_stages_) columns_.emplace_back(stage_column);
  if (reduces_strength_) columns_.emplace_back("strength_reduction");
  if (scene::has_stage_drives(scene)) name_drives(scene);
  name_rotations(scene);
  if (!scene.region.empty() && !scene::is_solid(scene)) outline_ = scene::outline_of(scene);
  const std::vector<scene::Measure> all = scene::resolve_measures(scene);
  if (std::ranges::count(all, scene::MeasureKind::stress, &scene::Measure::kind) > 0) {
    walls_ = wall_points(scene, model);
  }
  for (const scene::Measure& asked : all) {
    Measure& measure = measures_.emplace_back();
    measure.kind = asked.kind;
    if (!asked.at.empty()) locate(scene, asked, measure);
    if (asked.support) find_support(scene, *asked.support, measure);
    if (asked.side) find_side(scene, *asked.side, measure);
    name_columns(asked);
  }
}

// In the order of the scene, whichever is in force.
template <int Dim>
void Measures<Dim>::name_drives(const scene::Scene& scene) {
  std::map<std::size_t, std::pair<const scene::Drive*, Place>> all;
  const auto add = [&](const scene::Drive& drive, bool moves, double held) {
    if (drive.kind == scene::DriveKind::none) return;
    const bool displaces = drive.kind == scene::DriveKind::displacement;
    all[drive.number] = {&drive, {moves, held, displaces ? drive.target : 1.0}};
  };
  add(scene.drive, true, 0.0);
  for (const scene::OtherDrive& other : scene.other_drives) add(other.drive, false, other.load);
  for (const auto& [number, drive] : all) {
    const bool displaces = drive.first->kind == scene::DriveKind::displacement;
    const std::string name = scene::column_name(scene::name_of_drive(*drive.first));
    const std::string_view what = displaces ? "_moved_m" : "_load_parameter";
    std::string column = fmt::format("{}{}", name, what);
    if (std::ranges::count(columns_, column) > 0) {
      column = fmt::format("{}_{}{}", name, number, what);
    }
    columns_.push_back(std::move(column));
    drives_.push_back(drive.second);
  }
}

// Of plates that turn, about each axis.
template <int Dim>
void Measures<Dim>::name_rotations(const scene::Scene& scene) {
  std::map<std::size_t, const scene::Drive*> turning;  // in the order of the scene
  const auto add = [&](const scene::Drive& drive) {
    if (!drive.at.empty() && scene::is_rigid_body(drive)) turning[drive.number] = &drive;
  };
  add(scene.drive);
  for (const scene::OtherDrive& other : scene.other_drives) add(other.drive);
  for (const auto& [number, drive] : turning) {
    const std::string name = drive->name.empty() ? "plate" : scene::column_name(drive->name);
    const Eigen::Index plate = plate_of(scene::name_of_drive(*drive));
    for (int i = 0; i < State<Dim>::rotations; ++i) {
      const std::string axis =
          Dim == 2 ? "" : fmt::format("_{}", axes[static_cast<std::size_t>(i)]);
      std::string column = fmt::format("{}_rotation{}_rad", name, axis);
      if (std::ranges::count(columns_, column) > 0) {
        column = fmt::format("{}_{}_rotation{}_rad", name, number, axis);
      }
      columns_.push_back(std::move(column));
      rotations_.emplace_back(i, plate);
    }
  }
}

// Its place among those that are free, or -1.
template <int Dim>
Eigen::Index Measures<Dim>::plate_of(const std::string& drive) const {
  Eigen::Index k = 0;
  for (const Interface<Dim>& interface : model_.interfaces) {
    if (!interface.plate) continue;
    if (interface.of_drive == drive) return k;
    ++k;
  }
  return -1;
}

namespace {

// Stress may jump where the material changes, within one body as well.
template <int Dim>
fpm::ParticleSet<Dim> by_material(const Model<Dim>& model) {
  fpm::ParticleSet<Dim> particles = model.particles;
  particles.body.resize(model.material.size(), 0);
  const auto bodies = *std::ranges::max_element(particles.body) + 1;
  for (std::size_t a = 0; a < particles.body.size(); ++a) {
    particles.body[a] += bodies * static_cast<fpm::Index>(model.material[a]);
  }
  return particles;
}

// Those of the point's body that its rows lead to in two steps. What lies as near beyond a slot is
// made another body's.
template <int Dim>
fpm::ParticleSet<Dim> within_reach(fpm::ParticleSet<Dim> particles,
                                   const fpm::PointOperator<Dim>& point, fpm::Index own) {
  std::vector<fpm::Index> near;
  point.for_each_value(
      0, [&](fpm::Index a, double /*weight*/, const auto& /*sign*/) { near.push_back(a); });
  const fpm::Index body = particles.body[static_cast<std::size_t>(own)];
  const fpm::Index beyond = *std::ranges::max_element(particles.body) + 1;
  const double step = point.support_radius(0);
  for (fpm::Index a = 0; a < particles.size(); ++a) {
    auto& of = particles.body[static_cast<std::size_t>(a)];
    const auto leads_here = [&](fpm::Index b) {
      return (particles.position.row(a) - particles.position.row(b)).norm() <= step;
    };
    if (of == body && std::ranges::none_of(near, leads_here)) of = beyond;
  }
  return particles;
}

// The material of a stress at a point is that of the region the point is in, which may be another
// one than the nearest particle's. On a joint, chords of an arc included, it is the latter.
template <int Dim>
Eigen::Index particle_of_stress(const scene::Scene& scene, const shape::Outline& outline,
                                const std::vector<double>& at, const Model<Dim>& model) {
  constexpr double on_joint = 0.01;  // of the spacing
  const Eigen::Index nearest = nearest_particle(scene, at, model);
  const double spacing = model.spacing_at(nearest);
  const auto here = scene::materials_of_regions_at(scene, outline, at, on_joint * spacing);
  const auto is_here = [&](Eigen::Index a) {
    const auto material = model.material[static_cast<std::size_t>(a)];
    return std::ranges::count(here, static_cast<std::size_t>(material)) > 0;
  };
  if (here.empty() || is_here(nearest)) return nearest;
  const Eigen::Map<const Eigen::Matrix<double, 1, Dim>> place(at.data());
  Eigen::Index best = nearest;
  double least = 2.0 * spacing;  // further off it has been dug away, or given to its neighbours
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double distance = (model.particles.position.row(a) - place).norm();
    if (distance >= least || !is_here(a)) continue;
    least = distance;
    best = a;
  }
  return best;
}

}  // namespace

template <int Dim>
void Measures<Dim>::locate(const scene::Scene& scene, const scene::Measure& asked,
                           Measure& measure) const {
  measure.particle = nearest_particle(scene, asked.at, model_);
  if (asked.kind != scene::MeasureKind::displacement && asked.kind != scene::MeasureKind::stress) {
    return;
  }
  const fpm::Field<Dim> point = Eigen::Map<const Eigen::Matrix<double, 1, Dim>>(asked.at.data());
  if (asked.kind == scene::MeasureKind::displacement) {
    measure.point =
        fpm::PointOperator<Dim>(model_.particles, model_.ghosts, point, model_.row_options);
    return;
  }
  locate_stress(scene, asked, measure);
}

template <int Dim>
void Measures<Dim>::locate_stress(const scene::Scene& scene, const scene::Measure& asked,
                                  Measure& measure) const {
  if (outline_) measure.particle = particle_of_stress(scene, *outline_, asked.at, model_);
  const auto particles = by_material(model_);
  const std::vector<fpm::Index> own{static_cast<fpm::Index>(measure.particle)};
  const auto material = model_.material[static_cast<std::size_t>(measure.particle)];
  const bool alternates =
      scene::is_nearly_incompressible(scene.material[static_cast<std::size_t>(material)]);
  const auto near = [&](const fpm::Field<Dim>& place) {
    Interpolated result;
    result.point =
        fpm::PointOperator<Dim>(particles, model_.ghosts, place, model_.row_options, own);
    if (!alternates) return result;
    fpm::RowOptions wide = model_.row_options;
    wide.support_radius *= 2.0;  // as of recovered_mean_stress
    try {
      result.mean = fpm::PointOperator<Dim>(within_reach(particles, result.point, own.front()),
                                            model_.ghosts, place, wide, own);
    } catch (const fpm::PoorNeighbourhood&) {
      // The mean is that of the point's own rows, then.
    }
    return result;
  };
  try {
    const fpm::Vector<Dim> place = Eigen::Map<const fpm::Vector<Dim>>(asked.at.data());
    measure.stress = near(place.transpose());
    const double reach = model_.spacing_at(measure.particle);
    const auto foot = foot_on_wall(walls_, place, reach);
    if (!foot) return;
    Interpolated on_wall = near(foot->place.transpose());
    auto fit = WallStress<Dim>::at(scene, model_, walls_,
                                   within_reach(particles, on_wall.point, own.front()), *foot,
                                   own.front());
    if (!fit) return;
    measure.wall = NextToWall{std::move(on_wall), std::move(*fit), 1.0 - foot->distance / reach};
  } catch (const fpm::PoorNeighbourhood&) {
    // Where they are too few for a gradient the stress is that of the particle.
    measure.kind = scene::MeasureKind::particle_stress;
  }
}

template <int Dim>
void Measures<Dim>::find_support(const scene::Scene& scene, const std::string& name,
                                 Measure& measure) const {
  measure.unknowns = holders_.of(name);
  std::size_t penalties = 0;
  for (const scene::Support& support : scene.support) {
    if (support.method != scene::SupportMethod::penalty) continue;
    if (support.name == name) measure.penalties.push_back(penalties);
    ++penalties;
  }
  // Of supports and the surfaces of cutouts, and of plates.
  add_contacts(&Interface<Dim>::support, name, measure);
  if (scene::has_stage_drives(scene)) add_contacts(&Interface<Dim>::of_drive, name, measure);
}

template <int Dim>
void Measures<Dim>::add_contacts(std::string Interface<Dim>::*of, const std::string& name,
                                 Measure& measure) const {
  Eigen::Index first = 0;
  for (const Interface<Dim>& interface : model_.interfaces) {
    const Eigen::Index count = interface.faces.points.size();
    if (interface.is_rigid() && interface.*of == name) {
      for (Eigen::Index c = 0; c < count; ++c) {
        measure.contacts.emplace_back(first + c, interface.faces.points.weight[c]);
      }
    }
    first += count;
  }
}

template <int Dim>
void Measures<Dim>::find_side(const scene::Scene& scene, scene::Side side, Measure& measure) const {
  measure.unknowns = holders_.on(scene, model_, side);
  std::size_t penalties = 0;
  for (const scene::Support& support : scene.support) {
    if (support.method != scene::SupportMethod::penalty) continue;
    if (support.side == side) measure.penalties.push_back(penalties);
    ++penalties;
  }
  for (const scene::Support& support : scene.support) {
    if (support.method == scene::SupportMethod::contact && support.side == side) {
      add_contacts(&Interface<Dim>::support, support.name, measure);
    }
  }
  for (const scene::ActingDrive& acting : scene::acting_drives(scene)) {
    const scene::Drive& drive = *acting.drive;
    if (scene::is_rigid_body(drive) && drive.side == side && !drive.level) {
      add_contacts(&Interface<Dim>::of_drive, scene::name_of_drive(drive), measure);
    }
  }
  const auto area_of = [&](const scene::Point& from, const scene::Point& to) {
    return side_points(scene, model_, side, from, to).points.weight.sum();
  };
  if (scene::is_face_by_itself(scene, side) &&
      std::ranges::count(scene.initial_stress.loaded_sides, scene::name_of(side)) > 0) {
    const int axis = scene::axis_of(side);
    const fpm::Tensor<Dim> stress =
        constitutive::spatial_part<Dim>(initial_stress_at<Dim>(scene, fpm::Vector<Dim>::Zero(), 0));
    const double area = (scene::is_upper(side) ? 1.0 : -1.0) * area_of({}, {});
    measure.loads.push_back({stress.col(axis) * area, {}, {}});
  }
  std::size_t following = 0;
  for (const scene::Traction& traction : scene.traction) {
    if (traction.side == side) {
      Load load{Eigen::Map<const fpm::Vector<Dim>>(traction.value.data()) *
                    area_of(traction.range_min, traction.range_max),
                scene::share_of(scene, scene::LoadKind::traction, traction.name),
                {}};
      if (traction.follower) load.following = following;
      measure.loads.push_back(load);
    }
    following += traction.follower ? 1 : 0;
  }
}

template <int Dim>
void Measures<Dim>::name_columns(const scene::Measure& asked) {
  const std::string_view force = Dim == 2 ? "N_per_m" : "N";
  const auto each = [&](std::string_view letter, std::string_view unit, const auto& components,
                        std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      columns_.push_back(fmt::format("{}_{}{}_{}", asked.name, letter, components[i], unit));
    }
  };
  switch (asked.kind) {
    case scene::MeasureKind::displacement:
      return each("u", "m", axes, Dim);
    case scene::MeasureKind::stress:
    case scene::MeasureKind::particle_stress:
      return each("s", "Pa", stresses, State<Dim>::stress_rows);
    case scene::MeasureKind::plastic_strain:
      columns_.push_back(asked.name + "_plastic_strain");
      return;
    case scene::MeasureKind::reaction:
      return each("R", force, axes, Dim);
    case scene::MeasureKind::resultant:
      return each("F", force, axes, Dim);
    case scene::MeasureKind::max_displacement:
      columns_.push_back(asked.name + "_max_displacement_m");
      return;
  }
}

// The force on the body, of whatever holds it there and of the loads.
template <int Dim>
fpm::Vector<Dim> Measures<Dim>::force(const Measure& measure, const State<Dim>& state) const {
  fpm::Vector<Dim> sum = fpm::Vector<Dim>::Zero();
  for (const auto& [k, part] : measure.unknowns.reaction) {
    sum[k / model_.size()] += part * state.reaction.data()[k];
  }
  for (const auto& [k, part] : measure.unknowns.side_reaction) {
    sum[k % Dim] += part * state.side_reaction.data()[k];
  }
  for (const auto& [point, weight] : measure.contacts) {
    sum += weight * state.interface_traction.col(point);
  }
  fpm::Field<Dim> nodal = fpm::Field<Dim>::Zero(model_.size(), Dim);
  std::size_t penalty = 0;
  for_each_penalty(model_, state, [&](const auto& support, const fpm::FieldView<Dim>& target) {
    if (std::ranges::count(measure.penalties, penalty++) == 0) return;
    sum += fpm::add_penalty_force<Dim>(support.op, support.points, support.options, target,
                                       state.displacement, nodal);
  });
  for (const Load& load : measure.loads) {
    const double grown = load.share.constant + load.share.growing * state.programme.load;
    if (!load.following) {
      sum += grown * load.force;
      continue;
    }
    const FollowingPressure<Dim>& pressure = model_.following_pressures[*load.following];
    nodal.setZero();
    // A point that is inside out ends the run before its state is measured.
    (void)fpm::add_following_pressure<Dim>(
        pressure.op, pressure.points,
        pressure.pressure * (pressure.scaled ? state.programme.load : 1.0), state.displacement,
        nodal);
    sum += nodal.colwise().sum().transpose();
  }
  return sum;
}

// Linear in the particles of the nearest one's material; an image behind a mirror has the stress of
// its particle seen there.
template <int Dim>
constitutive::StressVector<Dim> Measures<Dim>::stress(const Interpolated& place,
                                                      const State<Dim>& state) const {
  constitutive::StressVector<Dim> sum = constitutive::StressVector<Dim>::Zero();
  place.point.for_each_value(0, [&](fpm::Index a, double weight, const auto& sign) {
    sum += weight * behind_mirror<Dim>(state.stress.col(a), sign);
  });
  if (place.mean) {
    const Eigen::VectorXd mean = state.stress.template topRows<3>().colwise().mean().transpose();
    sum.template head<3>().array() +=
        place.mean->scalar_value(0, mean) - sum.template head<3>().mean();
  }
  return sum;
}

// Away from a wall the particles' error falls to a half in half a spacing, and so does what mends
// it.
template <int Dim>
constitutive::StressVector<Dim> Measures<Dim>::stress(const Measure& measure,
                                                      const State<Dim>& state) const {
  const constitutive::StressVector<Dim> here = stress(measure.stress, state);
  if (!measure.wall) return here;
  const constitutive::StressVector<Dim> foot = stress(measure.wall->foot, state);
  return here + measure.wall->share * (measure.wall->fit.of(state, foot) - foot);
}

template <int Dim>
std::vector<double> Measures<Dim>::of(const State<Dim>& state) const {
  std::vector<double> values;
  values.reserve(columns_.size());
  if (has_stages_) values.push_back(static_cast<double>(state.programme.stage) + 1.0);
  if (reduces_strength_) {
    values.push_back(scene::reduction_at(course_, state.programme.progress));
  }
  for (const Place& place : drives_) {
    values.push_back(place.scale * (place.moves ? state.programme.load : place.held));
  }
  // One that is not there has not turned.
  for (const auto& [axis, plate] : rotations_) {
    values.push_back(plate < 0 ? 0.0 : state.plate_rotation(axis, plate));
  }
  const auto add = [&](const auto& vector) {
    for (Eigen::Index i = 0; i < vector.size(); ++i) values.push_back(vector[i]);
  };
  for (const Measure& measure : measures_) {
    switch (measure.kind) {
      case scene::MeasureKind::displacement:
        add(measure.point.value(0, state.displacement));
        break;
      case scene::MeasureKind::stress:
        add(stress(measure, state));
        break;
      case scene::MeasureKind::particle_stress:
        add(state.stress.col(measure.particle));
        break;
      case scene::MeasureKind::plastic_strain:
        values.push_back(state.plastic_strain[measure.particle]);
        break;
      case scene::MeasureKind::reaction:
      case scene::MeasureKind::resultant:
        add(force(measure, state));
        break;
      case scene::MeasureKind::max_displacement:
        values.push_back(std::sqrt(state.displacement.rowwise().squaredNorm().maxCoeff()));
        break;
    }
  }
  return values;
}

std::vector<std::int64_t> stage_ends(const std::vector<std::string>& columns,
                                     const std::vector<record::CurveRow>& rows) {
  std::vector<std::int64_t> ends;
  const auto k =
      static_cast<std::size_t>(std::ranges::find(columns, stage_column) - columns.begin());
  for (std::size_t i = 1; k < columns.size() && i < rows.size(); ++i) {
    if (rows[i].measures[k] != rows[i - 1].measures[k]) ends.push_back(rows[i - 1].step);
  }
  return ends;
}

template class Measures<2>;
template class Measures<3>;

}  // namespace model

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
  const std::vector<scene::Measure> all = scene::resolve_measures(scene);
  std::optional<StressPoints<Dim>> stress_points;
  if (std::ranges::count(all, scene::MeasureKind::stress, &scene::Measure::kind) > 0) {
    stress_points.emplace(scene, model);
  }
  for (const scene::Measure& asked : all) {
    Measure& measure = measures_.emplace_back();
    measure.kind = asked.kind;
    if (asked.kind == scene::MeasureKind::stress) {
      measure.stress = stress_points->at(asked.at);
    } else if (!asked.at.empty()) {
      locate(scene, asked, measure);
    }
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

template <int Dim>
void Measures<Dim>::locate(const scene::Scene& scene, const scene::Measure& asked,
                           Measure& measure) const {
  measure.particle = nearest_particle(scene, asked.at, model_);
  if (asked.kind != scene::MeasureKind::displacement) return;
  const fpm::Field<Dim> point = Eigen::Map<const Eigen::Matrix<double, 1, Dim>>(asked.at.data());
  measure.point =
      fpm::PointOperator<Dim>(model_.particles, model_.ghosts, point, model_.row_options);
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
        add(measure.stress.of(state));
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

#include "model/initial_stress.hpp"

#include <algorithm>
#include <span>

#include "fpm/boundary_loads.hpp"
#include "model/side_points.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/geostatic.hpp"
#include "scene/layers.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

constexpr int up = 1;

// Sides that bear whatever stress there is across them.
bool bears_across(const scene::Scene& scene, scene::Side side) {
  const int axis = scene::axis_of(side);
  const bool supported = std::ranges::any_of(scene.support, [&](const scene::Support& support) {
    return support.side == side && support.method != scene::SupportMethod::penalty &&
           std::ranges::count(support.directions, static_cast<scene::Axis>(axis)) > 0;
  });
  return supported || std::ranges::any_of(scene.symmetry, [&](const scene::Symmetry& mirror) {
           return static_cast<int>(mirror.axis) == axis &&
                  std::abs(mirror.position - scene::side_position(scene.geometry, side)) <=
                      scene::same_place(scene.geometry);
         });
}

template <int Dim>
constitutive::StressVector<Dim> stress_in_layers(const scene::Scene& scene,
                                                 std::span<const scene::Layer> layers,
                                                 const fpm::Vector<Dim>& place,
                                                 std::size_t material) {
  const double vertical = scene::geostatic_stress(scene, layers, {place.data(), Dim});
  constitutive::StressVector<Dim> stress = constitutive::StressVector<Dim>::Zero();
  stress[0] = scene::resolve_k0(scene, scene.material[material]) * vertical;
  stress[up] = vertical;
  stress[2] = scene::resolve_k0_z(scene, scene.material[material]) * vertical;
  return stress;
}

}  // namespace

template <int Dim>
bool is_at_wall(const scene::Scene& scene, scene::Side side, const fpm::Vector<Dim>& place) {
  const scene::Drive& drive = scene.drive;
  if (!scene::drives_wall(scene) || drive.side != side) return false;
  return is_within_range<Dim>(scene, side, place, drive.range_min, drive.range_max);
}

template <int Dim>
constitutive::StressVector<Dim> geostatic_stress(const scene::Scene& scene,
                                                 const fpm::Vector<Dim>& place,
                                                 std::size_t material) {
  return stress_in_layers<Dim>(scene, scene::layers_of(scene), place, material);
}

template <int Dim>
constitutive::StressVector<Dim> initial_stress_at(const scene::Scene& scene,
                                                  const fpm::Vector<Dim>& place,
                                                  std::size_t material) {
  if (scene.initial_stress.kind == scene::InitialStressKind::geostatic) {
    return geostatic_stress<Dim>(scene, place, material);
  }
  if (scene.initial_stress.kind != scene::InitialStressKind::uniform) {
    return constitutive::StressVector<Dim>::Zero();
  }
  const auto stress = scene::uniform_stress(scene, scene.material[material]);
  return Eigen::Map<const constitutive::StressVector<Dim>>(stress.data());
}

namespace {

// Loads the sides beyond which the ground goes on with what the uniform stress presses and shears
// them with: sigma n, in the model's constant loads.
template <int Dim>
void add_loaded_sides(const scene::Scene& scene, Model<Dim>& model) {
  // In the plane, and in space all of it, it is the same in all materials.
  const fpm::Tensor<Dim> stress =
      constitutive::spatial_part<Dim>(initial_stress_at<Dim>(scene, fpm::Vector<Dim>::Zero(), 0));
  Eigen::Map<fpm::Field<Dim>> load(model.constant_load.data(), model.size(), Dim);
  const auto add = [&](const SurfacePoints<Dim>& surface) {
    const fpm::Field<Dim> traction = surface.points.normal * stress;  // which is symmetric
    fpm::add_traction<Dim>(surface.op, surface.points, traction, load);
  };
  for (const std::string& name : scene.initial_stress.loaded_sides) {
    for (std::size_t i = 0; i < scene.side.size(); ++i) {
      if (scene.side[i].name == name) add(surface_points(model, SurfacePart::of_side(i)));
    }
    for (std::size_t i = 0; i < scene.cutout.size(); ++i) {
      if (scene.cutout[i].name == name) add(surface_points(model, SurfacePart::of_cutout(i)));
    }
    for (int f = 0; f < 2 * Dim; ++f) {
      const auto face = static_cast<scene::Side>(f);
      if (scene::name_of(face) != name || !scene::is_face_by_itself(scene, face)) continue;
      add(side_points(scene, model, face, {}, {}));
    }
  }
}

// Geostatic stress at a point of a side, of the material within where that ends at an interface.
template <int Dim>
fpm::Tensor<Dim> stress_behind(const scene::Scene& scene, const Model<Dim>& model,
                               const fpm::BoundaryPoints<Dim>& points, fpm::Index c) {
  const fpm::Vector<Dim> place = points.position.row(c).transpose();
  const fpm::Vector<Dim> within = place - 0.5 * model.spacing * points.normal.row(c).transpose();
  return constitutive::spatial_part<Dim>(
      geostatic_stress<Dim>(scene, place, scene::material_at(scene, {within.data(), Dim})));
}

// What the geostatic stress presses with on the sides of a box that do not bear it.
template <int Dim>
void add_faces(const scene::Scene& scene, const Model<Dim>& model, fpm::Field<Dim>& load) {
  for (int s = 0; s < 2 * Dim; ++s) {
    const auto side = static_cast<scene::Side>(s);
    if (!scene::is_face_by_itself(scene, side) || bears_across(scene, side)) continue;
    const SurfacePoints<Dim> face = side_points(scene, model, side, {}, {});
    const int axis = scene::axis_of(side);
    fpm::Field<Dim> force = fpm::Field<Dim>::Zero(face.points.size(), Dim);
    for (fpm::Index c = 0; c < face.points.size(); ++c) {
      const fpm::Vector<Dim> place = face.points.position.row(c).transpose();
      if (is_at_wall<Dim>(scene, side, place)) continue;
      const fpm::Tensor<Dim> stress = stress_behind<Dim>(scene, model, face.points, c);
      force(c, axis) = face.points.weight[c] * face.points.normal(c, axis) * stress(axis, axis);
    }
    face.op.add_transposed_values(force, load);
  }
}

// Likewise on the sides of regions that are loaded; of the others those that do not bear it are
// refused (check_stress_at_rest).
template <int Dim>
void add_sides(const scene::Scene& scene, const Model<Dim>& model, fpm::Field<Dim>& load) {
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    if (scene.side[i].kind != scene::OutlineKind::loaded) continue;
    const auto surface = surface_points(model, SurfacePart::of_side(i));
    fpm::Field<Dim> traction = fpm::Field<Dim>::Zero(surface.points.size(), Dim);
    for (fpm::Index c = 0; c < surface.points.size(); ++c) {
      const fpm::Vector<Dim> normal = surface.points.normal.row(c).transpose();
      traction.row(c) = (stress_behind<Dim>(scene, model, surface.points, c) * normal).transpose();
    }
    fpm::add_traction<Dim>(surface.op, surface.points, traction, load);
  }
}

}  // namespace

template <int Dim>
Eigen::VectorXd constant_loads(const Model<Dim>& model) {
  Eigen::VectorXd loads = model.constant_load;
  const fpm::Field<Dim> at_rest = fpm::Field<Dim>::Zero(model.size(), Dim);
  Eigen::Map<fpm::Field<Dim>> field(loads.data(), model.size(), Dim);
  for (const FollowingPressure<Dim>& following : model.following_pressures) {
    if (following.scaled) continue;
    (void)fpm::add_following_pressure<Dim>(following.op, following.points, following.pressure,
                                           at_rest, field);
  }
  return loads;
}

template <int Dim>
void add_initial_stress(const scene::Scene& scene, Model<Dim>& model) {
  const bool uniform = scene.initial_stress.kind == scene::InitialStressKind::uniform;
  if (!uniform && scene.initial_stress.kind != scene::InitialStressKind::geostatic) return;
  const Eigen::Index n = model.size();
  model.initial_stress.resize(constitutive::stress_size<Dim>, n);
  const auto layers = scene::layers_of(scene);
  for (Eigen::Index a = 0; a < n; ++a) {
    const fpm::Vector<Dim> place = model.particles.position.row(a).transpose();
    const std::size_t material = model.material[static_cast<std::size_t>(a)];
    model.initial_stress.col(a) = uniform ? initial_stress_at<Dim>(scene, place, material)
                                          : stress_in_layers<Dim>(scene, layers, place, material);
  }
  if (uniform) {
    // It is borne by what bears it (check_stress_at_rest), to the last particle.
    add_loaded_sides(scene, model);
    model.initial_load = constant_loads(model);
    return;
  }
  model.wall_bears = scene::drives_wall(scene);
  fpm::Field<Dim> load = fpm::Field<Dim>::Zero(n, Dim);
  for (std::size_t i = 0; i < scene.gravity.acceleration.size(); ++i) {
    load.col(static_cast<Eigen::Index>(i)) = model.mass * scene.gravity.acceleration[i];
  }
  if (model.water_load.size() > 0) {
    load += Eigen::Map<const fpm::Field<Dim>>(model.water_load.data(), n, Dim);
  }
  add_faces(scene, model, load);
  add_sides(scene, model, load);
  take_wall_force(scene, model);
  model.initial_load = Eigen::Map<const Eigen::VectorXd>(load.data(), model.unknowns());
}

template <int Dim>
void take_wall_force(const scene::Scene& scene, Model<Dim>& model) {
  model.wall_force.reset();
  const scene::Drive& drive = scene.drive;
  if (!model.wall_bears || scene::resolve_drive_method(scene) != scene::DriveMethod::direct) return;
  const SurfacePoints<Dim> face =
      side_points(scene, model, drive.side, drive.range_min, drive.range_max);
  const double outwards = scene::is_upper(drive.side) ? 1.0 : -1.0;
  fpm::Field<Dim> traction(model.size(), Dim);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const fpm::Tensor<Dim> stress = constitutive::spatial_part<Dim>(
        constitutive::StressVector<Dim>(model.initial_stress.col(a)));
    traction.row(a) = outwards * stress.col(scene::axis_of(drive.side)).transpose();
  }
  // What acts along it is borne as by any drive.
  const int across = scene::axis_of(drive.side);
  fpm::Vector<Dim> force = fpm::Vector<Dim>::Zero();
  for (fpm::Index c = 0; c < face.points.size(); ++c) {
    force[across] += face.points.weight[c] * face.op.value(c, traction)[across];
  }
  model.wall_force = force;
}

template void take_wall_force<2>(const scene::Scene&, Model<2>&);
template void take_wall_force<3>(const scene::Scene&, Model<3>&);
template bool is_at_wall<2>(const scene::Scene&, scene::Side, const fpm::Vector<2>&);
template bool is_at_wall<3>(const scene::Scene&, scene::Side, const fpm::Vector<3>&);
template constitutive::StressVector<2> geostatic_stress<2>(const scene::Scene&,
                                                           const fpm::Vector<2>&, std::size_t);
template constitutive::StressVector<3> geostatic_stress<3>(const scene::Scene&,
                                                           const fpm::Vector<3>&, std::size_t);
template constitutive::StressVector<2> initial_stress_at<2>(const scene::Scene&,
                                                            const fpm::Vector<2>&, std::size_t);
template constitutive::StressVector<3> initial_stress_at<3>(const scene::Scene&,
                                                            const fpm::Vector<3>&, std::size_t);
template Eigen::VectorXd constant_loads<2>(const Model<2>&);
template Eigen::VectorXd constant_loads<3>(const Model<3>&);
template void add_initial_stress<2>(const scene::Scene&, Model<2>&);
template void add_initial_stress<3>(const scene::Scene&, Model<3>&);

}  // namespace model

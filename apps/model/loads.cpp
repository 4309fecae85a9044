#include "model/loads.hpp"

#include <algorithm>
#include <cmath>

#include "model/bodies.hpp"
#include "model/selection.hpp"
#include "model/side_points.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Where a load is added, and how much of it.
struct LoadTarget {
  Eigen::VectorXd& load;
  double factor;
};

template <int Dim>
LoadTarget target_of(const scene::LoadShare& share, Model<Dim>& model) {
  if (share.growing != 0.0) return {model.scaled_load, share.growing};
  return {model.constant_load, share.constant};
}

// Departure: weight is lumped to the particles, not spread by N^T (share/doc/decisions/gravity.md).
template <int Dim>
void add_gravity(const scene::Scene& scene, Model<Dim>& model) {
  if (scene.gravity.acceleration.empty()) return;
  const auto [load, factor] = target_of(scene::share_of(scene, scene::LoadKind::gravity), model);
  const Eigen::Index n = model.size();
  for (int i = 0; i < Dim; ++i) {
    const double acceleration = factor * scene.gravity.acceleration[static_cast<std::size_t>(i)];
    load.segment(i * n, n) += model.mass * acceleration;
  }
  if (model.water_load.size() > 0) load += factor * model.water_load;
}

template <int Dim>
void add_tractions(const scene::Scene& scene, Model<Dim>& model) {
  for (const scene::Traction& traction : scene.traction) {
    const scene::LoadShare share = scene::share_of(scene, scene::LoadKind::traction, traction.name);
    const auto [load, factor] = target_of(share, model);
    auto side = side_points(scene, model, traction.side, traction.range_min, traction.range_max);
    const fpm::Vector<Dim> value =
        factor * Eigen::Map<const fpm::Vector<Dim>>(traction.value.data());
    if (traction.follower) {
      const double outward = scene::is_upper(traction.side) ? 1.0 : -1.0;
      model.following_pressures.push_back({std::move(side.op), std::move(side.points),
                                           -outward * value[scene::axis_of(traction.side)],
                                           share.growing != 0.0});
    } else {
      Eigen::Map<fpm::Field<Dim>> field(load.data(), model.size(), Dim);
      fpm::add_uniform_traction<Dim>(side.op, side.points, value, field);
    }
  }
}

// A pressure, and a shear along the surface that has the body to its left.
template <int Dim>
void add_surface_load(const SurfacePoints<Dim>& surface, double pressure, double shear,
                      const scene::LoadShare& share, Model<Dim>& model) {
  if (pressure == 0.0 && shear == 0.0) return;
  const auto [load, factor] = target_of(share, model);
  pressure *= factor;
  shear *= factor;
  fpm::Field<Dim> traction = -pressure * surface.points.normal;
  // The normal turned to the left.
  traction.col(0) -= shear * surface.points.normal.col(1);
  traction.col(1) += shear * surface.points.normal.col(0);
  Eigen::Map<fpm::Field<Dim>> field(load.data(), load.size() / Dim, Dim);
  fpm::add_traction<Dim>(surface.op, surface.points, traction, field);
}

// What presses on the surfaces that cutouts leave, and on the scene's sides.
template <int Dim>
void add_surface_loads(const scene::Scene& scene, Model<Dim>& model) {
  for (std::size_t i = 0; i < scene.cutout.size(); ++i) {
    const scene::Cutout& cutout = scene.cutout[i];
    if (cutout.pressure == 0.0 && cutout.shear == 0.0) continue;
    add_surface_load(surface_points(model, SurfacePart::of_cutout(i)), cutout.pressure,
                     cutout.shear, scene::share_of(scene, scene::LoadKind::traction, cutout.name),
                     model);
  }
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    const scene::OutlineSide& side = scene.side[i];
    if (side.kind != scene::OutlineKind::loaded) continue;
    const SurfacePoints<Dim> surface = surface_points(model, SurfacePart::of_side(i));
    add_surface_load(surface, side.pressure, side.shear, {}, model);
    add_surface_load(surface, side.live_pressure, side.live_shear,
                     scene::share_of(scene, scene::LoadKind::traction, side.name), model);
  }
}

// The particles of a region, or the one at a place, as points: each with the area of one face of
// its cell.
template <int Dim>
SurfacePoints<Dim> particle_points(const scene::Scene& scene, const Model<Dim>& model,
                                   const scene::Support& support) {
  SurfacePoints<Dim> result;
  std::vector<fpm::Index> particles;
  for (const Eigen::Index a : supported_particles(scene, support, model)) {
    particles.push_back(static_cast<fpm::Index>(a));
  }
  const auto n = static_cast<Eigen::Index>(particles.size());
  result.points.position.resize(n, Dim);
  result.points.normal.setZero(n, Dim);  // a support by components has no use for it
  result.points.weight.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const fpm::Index a = particles[static_cast<std::size_t>(k)];
    result.points.position.row(k) = model.particles.position.row(a);
    result.points.weight[k] = std::pow(model.particles.volume[a], (Dim - 1.0) / Dim);
  }
  result.op = fpm::PointOperator<Dim>::at_particles(model.particles, model.ghosts, particles,
                                                    model.row_options);
  return result;
}

// Young's modulus of the material that each point of a support holds: that of the particles next
// to it, half a spacing into the body from a point on a face of cells.
template <int Dim>
Eigen::VectorXd moduli_at(const scene::Scene& scene, const scene::Support& support,
                          const fpm::Field<Dim>& points) {
  fpm::Vector<Dim> inward = fpm::Vector<Dim>::Zero();
  if (support.side && scene.geometry.layout == scene::Layout::cell) {
    inward[scene::axis_of(*support.side)] =
        (scene::is_upper(*support.side) ? -0.5 : 0.5) * scene.geometry.spacing;
  }
  Eigen::VectorXd moduli(points.rows());
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    const fpm::Vector<Dim> place = points.row(k).transpose() + inward;
    const scene::Material& material =
        scene.material[scene::material_at(scene, {place.data(), Dim})];
    moduli[k] = material.youngs_modulus.at_place({place.data(), Dim});
  }
  return moduli;
}

// The stiffness follows the material that is held, point by point.
template <int Dim>
void add_penalty_supports(const scene::Scene& scene, Model<Dim>& model) {
  for (const scene::Support& support : scene.support) {
    if (support.method != scene::SupportMethod::penalty) continue;
    auto side = support.side ? side_points(scene, model, *support.side, {}, {})
                             : particle_points(scene, model, support);
    fpm::PenaltyOptions<Dim> options;
    options.prescribed = fpm::PenaltyOptions<Dim>::filled(false);
    for (const scene::Axis axis : support.directions) {
      options.prescribed[static_cast<std::size_t>(axis)] = true;
    }
    const Eigen::VectorXd moduli = moduli_at<Dim>(scene, support, side.points.position);
    const double largest = moduli.maxCoeff();
    options.penalty = support.penalty_factor * largest / scene.geometry.spacing;
    // One penalty per support: the weights carry the ratio of the moduli.
    side.points.weight.array() *= moduli.array() / largest;
    const fpm::Field<Dim> target = fpm::Field<Dim>::Zero(side.points.size(), Dim);
    model.penalty_supports.push_back(
        {std::move(side.op), std::move(side.points), options, target, support.name});
  }
}

}  // namespace

template <int Dim>
void add_loads(const scene::Scene& scene, Model<Dim>& model) {
  model.constant_load.setZero(model.unknowns());
  model.scaled_load.setZero(model.unknowns());
  add_gravity(scene, model);
  add_tractions(scene, model);
  add_surface_loads(scene, model);
  add_penalty_supports(scene, model);
}

namespace {

fpm::Face face_at(int axis, double position, double middle) {
  return {axis, position > middle};
}

// The part of a side that is boundary by its own points: not where it goes on in images or is tied.
SurfacePart bounding_part(const scene::Scene& scene, std::size_t side,
                          const std::vector<fpm::Face>& faces) {
  SurfacePart part = SurfacePart::of_side(side);
  const bool tied = scene::holds(scene.side[side].kind);
  part.without[SurfacePart::no_face] = tied;
  for (int f = 0; f < 2 * scene.geometry.dimension; ++f) {
    const auto face = static_cast<scene::Side>(f);
    const bool bounds = std::ranges::any_of(faces, [&](const fpm::Face& other) {
      return other.axis == scene::axis_of(face) && other.upper == scene::is_upper(face);
    });
    part.without[static_cast<std::size_t>(f)] = !bounds || (tied && !scene::is_held(scene, face));
  }
  return part;
}

// Of the surface of a body cut to shape, as far as it is on given faces of the box or on none, but
// for the parts under plates.
template <int Dim>
fpm::Field<Dim> cut_area_vectors(const scene::Scene& scene, const Model<Dim>& model,
                                 const std::vector<fpm::Face>& faces,
                                 const std::vector<fpm::GhostPlane<Dim>>& plates) {
  fpm::Field<Dim> area = fpm::Field<Dim>::Zero(model.size(), Dim);
  const auto add = [&](const SurfacePart& part, double sign) {
    const SurfacePoints<Dim> surface = surface_points(model, part);
    area += sign * fpm::area_vectors(surface.op, surface.points);
  };
  for (std::size_t i = 0; i < scene.cutout.size(); ++i) {
    if (scene.cutout[i].kind == scene::CutoutKind::free) add(SurfacePart::of_cutout(i), 1.0);
  }
  for (std::size_t i = 0; i < scene.side.size(); ++i) add(bounding_part(scene, i, faces), 1.0);
  add(SurfacePart::of_exposed(), 1.0);
  for (const fpm::Face& face : faces) {
    const auto side = static_cast<scene::Side>(2 * face.axis + (face.upper ? 1 : 0));
    if (scene::is_face_by_itself(scene, side)) add(SurfacePart::of_face(face), 1.0);
  }
  for (const auto& plate : plates) {
    const double middle = 0.5 * (model.box_min[plate.axis] + model.box_max[plate.axis]);
    SurfacePart under = SurfacePart::of_face(face_at(plate.axis, plate.position, middle));
    for (int i = 0; i < Dim; ++i) {
      under.from[static_cast<std::size_t>(i)] = plate.range_min[i];
      under.to[static_cast<std::size_t>(i)] = plate.range_max[i];
    }
    // Of planes the drive's alone has a range.
    if (scene::drive_by_images(scene)->drive->level) {
      under = SurfacePart::of_side(*scene::footing_of(scene));
    }
    add(under, -1.0);
  }
  return area;
}

// Of the faces of the box.
template <int Dim>
fpm::Field<Dim> outer_area_vectors(const scene::Scene& scene, const Model<Dim>& model) {
  const fpm::Vector<Dim> middle = 0.5 * (model.box_min + model.box_max);
  const auto face_of = [&](const fpm::GhostPlane<Dim>& plane) {
    return face_at(plane.axis, plane.position, middle[plane.axis]);
  };
  std::vector<fpm::Face> faces = fpm::all_faces<Dim>();
  const auto& planes = model.ghosts.planes();
  std::erase_if(faces, [&](const fpm::Face& face) {
    return std::any_of(planes.begin(), planes.end(), [&](const auto& plane) {
      const fpm::Face behind = face_of(plane);
      return !plane.has_range() && behind.axis == face.axis && behind.upper == face.upper;
    });
  });
  // Behind a plate on a part of a face the body goes on; beside it the face is its boundary.
  std::vector<fpm::GhostPlane<Dim>> plates;
  for (const auto& plane : planes) {
    if (plane.has_range()) plates.push_back(plane);
  }
  if (is_plain_vertex_lattice(scene)) {
    const auto& lattice = model.cells.lattice();
    fpm::Field<Dim> area = fpm::tributary_area_vectors(lattice, faces);
    for (const auto& plate : plates) {
      const auto under =
          fpm::tributary_points(lattice, face_of(plate), plate.range_min, plate.range_max);
      for (fpm::Index c = 0; c < under.points.size(); ++c) {
        area.row(under.particle[static_cast<std::size_t>(c)]) -=
            under.points.weight[c] * under.points.normal.row(c);
      }
    }
    return area;
  }
  if (!model.surface.empty()) return cut_area_vectors(scene, model, faces, plates);
  fpm::BoundaryPoints<Dim> points;
  for (const fpm::Face& face : faces) points.append(fpm::boundary_quadrature(model.cells, face));
  for (const auto& plate : plates) {
    auto under =
        fpm::boundary_quadrature(model.cells, face_of(plate), plate.range_min, plate.range_max);
    under.weight *= -1.0;
    points.append(under);
  }
  const fpm::PointOperator<Dim> op(model.particles, model.ghosts, points.position,
                                   model.row_options, particles_at(model, points));
  return fpm::area_vectors(op, points);
}

}  // namespace

template <int Dim>
fpm::Field<Dim> boundary_area_vectors(const scene::Scene& scene, const Model<Dim>& model) {
  fpm::Field<Dim> area = outer_area_vectors(scene, model);
  for (const Interface<Dim>& interface : model.interfaces) {
    if (interface.is_rigid() && !interface.is_boundary) continue;
    const auto& points = interface.faces.points;
    const fpm::Field<Dim> piece = points.weight.asDiagonal() * points.normal;
    interface.faces.first.add_transposed_values(piece, area);
    if (interface.is_rigid()) continue;
    interface.faces.second.add_transposed_values(fpm::Field<Dim>(-piece), area);
  }
  return area;
}

template void add_loads<2>(const scene::Scene&, Model<2>&);
template void add_loads<3>(const scene::Scene&, Model<3>&);
template fpm::Field<2> boundary_area_vectors<2>(const scene::Scene&, const Model<2>&);
template fpm::Field<3> boundary_area_vectors<3>(const scene::Scene&, const Model<3>&);

}  // namespace model

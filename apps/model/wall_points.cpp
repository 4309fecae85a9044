#include "model/wall_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "constitutive/tensor.hpp"
#include "fpm/boundary.hpp"
#include "model/initial_stress.hpp"
#include "model/planes.hpp"
#include "model/side_points.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

template <int Dim>
void add(const fpm::Vector<Dim>& traction, const scene::LoadShare& share, WallPoint<Dim>& point) {
  point.constant += share.constant * traction;
  point.growing += share.growing * traction;
}

// A pressure, and a shear along a surface of the plane that has the body to its left.
template <int Dim>
fpm::Vector<Dim> traction_of(double pressure, double shear, const fpm::Vector<Dim>& normal) {
  fpm::Vector<Dim> traction = -pressure * normal;
  traction[0] -= shear * normal[1];
  traction[1] += shear * normal[0];
  return traction;
}

template <int Dim>
bool is_mirror(const Model<Dim>& model, const std::vector<char>& are_mirrors,
               const fpm::Face& face) {
  const auto& planes = model.ghosts.planes();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const double middle = 0.5 * (model.box_min[face.axis] + model.box_max[face.axis]);
    const bool is_here = planes[p].axis == face.axis && (planes[p].position > middle) == face.upper;
    if (is_here && are_mirrors[p] != 0) return true;
  }
  return false;
}

// What supports and plates hold of a face of the box is not known; what presses on the rest is.
template <int Dim>
void say_of_face(const scene::Scene& scene, const fpm::Face& face, WallPoint<Dim>& point) {
  const auto side = static_cast<scene::Side>(2 * face.axis + (face.upper ? 1 : 0));
  point.is_known = std::ranges::none_of(
      scene.support, [&](const scene::Support& support) { return support.side == side; });
  for (const scene::Drive* drive : scene::all_drives(scene)) {
    const bool has_plate =
        drive->kind == scene::DriveKind::displacement || scene::is_rigid_body(*drive);
    if (!has_plate || drive->side != side || drive->level) continue;
    if (is_within_range<Dim>(scene, side, point.position, drive->range_min, drive->range_max)) {
      point.is_known = false;
    }
  }
  for (const scene::Traction& traction : scene.traction) {
    if (traction.side != side) continue;
    if (!is_within_range<Dim>(scene, side, point.position, traction.range_min,
                              traction.range_max)) {
      continue;
    }
    add<Dim>(Eigen::Map<const fpm::Vector<Dim>>(traction.value.data()),
             scene::share_of(scene, scene::LoadKind::traction, traction.name), point);
  }
}

template <int Dim>
void say_of_cutout(const scene::Scene& scene, std::size_t index, WallPoint<Dim>& point) {
  const scene::Cutout& cutout = scene.cutout[index];
  point.is_known = cutout.kind == scene::CutoutKind::free;
  add(traction_of(cutout.pressure, cutout.shear, point.normal),
      scene::share_of(scene, scene::LoadKind::traction, cutout.name), point);
}

template <int Dim>
void say_of_side(const scene::Scene& scene, std::size_t index, WallPoint<Dim>& point) {
  const scene::OutlineSide& side = scene.side[index];
  const bool loaded = side.kind == scene::OutlineKind::loaded;
  point.is_known = point.is_known && (loaded || side.kind == scene::OutlineKind::free);
  if (!loaded) return;
  add(traction_of(side.pressure, side.shear, point.normal), {}, point);
  add(traction_of(side.live_pressure, side.live_shear, point.normal),
      scene::share_of(scene, scene::LoadKind::traction, side.name), point);
}

// Beyond a side that a uniform initial stress loads the ground goes on, and presses with it.
template <int Dim>
void say_of_stress(const scene::Scene& scene, int cut, int side, int face, WallPoint<Dim>& point) {
  if (!is_loaded_by_stress(scene, cut, side, face)) return;
  const fpm::Tensor<Dim> stress =
      constitutive::spatial_part<Dim>(initial_stress_at<Dim>(scene, point.position, 0));
  point.constant += stress * point.normal;
}

// Calls add(place, normal, area) for the points of a piece.
template <class Add>
void for_each_point(const Model<2>& model, const SurfacePiece<2>& piece, Add&& add) {
  const Eigen::Vector2d along = piece.to - piece.from;
  const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()).normalized();
  const int count = point_count(model, piece);
  for (int k = 0; k < count; ++k) {
    add(Eigen::Vector2d(piece.from + (k + 0.5) / count * along), outward, along.norm() / count);
  }
}
template <class Add>
void for_each_point(const Model<3>& /*model*/, const SurfacePiece<3>& piece, Add&& add) {
  add(piece.middle, piece.outward, piece.area);
}

template <int Dim>
void add_piece(const scene::Scene& scene, const Model<Dim>& model,
               const std::vector<char>& are_mirrors, const SurfacePiece<Dim>& piece,
               std::vector<WallPoint<Dim>>& points) {
  const fpm::Face face{piece.face / 2, piece.face % 2 == 1};
  if (piece.face >= 0 && is_mirror(model, are_mirrors, face)) return;
  for_each_point(model, piece,
                 [&](const fpm::Vector<Dim>& place, const fpm::Vector<Dim>& outward, double area) {
                   WallPoint<Dim> point;
                   point.position = place;
                   point.normal = outward;
                   point.area = area;
                   point.particle = piece.particle;
                   point.is_known = true;
                   if (piece.face >= 0) say_of_face(scene, face, point);
                   if (piece.cut >= 0)
                     say_of_cutout(scene, static_cast<std::size_t>(piece.cut), point);
                   if (piece.side >= 0)
                     say_of_side(scene, static_cast<std::size_t>(piece.side), point);
                   say_of_stress(scene, piece.cut, piece.side, piece.face, point);
                   points.push_back(point);
                 });
}

// Where bodies meet, or one meets a rigid one. Rows that see through a joint make no difference.
template <int Dim>
void add_meetings(const Model<Dim>& model, std::vector<WallPoint<Dim>>& points) {
  for (const Interface<Dim>& interface : model.interfaces) {
    const auto& faces = interface.faces.points;
    for (Eigen::Index c = 0; c < faces.size(); ++c) {
      WallPoint<Dim> point;
      point.position = faces.position.row(c).transpose();
      point.normal = faces.normal.row(c).transpose();
      point.area = faces.weight[c];
      points.push_back(point);
    }
  }
}

// What the images behind mirrors have.
template <int Dim>
void add_images(const Model<Dim>& model, const std::vector<char>& are_mirrors,
                std::vector<WallPoint<Dim>>& points) {
  for (std::size_t p = 0; p < are_mirrors.size(); ++p) {
    const fpm::GhostPlane<Dim>& plane = model.ghosts.planes()[p];
    if (are_mirrors[p] == 0) continue;
    const std::size_t count = points.size();
    for (std::size_t k = 0; k < count; ++k) {
      WallPoint<Dim> image = points[k];
      image.is_image = true;
      image.position[plane.axis] = 2.0 * plane.position - image.position[plane.axis];
      for (auto* vector : {&image.normal, &image.constant, &image.growing}) {
        (*vector)[plane.axis] *= -1.0;
      }
      points.push_back(image);
    }
  }
}

}  // namespace

template <int Dim>
std::vector<WallPoint<Dim>> wall_points(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<WallPoint<Dim>> points;
  if (scene.geometry.layout == scene::Layout::vertex) return points;
  const std::vector<char> are_mirrors = mirrors(scene, model);
  for (const SurfacePiece<Dim>& piece : model.surface) {
    add_piece(scene, model, are_mirrors, piece, points);
  }
  for (const fpm::Face& face : fpm::all_faces<Dim>()) {
    if (!model.surface.empty() || is_mirror(model, are_mirrors, face)) continue;
    const auto quadrature = fpm::boundary_quadrature(model.cells, face);
    for (Eigen::Index c = 0; c < quadrature.size(); ++c) {
      WallPoint<Dim> point;
      point.position = quadrature.position.row(c).transpose();
      point.normal = quadrature.normal.row(c).transpose();
      point.area = quadrature.weight[c];
      say_of_face(scene, face, point);
      say_of_stress(scene, -1, -1, 2 * face.axis + (face.upper ? 1 : 0), point);
      points.push_back(point);
    }
  }
  add_meetings(model, points);
  add_images(model, are_mirrors, points);
  return points;
}

template <int Dim>
std::optional<Foot<Dim>> foot_on_wall(const std::vector<WallPoint<Dim>>& walls,
                                      const fpm::Vector<Dim>& place, double reach) {
  const WallPoint<Dim>* nearest = nullptr;
  double least = 2.0 * reach;  // points are half as far apart, or somewhat more on elements
  for (const WallPoint<Dim>& wall : walls) {
    const double distance = (wall.position - place).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = &wall;
  }
  if (nearest == nullptr) return std::nullopt;
  const double outward = (place - nearest->position).dot(nearest->normal);
  if (std::abs(outward) >= reach) return std::nullopt;
  return Foot<Dim>{place - outward * nearest->normal, nearest->normal, std::abs(outward)};
}

template std::optional<Foot<2>> foot_on_wall<2>(const std::vector<WallPoint<2>>&,
                                                const fpm::Vector<2>&, double);
template std::optional<Foot<3>> foot_on_wall<3>(const std::vector<WallPoint<3>>&,
                                                const fpm::Vector<3>&, double);
template std::vector<WallPoint<2>> wall_points<2>(const scene::Scene&, const Model<2>&);
template std::vector<WallPoint<3>> wall_points<3>(const scene::Scene&, const Model<3>&);

}  // namespace model

#include "model/side_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "model/bodies.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// A range along a side (Dim - 1 entries) as a box of Dim entries; empty means the whole side.
template <int Dim>
fpm::Vector<Dim> range_corner(const scene::Point& range, scene::Side side, double otherwise) {
  fpm::Vector<Dim> corner = fpm::Vector<Dim>::Constant(otherwise);
  std::size_t k = 0;
  for (int i = 0; i < Dim && !range.empty(); ++i) {
    if (i != scene::axis_of(side)) corner[i] = range[k++];
  }
  return corner;
}

}  // namespace

template <int Dim>
bool is_within_range(const scene::Scene& scene, scene::Side side, const fpm::Vector<Dim>& place,
                     const scene::Point& range_min, const scene::Point& range_max) {
  const double slack = scene::same_place(scene.geometry);
  std::size_t k = 0;
  for (int i = 0; i < Dim && !range_min.empty(); ++i) {
    if (i == scene::axis_of(side)) continue;
    if (place[i] < range_min[k] - slack || place[i] > range_max[k] + slack) return false;
    ++k;
  }
  return true;
}

template bool is_within_range<2>(const scene::Scene&, scene::Side, const fpm::Vector<2>&,
                                 const scene::Point&, const scene::Point&);
template bool is_within_range<3>(const scene::Scene&, scene::Side, const fpm::Vector<3>&,
                                 const scene::Point&, const scene::Point&);

std::string name_of_surface(const scene::Scene& scene, int cut, int side, int face) {
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  if (cut >= 0) return fmt::format("the cutout \"{}\"", scene.cutout[index(cut)].name);
  if (side >= 0) return fmt::format("the side \"{}\"", scene.side[index(side)].name);
  if (side == exposed_side) return "ground that lies bare";
  const auto of_box = static_cast<scene::Side>(face);
  if (face >= 0 && scene::is_face_by_itself(scene, of_box)) {
    return fmt::format("the face \"{}\"", scene::name_of(of_box));
  }
  return "a part of the outline that no [[side]] names";
}

bool is_loaded_by_stress(const scene::Scene& scene, int cut, int side, int face) {
  if (scene.initial_stress.kind != scene::InitialStressKind::uniform) return false;
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  std::string_view name;
  if (cut >= 0) {
    name = scene.cutout[index(cut)].name;
  } else if (side >= 0) {
    name = scene.side[index(side)].name;
  } else if (face >= 0 && scene::is_face_by_itself(scene, static_cast<scene::Side>(face))) {
    name = scene::name_of(static_cast<scene::Side>(face));
  }
  return !name.empty() && std::ranges::count(scene.initial_stress.loaded_sides, name) > 0;
}

bool is_plain_vertex_lattice(const scene::Scene& scene) {
  return scene.geometry.layout == scene::Layout::vertex && scene.geometry.jitter == 0.0;
}

template <int Dim>
SurfacePoints<Dim> side_points(const scene::Scene& scene, const Model<Dim>& model, scene::Side side,
                               const scene::Point& range_min, const scene::Point& range_max) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const fpm::Face face{scene::axis_of(side), scene::is_upper(side)};
  const auto from = range_corner<Dim>(range_min, side, -infinity);
  const auto to = range_corner<Dim>(range_max, side, infinity);
  SurfacePoints<Dim> result;
  if (is_plain_vertex_lattice(scene)) {
    auto tributary = fpm::tributary_points(model.cells.lattice(), face, from, to);
    result.op = fpm::PointOperator<Dim>::at_particles(model.particles, model.ghosts,
                                                      tributary.particle, model.row_options);
    result.points = std::move(tributary.points);
    return result;
  }
  if (!model.surface.empty()) {
    SurfacePart part = SurfacePart::of_face(face);
    for (int i = 0; i < Dim; ++i) {
      part.from[static_cast<std::size_t>(i)] = from[i];
      part.to[static_cast<std::size_t>(i)] = to[i];
    }
    return surface_points(model, part);
  }
  result.points = fpm::boundary_quadrature(model.cells, face, from, to);
  result.op = fpm::PointOperator<Dim>(model.particles, model.ghosts, result.points.position,
                                      model.row_options, particles_at(model, result.points));
  return result;
}

template SurfacePoints<2> side_points<2>(const scene::Scene&, const Model<2>&, scene::Side,
                                         const std::vector<double>&, const std::vector<double>&);
template SurfacePoints<3> side_points<3>(const scene::Scene&, const Model<3>&, scene::Side,
                                         const std::vector<double>&, const std::vector<double>&);

}  // namespace model

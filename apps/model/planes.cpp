#include "model/planes.hpp"

#include <algorithm>
#include <set>

#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

template <int Dim>
fpm::GhostPlane<Dim> plane_at(const scene::Scene& scene, scene::Side side) {
  fpm::GhostPlane<Dim> plane;
  plane.axis = scene::axis_of(side);
  plane.position = scene::side_position(scene.geometry, side);
  return plane;
}

template <int Dim>
fpm::GhostPlane<Dim> driven(const scene::Scene& scene, const scene::Drive& drive) {
  fpm::GhostPlane<Dim> plane = plane_at<Dim>(scene, drive.side);
  plane.position = scene::plate_position(scene.geometry, drive);
  const double slack = scene::same_place(scene.geometry);
  std::size_t k = 0;
  for (int i = 0; i < Dim; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    plane.held[axis] = drive.lateral == scene::Lateral::fixed || drive.direction[axis] != 0.0;
    if (i == plane.axis || drive.range_min.empty()) continue;
    plane.range_min[i] = drive.range_min[k] - slack;
    plane.range_max[i] = drive.range_max[k] + slack;
    ++k;
  }
  return plane;
}

}  // namespace

template <int Dim>
std::vector<fpm::GhostPlane<Dim>> ghost_planes(const scene::Scene& scene) {
  std::vector<fpm::GhostPlane<Dim>> planes;
  if (const auto drive = scene::drive_by_images(scene)) {
    planes.push_back(driven<Dim>(scene, *drive->drive));
  }
  const auto first_support = static_cast<std::ptrdiff_t>(planes.size());
  for (const scene::Support& support : scene.support) {
    if (scene::resolve_method(scene, support) != scene::SupportMethod::ghosts) continue;
    const auto plane = plane_at<Dim>(scene, *support.side);
    auto known = std::find_if(planes.begin() + first_support, planes.end(), [&](const auto& other) {
      return other.axis == plane.axis && other.position == plane.position;
    });
    if (known == planes.end()) known = planes.insert(planes.end(), plane);
    for (const scene::Axis axis : support.directions) {
      known->held[static_cast<std::size_t>(axis)] = true;
    }
  }
  for (const scene::Symmetry& symmetry : scene.symmetry) {
    planes.push_back(fpm::symmetry_plane<Dim>(static_cast<int>(symmetry.axis), symmetry.position));
  }
  return planes;
}

template <int Dim>
std::vector<Eigen::Index> sources_of_planes(const Model<Dim>& model, int axis, double position) {
  const auto& planes = model.ghosts.planes();
  std::set<Eigen::Index> sources;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].symmetry || planes[p].axis != axis || planes[p].position != position) continue;
    const auto of_plane = model.ghosts.sources_of(p);
    sources.insert(of_plane.begin(), of_plane.end());
  }
  return {sources.begin(), sources.end()};
}

template <int Dim>
std::vector<scene::Side> sides_of_planes(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<scene::Side> sides;
  const auto drive = scene::drive_by_images(scene);
  const auto& planes = model.ghosts.planes();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (drive && p == driven_plane) {
      sides.push_back(drive->drive->side);
      continue;
    }
    const auto lower = static_cast<scene::Side>(2 * planes[p].axis);
    const auto upper = static_cast<scene::Side>(2 * planes[p].axis + 1);
    const bool is_lower = planes[p].position == scene::side_position(scene.geometry, lower);
    sides.push_back(is_lower ? lower : upper);
  }
  return sides;
}

template <int Dim>
std::vector<char> mirrors(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<char> result;
  // A side that a later stage holds has moved before.
  const bool is_first = scene.course.stage == 0;
  const scene::Point& gravity = scene.gravity.acceleration;
  for (const fpm::GhostPlane<Dim>& plane : model.ghosts.planes()) {
    const bool is_driven = !model.plane_drive.empty() && result.size() == driven_plane;
    // Weight across it would have to turn its way.
    const bool is_pressed =
        !gravity.empty() && gravity[static_cast<std::size_t>(plane.axis)] != 0.0;
    bool slides = is_first && !plane.has_range() && !is_driven && !is_pressed;
    for (int i = 0; i < Dim; ++i) {
      slides = slides && plane.held[static_cast<std::size_t>(i)] == (i == plane.axis);
    }
    result.push_back(plane.symmetry || slides ? 1 : 0);
  }
  return result;
}

template std::vector<char> mirrors<2>(const scene::Scene&, const Model<2>&);
template std::vector<char> mirrors<3>(const scene::Scene&, const Model<3>&);
template std::vector<scene::Side> sides_of_planes<2>(const scene::Scene&, const Model<2>&);
template std::vector<scene::Side> sides_of_planes<3>(const scene::Scene&, const Model<3>&);
template std::vector<Eigen::Index> sources_of_planes<2>(const Model<2>&, int, double);
template std::vector<Eigen::Index> sources_of_planes<3>(const Model<3>&, int, double);
template std::vector<fpm::GhostPlane<2>> ghost_planes<2>(const scene::Scene&);
template std::vector<fpm::GhostPlane<3>> ghost_planes<3>(const scene::Scene&);

}  // namespace model

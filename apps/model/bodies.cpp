#include "model/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "fpm/rows.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Pair = std::pair<fpm::Index, fpm::Index>;  // of materials, the smaller first

template <int Dim>
std::vector<fpm::Index> bodies_with(const scene::Scene& scene, const Model<Dim>& model,
                                    const std::set<Pair>& joined) {
  const std::vector<fpm::Index> label(model.material.begin(), model.material.end());
  // Fewer particles across a body leave its rows singular, with second gradients or at a corner.
  constexpr fpm::Index thickness = 3;
  auto body = fpm::bodies_of<Dim>(
      model.cells, label,
      [&](fpm::Index low, fpm::Index high) {
        return joined.contains({low, high}) ||
               scene::interface_between(scene, static_cast<std::size_t>(low),
                                        static_cast<std::size_t>(high))
                       .kind == scene::InterfaceKind::through;
      },
      thickness, model.meeting);
  if (std::ranges::max(body) == 0) body.clear();
  return body;
}

// Whether the particles beside places say what happens there.
template <int Dim>
bool are_seen(const Model<Dim>& model, const std::vector<fpm::Vector<Dim>>& places,
              const std::vector<fpm::Index>& particles) {
  fpm::Field<Dim> positions(static_cast<Eigen::Index>(places.size()), Dim);
  for (std::size_t k = 0; k < places.size(); ++k) {
    positions.row(static_cast<Eigen::Index>(k)) = places[k].transpose();
  }
  try {
    static_cast<void>(fpm::PointOperator<Dim>(model.particles, model.ghosts, positions,
                                              model.row_options, particles));
  } catch (const fpm::PoorNeighbourhood&) {
    return false;
  }
  return true;
}

// Places and the particles beside them.
template <int Dim>
struct Beside {
  std::vector<fpm::Vector<Dim>> places;
  std::vector<fpm::Index> particles;
  void add(const fpm::Vector<Dim>& place, fpm::Index particle) {
    places.push_back(place);
    particles.push_back(particle);
  }
};

// Materials to whose particles there are places on the surface that they do not see.
template <int Dim>
std::set<fpm::Index> blind_at_surface(const Model<Dim>& model) {
  std::set<fpm::Index> blind;
  if constexpr (Dim == 2) {
    std::map<fpm::Index, Beside<2>> of_material;
    for (const SurfacePiece<2>& piece : model.surface) {
      // The outermost of its points.
      const double length = (piece.to - piece.from).norm();
      const double first = 0.5 / std::ceil(2.0 * length / model.spacing_at(piece.particle));
      Beside<2>& beside = of_material[model.material[static_cast<std::size_t>(piece.particle)]];
      for (const double at : {first, 1.0 - first}) {
        beside.add(piece.from + at * (piece.to - piece.from), piece.particle);
      }
    }
    for (const auto& [material, beside] : of_material) {
      if (!are_seen(model, beside.places, beside.particles)) blind.insert(material);
    }
  }
  return blind;
}

// Adds tied materials one of which runs out into a tip too thin for rows of its own.
// @return whether there are any
template <int Dim>
bool find_thin_tips(const scene::Scene& scene, const Model<Dim>& model, std::set<Pair>& joined) {
  if (model.particles.body.empty() || model.joints.empty()) return false;
  if (model.row_options.support_radius <= 0.0) return false;  // of a section, no rows
  const auto faces = joint_faces(model);
  std::map<Pair, Beside<Dim>> of_pair;
  for (std::size_t c = 0; c < faces.first.size(); ++c) {
    const fpm::Index one = model.material[static_cast<std::size_t>(faces.first[c])];
    const fpm::Index other = model.material[static_cast<std::size_t>(faces.second[c])];
    const fpm::Vector<Dim> place =
        faces.points.position.row(static_cast<Eigen::Index>(c)).transpose();
    Beside<Dim>& beside = of_pair[{std::min(one, other), std::max(one, other)}];
    beside.add(place, faces.first[c]);
    beside.add(place, faces.second[c]);
  }
  const std::set<fpm::Index> blind = blind_at_surface(model);
  bool is_any = false;
  for (const auto& [pair, beside] : of_pair) {
    const scene::Interface rule = scene::interface_between(
        scene, static_cast<std::size_t>(pair.first), static_cast<std::size_t>(pair.second));
    if (rule.kind != scene::InterfaceKind::tied) continue;
    const bool is_good = !blind.contains(pair.first) && !blind.contains(pair.second) &&
                         are_seen(model, beside.places, beside.particles);
    if (!is_good) is_any = joined.insert(pair).second || is_any;
  }
  return is_any;
}

}  // namespace

template <int Dim>
void part_into_bodies(const scene::Scene& scene, Model<Dim>& model) {
  if (model.cells.size() == 0) return;  // elements and prisms know (elements.hpp, extrude.hpp)
  std::set<Pair> joined;
  do {
    model.particles.body = bodies_with(scene, model, joined);
  } while (find_thin_tips(scene, model, joined));
}

template <int Dim>
std::vector<fpm::Index> particles_at(const Model<Dim>& model,
                                     const fpm::BoundaryPoints<Dim>& points) {
  std::vector<fpm::Index> particles;
  if (model.particles.body.empty() && !model.cells.graded()) return particles;
  for (Eigen::Index c = 0; c < points.weight.size(); ++c) {
    particles.push_back(model.cells.containing(points.position.row(c).transpose()));
  }
  return particles;
}

template void part_into_bodies<2>(const scene::Scene&, Model<2>&);
template void part_into_bodies<3>(const scene::Scene&, Model<3>&);
template std::vector<fpm::Index> particles_at<2>(const Model<2>&, const fpm::BoundaryPoints<2>&);
template std::vector<fpm::Index> particles_at<3>(const Model<3>&, const fpm::BoundaryPoints<3>&);

}  // namespace model

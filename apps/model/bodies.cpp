#include "model/bodies.hpp"

#include <algorithm>
#include <set>

#include "model/thin_layers.hpp"
#include "model/thin_tips.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Fewer particles across a body leave its rows singular, with second gradients or at a corner.
constexpr fpm::Index fewest_across = 3;

template <int Dim>
std::vector<fpm::Index> bodies_with(const scene::Scene& scene, const Model<Dim>& model,
                                    const std::set<MaterialPair>& joined, fpm::Index thickness) {
  const std::vector<fpm::Index> label(model.material.begin(), model.material.end());
  return fpm::bodies_of<Dim>(
      model.cells, label,
      [&](fpm::Index low, fpm::Index high) {
        return joined.contains({low, high}) ||
               scene::interface_between(scene, static_cast<std::size_t>(low),
                                        static_cast<std::size_t>(high))
                       .kind == scene::InterfaceKind::through;
      },
      thickness, model.meeting);
}

}  // namespace

template <int Dim>
void part_into_bodies(const scene::Scene& scene, Model<Dim>& model) {
  if (model.cells.size() == 0) return;  // elements and even prisms know (elements.hpp, extrude.hpp)
  const auto parted = [&](const std::set<MaterialPair>& joined) {
    std::vector<fpm::Index> body = bodies_with(scene, model, joined, fewest_across);
    if (std::ranges::max(body) == 0) body.clear();
    return body;
  };
  model.particles.body = parted({});
  note_thin_layers(scene, bodies_with(scene, model, {}, 1), fewest_across, model);
  if constexpr (Dim == 2) join_thin_tips(scene, parted, model);
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

#include "model/selection.hpp"

#include <cmath>

#include "scene/derived.hpp"
#include "scene/places.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

template <int Dim>
bool inside(const Eigen::Matrix<double, 1, Dim>& x, const scene::Point& min,
            const scene::Point& max, double slack) {
  for (int i = 0; i < Dim; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (x[i] < min[k] - slack || x[i] > max[k] + slack) return false;
  }
  return true;
}

}  // namespace

template <int Dim>
bool on_side(const scene::Scene& scene, const Model<Dim>& model, scene::Side side, Eigen::Index a) {
  const double reach = scene.geometry.layout == scene::Layout::cell ? 1.0 : 0.25;
  const int axis = scene::axis_of(side);
  return std::abs(model.particles.position(a, axis) - scene::side_position(scene.geometry, side)) <
         reach * model.spacing_at(a);
}

template <int Dim>
bool in_side_range(const scene::Scene& scene, const Model<Dim>& model, scene::Side side,
                   const scene::Point& min, const scene::Point& max, Eigen::Index a) {
  if (min.empty()) return true;
  const double slack = scene::same_place(scene.geometry);
  std::size_t k = 0;
  for (int i = 0; i < Dim; ++i) {
    if (i == scene::axis_of(side)) continue;
    const double x = model.particles.position(a, i);
    if (x < min[k] - slack || x > max[k] + slack) return false;
    ++k;
  }
  return true;
}

template <int Dim>
Eigen::Index nearest_particle(const scene::Scene& scene, const scene::Point& at,
                              const Model<Dim>& model) {
  const Eigen::Map<const Eigen::Matrix<double, 1, Dim>> place(at.data());
  const Eigen::VectorXd distance = (model.particles.position.rowwise() - place).rowwise().norm();
  const double least = distance.minCoeff() + scene::same_place(scene.geometry);
  Eigen::Index nearest = 0;
  while (distance[nearest] > least) ++nearest;
  return nearest;
}

template <int Dim>
std::vector<Eigen::Index> driven_particles(const scene::Scene& scene, const scene::Drive& drive,
                                           const Model<Dim>& model) {
  std::vector<Eigen::Index> chosen;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    if (on_side(scene, model, drive.side, a) &&
        in_side_range(scene, model, drive.side, drive.range_min, drive.range_max, a)) {
      chosen.push_back(a);
    }
  }
  return chosen;
}

template <int Dim>
std::vector<Eigen::Index> supported_particles(const scene::Scene& scene,
                                              const scene::Support& support,
                                              const Model<Dim>& model) {
  std::vector<Eigen::Index> chosen;
  if (!support.at.empty()) return {nearest_particle(scene, support.at, model)};
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const bool hit = support.side
                         ? on_side(scene, model, *support.side, a)
                         : inside<Dim>(model.particles.position.row(a), support.region_min,
                                       support.region_max, scene::same_place(scene.geometry));
    if (hit) chosen.push_back(a);
  }
  return chosen;
}

template std::vector<Eigen::Index> driven_particles<2>(const scene::Scene&, const scene::Drive&,
                                                       const Model<2>&);
template std::vector<Eigen::Index> driven_particles<3>(const scene::Scene&, const scene::Drive&,
                                                       const Model<3>&);
template bool on_side<2>(const scene::Scene&, const Model<2>&, scene::Side, Eigen::Index);
template bool in_side_range<2>(const scene::Scene&, const Model<2>&, scene::Side,
                               const std::vector<double>&, const std::vector<double>&,
                               Eigen::Index);
template std::vector<Eigen::Index> supported_particles<2>(const scene::Scene&,
                                                          const scene::Support&, const Model<2>&);

template Eigen::Index nearest_particle<2>(const scene::Scene&, const scene::Point&,
                                          const Model<2>&);
template Eigen::Index nearest_particle<3>(const scene::Scene&, const scene::Point&,
                                          const Model<3>&);
template bool on_side<3>(const scene::Scene&, const Model<3>&, scene::Side, Eigen::Index);
template bool in_side_range<3>(const scene::Scene&, const Model<3>&, scene::Side,
                               const std::vector<double>&, const std::vector<double>&,
                               Eigen::Index);
template std::vector<Eigen::Index> supported_particles<3>(const scene::Scene&,
                                                          const scene::Support&, const Model<3>&);

}  // namespace model

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
         reach * model.spacing;
}

template <int Dim>
bool in_side_range(const Model<Dim>& model, scene::Side side, const scene::Point& min,
                   const scene::Point& max, Eigen::Index a) {
  if (min.empty()) return true;
  const double slack = scene::same_place * model.spacing;
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
std::vector<Eigen::Index> supported_particles(const scene::Scene& scene,
                                              const scene::Support& support,
                                              const Model<Dim>& model) {
  std::vector<Eigen::Index> chosen;
  if (!support.at.empty()) {
    Eigen::Index nearest = 0;
    (model.particles.position.rowwise() -
     Eigen::Map<const fpm::Vector<Dim>>(support.at.data()).transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    return {nearest};
  }
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const bool hit = support.side
                         ? on_side(scene, model, *support.side, a)
                         : inside<Dim>(model.particles.position.row(a), support.region_min,
                                       support.region_max, scene::same_place * model.spacing);
    if (hit) chosen.push_back(a);
  }
  return chosen;
}

template bool on_side<2>(const scene::Scene&, const Model<2>&, scene::Side, Eigen::Index);
template bool in_side_range<2>(const Model<2>&, scene::Side, const std::vector<double>&,
                               const std::vector<double>&, Eigen::Index);
template std::vector<Eigen::Index> supported_particles<2>(const scene::Scene&,
                                                          const scene::Support&, const Model<2>&);

template bool on_side<3>(const scene::Scene&, const Model<3>&, scene::Side, Eigen::Index);
template bool in_side_range<3>(const Model<3>&, scene::Side, const std::vector<double>&,
                               const std::vector<double>&, Eigen::Index);
template std::vector<Eigen::Index> supported_particles<3>(const scene::Scene&,
                                                          const scene::Support&, const Model<3>&);

}  // namespace model

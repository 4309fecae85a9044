#include "model/grid_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "fpm/neighbour_search.hpp"

namespace model {

template <int Dim>
fpm::Cells<Dim> cells_behind(const Model<Dim>& model) {
  fpm::LatticeOptions<Dim> finest;
  finest.spacing = model.spacing;
  finest.min = model.box_min;
  double coarsest = model.spacing;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    coarsest = std::max(coarsest, model.spacing_at(a));
  }
  const double ratio = coarsest / model.spacing;
  const double widest = model.spacing * std::exp2(std::ceil(std::log2(ratio)) + 1.0);
  for (int i = 0; i < Dim; ++i) {
    const double extent = model.box_max[i] - model.box_min[i];
    finest.max[i] = model.box_min[i] + std::ceil(extent / widest) * widest;
  }
  const fpm::NeighbourSearch<Dim> search(model.particles.position);
  std::vector<fpm::Index> near;
  return {finest, [&](const fpm::Vector<Dim>& lower, const fpm::Vector<Dim>& upper) {
            search.within(0.5 * (lower + upper), 0.5 * (upper - lower).norm(), near);
            double wanted = std::numeric_limits<double>::infinity();
            for (const fpm::Index a : near) wanted = std::min(wanted, model.spacing_at(a));
            return 2.0 * wanted;
          }};
}

template fpm::Cells<2> cells_behind<2>(const Model<2>&);
template fpm::Cells<3> cells_behind<3>(const Model<3>&);

}  // namespace model

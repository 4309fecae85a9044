#include "equilibrium/box_mesh.hpp"

namespace equilibrium {

template <int Dim>
BoxMesh<Dim>::BoxMesh(const model::Model<Dim>& model, double spacing) {
  origin_ = model.box_min;
  const fpm::Vector<Dim> extent = model.box_max - origin_;
  nodes_ = 1;
  for (int i = 0; i < Dim; ++i) {
    cells_[i] = std::max(1, static_cast<fpm::Index>(std::lround(extent[i] / spacing)));
    cell_[i] = extent[i] / cells_[i];
    nodes_ *= cells_[i] + 1;
  }
}

template <int Dim>
GridPoint<Dim> BoxMesh<Dim>::at(const Eigen::Matrix<double, 1, Dim>& place) const {
  GridPoint<Dim> point;
  Eigen::Matrix<fpm::Index, Dim, 1> at;
  fpm::Vector<Dim> xi;
  for (int i = 0; i < Dim; ++i) {
    const double x = (place[i] - origin_[i]) / cell_[i];
    at[i] = std::clamp(static_cast<fpm::Index>(std::floor(x)), 0, cells_[i] - 1);
    xi[i] = x - at[i];
  }
  for (int corner = 0; corner < GridPoint<Dim>::corners; ++corner) {
    fpm::Index node = 0;
    for (int i = Dim - 1; i >= 0; --i) node = node * (cells_[i] + 1) + at[i] + ((corner >> i) & 1);
    point.nodes[corner] = node;
  }
  point.interpolate(xi, cell_);
  return point;
}

template <int Dim>
fpm::Vector<Dim> BoxMesh<Dim>::place(fpm::Index node) const {
  fpm::Vector<Dim> place;
  for (int i = 0; i < Dim; ++i) {
    place[i] = origin_[i] + cell_[i] * (node % (cells_[i] + 1));
    node /= cells_[i] + 1;
  }
  return place;
}

template <int Dim>
bool BoxMesh<Dim>::is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const {
  const fpm::Vector<Dim> at = place(node);
  for (int i = 0; i < Dim; ++i) {
    const bool on = i == plane.axis ? std::abs(at[i] - plane.position) < 0.5 * cell_[i]
                                    : at[i] >= plane.range_min[i] && at[i] <= plane.range_max[i];
    if (!on) return false;
  }
  return true;
}

template <int Dim>
void BoxMesh<Dim>::Stiffness::add(const GridPoint<Dim>& point, int p, int q,
                                  const fpm::Tensor<Dim>& block) {
  int slot = 0;
  for (int i = Dim - 1; i >= 0; --i) slot = 3 * slot + 1 + ((q >> i) & 1) - ((p >> i) & 1);
  blocks_.col(point.nodes[p]).template segment<block_size>(slot * block_size) +=
      block.template reshaped<Eigen::ColMajor>(block_size, 1);
}

template <int Dim>
std::vector<Eigen::Triplet<double>> BoxMesh<Dim>::Stiffness::entries() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(blocks_.size()));
  for (fpm::Index node = 0; node < mesh_.nodes_; ++node) {
    for (int slot = 0; slot < slots; ++slot) {
      const Eigen::Map<const fpm::Tensor<Dim>> block(blocks_.col(node).data() + slot * block_size);
      if ((block.array() == 0.0).all()) continue;  // also what lies beyond the grid
      fpm::Index other = node, stride = 1;
      for (int i = 0, rest = slot; i < Dim; ++i, rest /= 3) {
        other += (rest % 3 - 1) * stride;
        stride *= mesh_.cells_[i] + 1;
      }
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) {
          entries.emplace_back(node * Dim + i, other * Dim + j, block(i, j));
        }
      }
    }
  }
  return entries;
}

template class BoxMesh<2>;
template class BoxMesh<3>;

}  // namespace equilibrium

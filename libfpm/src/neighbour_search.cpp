#include "fpm/neighbour_search.hpp"

#include <algorithm>
#include <flann/flann.hpp>

namespace fpm {

template <int Dim>
struct NeighbourSearch<Dim>::Tree {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;

  explicit Tree(const Field<Dim>& points)
      : origin(points.colwise().mean().transpose()),
        centred(points.rowwise() - origin.transpose()),
        single(centred.template cast<float>()),
        extent(points.rows() == 0 ? 0.0 : centred.cwiseAbs().maxCoeff()),
        index(flann::Matrix<float>(single.data(), static_cast<std::size_t>(single.rows()), Dim),
              flann::KDTreeSingleIndexParams()) {
    index.buildIndex();
  }

  Vector<Dim> origin;
  RowMajor centred;
  Eigen::Matrix<float, Eigen::Dynamic, Dim, Eigen::RowMajor> single;
  double extent;
  flann::KDTreeSingleIndex<flann::L2_Simple<float>> index;
};

template <int Dim>
NeighbourSearch<Dim>::NeighbourSearch(const Field<Dim>& points)
    : tree_(std::make_unique<Tree>(points)) {}
template <int Dim>
NeighbourSearch<Dim>::~NeighbourSearch() = default;
template <int Dim>
NeighbourSearch<Dim>::NeighbourSearch(NeighbourSearch&&) noexcept = default;
template <int Dim>
NeighbourSearch<Dim>& NeighbourSearch<Dim>::operator=(NeighbourSearch&&) noexcept = default;

template <int Dim>
void NeighbourSearch<Dim>::within(const Vector<Dim>& centre, double radius,
                                  std::vector<Index>& found) const {
  const Vector<Dim> query = centre - tree_->origin;
  Eigen::Matrix<float, 1, Dim> single = query.transpose().template cast<float>();
  // Rounding a coordinate to float moves it by at most 2^-24 of the extent.
  const double slack = 4.0 * 0x1.0p-23 * (tree_->extent + query.cwiseAbs().maxCoeff());
  const auto wide = static_cast<float>((radius + slack) * (radius + slack) * (1.0 + 1e-6));

  std::vector<std::vector<int>> indices;
  std::vector<std::vector<float>> distances;
  flann::SearchParams parameters(flann::FLANN_CHECKS_UNLIMITED);
  parameters.sorted = false;
  tree_->index.radiusSearch(flann::Matrix<float>(single.data(), 1, Dim), indices, distances, wide,
                            parameters);
  found.clear();
  for (const int b : indices.front()) {
    if ((tree_->centred.row(b).transpose() - query).squaredNorm() < radius * radius) {
      found.push_back(b);
    }
  }
  std::sort(found.begin(), found.end());
}

template class NeighbourSearch<2>;
template class NeighbourSearch<3>;

}  // namespace fpm

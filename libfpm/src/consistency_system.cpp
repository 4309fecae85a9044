#include "consistency_system.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace fpm::detail {

template <int Dim>
void ConsistencySystem<Dim>::add(std::span<const Index> unknown, std::span<const double> sign,
                                 const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights,
                                 double factor) {
  Row row;
  row.begin = members_.size();
  row.factor = factor;
  Tensor<Dim> spread = Tensor<Dim>::Zero();
  Member own{unknown[0], 0.0, 0.0, Vector<Dim>::Zero()};
  members_.push_back(own);
  for (Eigen::Index k = 0; k < geometry.size(); ++k) {
    const auto i = static_cast<std::size_t>(k) + 1;
    const auto x = geometry.offset.col(k);
    const Vector<Dim> y = weights.kappa[k] * x;
    spread += y * x.transpose();
    own.kappa += weights.kappa[k];
    own.y -= y;
    members_.push_back({unknown[i], weights.kappa[k], sign[i] * weights.kappa[k], sign[i] * y});
  }
  members_[row.begin] = own;
  row.end = members_.size();
  row.spread_inverse = spread.inverse();
  rows_.push_back(row);
}

// By unknown, rows in their order.
template <int Dim>
auto ConsistencySystem<Dim>::places() const -> std::vector<std::vector<Place>> {
  std::vector<std::vector<Place>> found(static_cast<std::size_t>(unknowns_));
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t m = rows_[r].begin; m < rows_[r].end; ++m) {
      found[static_cast<std::size_t>(members_[m].unknown)].push_back({r, m});
    }
  }
  return found;
}

// The entries of a column on and below the diagonal.
template <int Dim>
class ConsistencySystem<Dim>::Column {
 public:
  explicit Column(const ConsistencySystem& system)
      : system_(system),
        sum_(static_cast<std::size_t>(system.unknowns_), 0.0),
        met_(static_cast<std::size_t>(system.unknowns_), 0) {}

  void add(const Place& place, Index column) {
    const Row& row = system_.rows_[place.row];
    const Member& at = system_.members_[place.member];
    const bool own = place.member == row.begin;
    const Vector<Dim> z = row.spread_inverse * at.y;
    for (std::size_t m = row.begin; m < row.end; ++m) {
      const Member& other = system_.members_[m];
      if (other.unknown < column) continue;
      double entry = -other.y.dot(z);
      if (m == place.member) {
        entry += at.kappa;
      } else if (own) {
        entry -= other.link;
      } else if (m == row.begin) {
        entry -= at.link;
      }
      meet(other.unknown);
      sum_[static_cast<std::size_t>(other.unknown)] += row.factor * entry;
    }
  }

  void move_to(Eigen::SparseMatrix<double>& matrix, Index column) {
    meet(column);
    std::ranges::sort(ids_);
    matrix.startVec(column);
    for (const Index id : ids_) {
      const auto i = static_cast<std::size_t>(id);
      matrix.insertBack(id, column) = sum_[i];
      sum_[i] = 0.0;
      met_[i] = 0;
    }
    ids_.clear();
  }

 private:
  void meet(Index id) {
    char& met = met_[static_cast<std::size_t>(id)];
    if (met == 0) ids_.push_back(id);
    met = 1;
  }

  const ConsistencySystem& system_;
  std::vector<double> sum_;
  std::vector<char> met_;
  std::vector<Index> ids_;
};

template <int Dim>
Eigen::SparseMatrix<double> ConsistencySystem<Dim>::lower() const {
  Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
  const auto by_unknown = places();
  Column column(*this);
  for (Index j = 0; j < unknowns_; ++j) {
    for (const Place& place : by_unknown[static_cast<std::size_t>(j)]) column.add(place, j);
    column.move_to(matrix, j);
  }
  matrix.finalize();
  return matrix;
}

template class ConsistencySystem<2>;
template class ConsistencySystem<3>;

}  // namespace fpm::detail

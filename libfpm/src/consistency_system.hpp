#pragma once

#include <Eigen/LU>
#include <Eigen/SparseCore>
#include <limits>
#include <span>
#include <vector>

#include "fpm/stencil.hpp"

namespace fpm::detail {

/// Round-off of an area V_a G_ab, relative: its weights come from moment matrices with condition
/// numbers up to some hundreds.
inline constexpr double area_round_off = 1e3 * std::numeric_limits<double>::epsilon();

/// The part of differences d_b (Dim x neighbours) that no linear field explains, times kappa:
/// kappa_ab (T_a d)_b.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> weighted_remainder(
    const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights,
    const Eigen::Matrix<double, Dim, Eigen::Dynamic>& difference) {
  const Eigen::Matrix<double, Dim, Eigen::Dynamic> weighted =
      geometry.offset * weights.kappa.asDiagonal();
  const Tensor<Dim> spread = weighted * geometry.offset.transpose();
  const Tensor<Dim> slope = difference * weighted.transpose() * spread.inverse();
  return (difference - slope * geometry.offset) * weights.kappa.asDiagonal();
}

/// The matrix S = sum over rows of factor * T^T diag(kappa) T.
///
/// A row's part is a graph Laplacian of its kappa less Y^T spread^-1 Y, spread = sum kappa X X^T
/// and Y = kappa X of its neighbours, itself with minus their sum. Only these factors are stored:
/// in space the entries of all parts are some twenty times the entries of S.
template <int Dim>
class ConsistencySystem {
 public:
  explicit ConsistencySystem(Index unknowns) : unknowns_(unknowns) {}

  /// @param unknown  of the row itself and its neighbours; one may be met more than once
  /// @param sign  +1, or -1 where a neighbour is an image that has minus its unknown
  void add(std::span<const Index> unknown, std::span<const double> sign,
           const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights, double factor);

  /// Lower triangle of S; its diagonal is stored whatever rows there are.
  Eigen::SparseMatrix<double> lower() const;

 private:
  struct Member {
    Index unknown = 0;
    double kappa = 0.0;  // [1/m^2] of a neighbour; of the row itself the sum
    double link = 0.0;   // [1/m^2] kappa with the sign of an image
    Vector<Dim> y;       // [1/m]
  };
  struct Row {
    std::size_t begin = 0;  // of its members, itself first
    std::size_t end = 0;
    Tensor<Dim> spread_inverse;
    double factor = 0.0;
  };
  struct Place {  // of an unknown in a row
    std::size_t row = 0;
    std::size_t member = 0;
  };
  class Column;

  std::vector<std::vector<Place>> places() const;

  Index unknowns_;
  std::vector<Member> members_;
  std::vector<Row> rows_;
};

extern template class ConsistencySystem<2>;
extern template class ConsistencySystem<3>;

}  // namespace fpm::detail

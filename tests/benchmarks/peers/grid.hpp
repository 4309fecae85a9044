#pragma once

#include "problem.hpp"

namespace peers {

/// m x m interior nodes of the unit square; values outside are `edge`.
struct Grid {
  int m;
  [[nodiscard]] double h() const { return 1.0 / (m + 1.0); }
  [[nodiscard]] Eigen::Index at(int i, int j) const { return static_cast<Eigen::Index>(j) * m + i; }
  [[nodiscard]] bool inside(int i, int j) const { return i >= 0 && j >= 0 && i < m && j < m; }
  [[nodiscard]] double value(const Vector& u, int i, int j, double edge = 0.0) const {
    return inside(i, j) ? u[at(i, j)] : edge;
  }
  /// 4 u - its neighbours: -h^2 Laplace(u).
  [[nodiscard]] double minus_laplacian(const Vector& u, int i, int j, double edge = 0.0) const {
    return 4.0 * value(u, i, j) - value(u, i - 1, j, edge) - value(u, i + 1, j, edge) -
           value(u, i, j - 1, edge) - value(u, i, j + 1, edge);
  }
};

/// Calls f(i, j, row) at every node.
template <class F>
void for_each_node(const Grid& grid, const F& f) {
  for (int j = 0; j < grid.m; ++j) {
    for (int i = 0; i < grid.m; ++i) f(i, j, grid.at(i, j));
  }
}

}  // namespace peers

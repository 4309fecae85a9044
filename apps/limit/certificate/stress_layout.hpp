#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <utility>
#include <vector>

#include "limit/problem/problem.hpp"

namespace limit::certificate {

/// Where the (xx, yy, xy) of a triangle's corner stand.
inline Eigen::Index corner_index(const mesh::Mesh& mesh, int triangle, int node) {
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(triangle)].nodes;
  return 9 * triangle + 3 * (std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// Where the (xx, yy, xy) of Bezier points stand among all: the corners of all triangles, and then
/// the middles of those whose weight is linear and whose stress is quadratic.
class StressLayout {
 public:
  explicit StressLayout(const problem::Problem& problem) : mesh_(problem.mesh) {
    size_ = static_cast<Eigen::Index>(9 * mesh_.triangles.size());
    for (const mesh::Triangle& triangle : mesh_.triangles) {
      const bool is_quadratic =
          problem.soils[static_cast<std::size_t>(triangle.region)].has_uneven_weight();
      middles_.push_back(is_quadratic ? size_ : -1);
      if (is_quadratic) size_ += 9;
    }
  }
  [[nodiscard]] Eigen::Index size() const { return size_; }
  /// Of the middle of the side that follows the first corner; -1: the stress is linear.
  [[nodiscard]] Eigen::Index middles(std::size_t triangle) const { return middles_[triangle]; }
  [[nodiscard]] bool is_quadratic(int triangle) const {
    return triangle >= 0 && middles_[static_cast<std::size_t>(triangle)] >= 0;
  }
  /// Of the middle of a side, in shares.
  [[nodiscard]] std::vector<std::pair<Eigen::Index, double>> middle(int triangle, int first,
                                                                    int second) const {
    const Eigen::Index a = corner_index(mesh_, triangle, first),
                       b = corner_index(mesh_, triangle, second);
    if (!is_quadratic(triangle)) return {{a, 0.5}, {b, 0.5}};
    const Eigen::Index i = (a - 9 * triangle) / 3, j = (b - 9 * triangle) / 3;
    const Eigen::Index side = (i + 1) % 3 == j ? i : j;
    return {{middles_[static_cast<std::size_t>(triangle)] + 3 * side, 1.0}};
  }

 private:
  const mesh::Mesh& mesh_;
  std::vector<Eigen::Index> middles_;
  Eigen::Index size_ = 0;
};

}  // namespace limit::certificate

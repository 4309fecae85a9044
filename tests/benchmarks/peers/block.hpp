#pragma once

#include <Eigen/Core>

namespace peers {

/// A block of 2 x 1, its nodes a square mesh of which each cell is two linear triangles.
struct Block {
  int rows;
  [[nodiscard]] int columns() const { return 2 * rows; }
  [[nodiscard]] double h() const { return 1.0 / rows; }
};

/// Forces on nodes that bear `stress`: at(i, j) is the displacement of a node, stress(H, P) fills
/// the first Piola-Kirchhoff stress of a gradient of displacement or returns false,
/// add(i, j, force) takes what a triangle adds.
template <class At, class Stress, class Add>
bool add_forces(const Block& block, const At& at, const Stress& stress, const Add& add) {
  for (int j = 0; j < block.rows; ++j) {
    for (int i = 0; i < block.columns(); ++i) {
      for (const int side : {1, -1}) {
        // The corner with the right angle and its neighbours along x and y.
        const int a = side > 0 ? i : i + 1;
        const int b = side > 0 ? j : j + 1;
        const double leg = side * block.h();
        Eigen::Matrix2d H;
        H.col(0) = (at(a + side, b) - at(a, b)) / leg;
        H.col(1) = (at(a, b + side) - at(a, b)) / leg;
        Eigen::Matrix2d P;
        if (!stress(H, P)) return false;
        P *= 0.5 * block.h() * block.h() / leg;
        add(a + side, b, P.col(0));
        add(a, b + side, P.col(1));
        add(a, b, -P.col(0) - P.col(1));
      }
    }
  }
  return true;
}

// Of Young's modulus 1 and Poisson's ratio 0.3.
inline constexpr double lame = 0.3 / (1.3 * 0.4);
inline constexpr double shear_modulus = 1.0 / 2.6;

}  // namespace peers

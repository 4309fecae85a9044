#pragma once

#include "fpm/types.hpp"

namespace equilibrium {

/// A point in a bilinear (trilinear) element of the background grid.
template <int Dim>
struct GridPoint {
  static constexpr int corners = 1 << Dim;

  fpm::Index element = 0;
  Eigen::Matrix<fpm::Index, corners, 1> nodes;    // of the element
  Eigen::Matrix<double, corners, 1> values;       // of their shape functions
  Eigen::Matrix<double, Dim, corners> gradients;  // [1/m]

  /// Sets values and gradients.
  /// @param xi  place in the element, 0 ... 1 along each axis
  /// @param width  [m] of the element
  void interpolate(const fpm::Vector<Dim>& xi, const fpm::Vector<Dim>& width) {
    for (int corner = 0; corner < corners; ++corner) {
      double value = 1.0;
      fpm::Vector<Dim> gradient = fpm::Vector<Dim>::Ones();
      for (int i = Dim - 1; i >= 0; --i) {
        const bool upper = ((corner >> i) & 1) != 0;
        const double shape = upper ? xi[i] : 1.0 - xi[i];
        for (int j = 0; j < Dim; ++j) {
          gradient[j] *= i == j ? (upper ? 1.0 : -1.0) / width[i] : shape;
        }
        value *= shape;
      }
      values[corner] = value;
      gradients.col(corner) = gradient;
    }
  }
};

}  // namespace equilibrium

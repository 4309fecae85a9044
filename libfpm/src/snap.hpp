#pragma once

#include <cmath>
#include <limits>

#include "fpm/types.hpp"

namespace fpm {

/// Round-off of a difference of the coordinates of `positions` [m].
template <int Dim>
double difference_round_off(const Field<Dim>& positions) {
  const double extent = positions.size() == 0 ? 0.0 : positions.cwiseAbs().maxCoeff();
  return 8.0 * std::numeric_limits<double>::epsilon() * extent;
}

/// A lattice difference is known only to the round-off of the coordinates; taken as the multiple of
/// `grid` it stands for, equal neighbourhoods get equal weights to the last bit, wherever they are.
template <int Dim>
Vector<Dim> snapped(Vector<Dim> offset, double grid, double round_off) {
  if (grid <= 0.0) return offset;
  for (int i = 0; i < Dim; ++i) {
    const double lattice = std::round(offset[i] / grid) * grid;
    if (std::abs(lattice - offset[i]) <= round_off) offset[i] = lattice;
  }
  return offset;
}

}  // namespace fpm

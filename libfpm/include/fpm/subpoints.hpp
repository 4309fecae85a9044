#pragma once

#include <array>
#include <cmath>

#include "fpm/types.hpp"

namespace fpm {

/// Four sub-points of a plane particle, (+-h/4, +-h/4) around it in its reference configuration
/// with h = sqrt(Vref), each standing for a quarter of the volume. The Taylor field
/// F_k = F + H xi_k lets them see the deformation modes that one point per particle misses.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mixed-subpoints.md).
inline constexpr std::size_t subpoint_count = 4;

/// Second gradient of the motion, d2x / dX dX, columns XX, XY, YY.
template <class Real>
using BasicSecondGradient = Eigen::Matrix<Real, 2, 3>;
using SecondGradient = BasicSecondGradient<double>;

/// Volume shares of the sub-points.
inline constexpr std::array<double, subpoint_count> subpoint_weights{0.25, 0.25, 0.25, 0.25};

/// Position of sub-point k relative to its particle [m].
template <class Real>
Vector<2, Real> subpoint_offset(std::size_t k, const Real& reference_volume) {
  using std::sqrt;
  const Real quarter = 0.25 * sqrt(reference_volume);
  return {(k & 1U) != 0 ? quarter : -quarter, (k & 2U) != 0 ? quarter : -quarter};
}

/// H xi: change of the deformation gradient from the particle to the sub-point.
template <class Real>
Tensor<2, Real> second_gradient_at(const BasicSecondGradient<Real>& h, const Vector<2, Real>& xi) {
  Tensor<2, Real> change;
  change.col(0) = h.col(0) * xi[0] + h.col(1) * xi[1];
  change.col(1) = h.col(1) * xi[0] + h.col(2) * xi[1];
  return change;
}

/// Adds the stress conjugate to H of a sub-point's nominal stress P_k (already times its volume):
/// the transpose of `second_gradient_at`.
template <class Real>
void add_second_stress(const Tensor<2, Real>& nominal, const Vector<2, Real>& xi,
                       BasicSecondGradient<Real>& t) {
  t.col(0) += nominal.col(0) * xi[0];
  t.col(1) += nominal.col(0) * xi[1] + nominal.col(1) * xi[0];
  t.col(2) += nominal.col(1) * xi[1];
}

}  // namespace fpm

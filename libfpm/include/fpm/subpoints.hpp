#pragma once

#include <array>
#include <cmath>

#include "fpm/types.hpp"

namespace fpm {

/// Four sub-points of a particle, around it in its reference configuration, each standing for a
/// quarter of the volume: with h^Dim = Vref at (+-h/4, +-h/4) in the plane, and in space at the
/// corners of a tetrahedron over these, (+-h/4, +-h/4, +-h/4) with an even number of minus signs.
/// The Taylor field F_k = F + H xi_k lets them see the deformation modes that one point per
/// particle misses; it is linear, so four points in general position see all of it, as eight would.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mixed-subpoints.md).
inline constexpr std::size_t subpoint_count = 4;

/// Second gradient of the motion, d2x / dX dX, columns XX, XY, YY or XX, XY, XZ, YY, YZ, ZZ.
template <int Dim, class Real = double>
using SecondGradient = Eigen::Matrix<Real, Dim, second_gradient_size<Dim>>;

/// Volume shares of the sub-points.
inline constexpr std::array<double, subpoint_count> subpoint_weights{0.25, 0.25, 0.25, 0.25};

/// Position of sub-point k relative to its particle [m].
template <int Dim, class Real>
Vector<Dim, Real> subpoint_offset(std::size_t k, const Real& reference_volume) {
  using std::cbrt;
  using std::sqrt;
  const bool right = (k & 1U) != 0, up = (k & 2U) != 0;
  if constexpr (Dim == 2) {
    const Real quarter = 0.25 * sqrt(reference_volume);
    return {right ? quarter : -quarter, up ? quarter : -quarter};
  } else {
    const Real quarter = 0.25 * cbrt(reference_volume);
    return {right ? quarter : -quarter, up ? quarter : -quarter, right == up ? quarter : -quarter};
  }
}

/// H xi: change of the deformation gradient from the particle to the sub-point.
template <int Dim, class Real>
Tensor<Dim, Real> second_gradient_at(const Eigen::Matrix<Real, Dim, second_gradient_size<Dim>>& h,
                                     const Eigen::Matrix<Real, Dim, 1>& xi) {
  Tensor<Dim, Real> change;
  if constexpr (Dim == 2) {
    change.col(0) = h.col(0) * xi[0] + h.col(1) * xi[1];
    change.col(1) = h.col(1) * xi[0] + h.col(2) * xi[1];
  } else {
    change.col(0) = h.col(0) * xi[0] + h.col(1) * xi[1] + h.col(2) * xi[2];
    change.col(1) = h.col(1) * xi[0] + h.col(3) * xi[1] + h.col(4) * xi[2];
    change.col(2) = h.col(2) * xi[0] + h.col(4) * xi[1] + h.col(5) * xi[2];
  }
  return change;
}

/// The same for a scalar: gradient at the sub-point of second-gradient weights h.
template <int Dim, class Real>
Vector<Dim, Real> second_weight_at(const Eigen::Matrix<Real, second_gradient_size<Dim>, 1>& h,
                                   const Eigen::Matrix<Real, Dim, 1>& xi) {
  if constexpr (Dim == 2) {
    return {h[0] * xi[0] + h[1] * xi[1], h[1] * xi[0] + h[2] * xi[1]};
  } else {
    return {h[0] * xi[0] + h[1] * xi[1] + h[2] * xi[2], h[1] * xi[0] + h[3] * xi[1] + h[4] * xi[2],
            h[2] * xi[0] + h[4] * xi[1] + h[5] * xi[2]};
  }
}

/// Adds the stress conjugate to H of a sub-point's nominal stress P_k (already times its volume):
/// the transpose of `second_gradient_at`.
template <int Dim, class Real>
void add_second_stress(const Eigen::Matrix<Real, Dim, Dim>& nominal,
                       const Eigen::Matrix<Real, Dim, 1>& xi,
                       Eigen::Matrix<Real, Dim, second_gradient_size<Dim>>& t) {
  if constexpr (Dim == 2) {
    t.col(0) += nominal.col(0) * xi[0];
    t.col(1) += nominal.col(0) * xi[1] + nominal.col(1) * xi[0];
    t.col(2) += nominal.col(1) * xi[1];
  } else {
    t.col(0) += nominal.col(0) * xi[0];
    t.col(1) += nominal.col(0) * xi[1] + nominal.col(1) * xi[0];
    t.col(2) += nominal.col(0) * xi[2] + nominal.col(2) * xi[0];
    t.col(3) += nominal.col(1) * xi[1];
    t.col(4) += nominal.col(1) * xi[2] + nominal.col(2) * xi[1];
    t.col(5) += nominal.col(2) * xi[2];
  }
}

}  // namespace fpm

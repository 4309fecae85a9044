#pragma once

#include <Eigen/Core>

#include "constitutive/tensor.hpp"

namespace constitutive {

/// Principal values in falling order and their orthonormal directions (columns).
struct Spectrum {
  Eigen::Vector3d values;
  Eigen::Matrix3d directions;
};

/// Spectral decomposition of a plane-strain stress; zz is one of the principal stresses.
///
/// In-plane values are centre +- radius; the direction comes from half the angle, which is accurate
/// for nearly equal values too (any direction will do there).
Spectrum spectrum(const StressVector<2>& v);

/// Spectral decomposition of a three-dimensional stress (QL iteration, accurate at equal values).
Spectrum spectrum(const StressVector<3>& v);

/// sum_i values_i n_i n_i^T as a stress vector.
template <int Dim>
StressVector<Dim> recompose(const Eigen::Vector3d& values, const Eigen::Matrix3d& directions);

/// Derivative of the isotropic function sigma(trial) with principal values y_i(x_1, x_2, x_3).
///
/// In the principal frame of the trial the normal components map by dy_i/dx_j and each shear
/// component by theta_ij = (y_i - y_j) / (x_i - x_j), whose limit at x_i = x_j is
/// (J_ii - J_ij - J_ji + J_jj) / 2. The quotient has the error eps |x| / |x_i - x_j| and the limit
/// one of order |x_i - x_j| / |x|: the limit is taken below 2^-26, the square root of eps.
/// @param x  trial and its directions  @param y  principal stresses in the same order
/// @param jacobian  dy_i/dx_j
template <int Dim>
TangentMatrix<Dim> isotropic_function_derivative(const Spectrum& x, const Eigen::Vector3d& y,
                                                 const Eigen::Matrix3d& jacobian);

}  // namespace constitutive

#pragma once

#include <vector>

#include "fpm/kernel.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// Which weights a scene needs besides the gradient; what it does not need is neither computed
/// nor stored. The weights of a neighbour lie in the order gradient, kappa, kappa X, second
/// gradient: the functions say where each kind begins in a space of `dim` dimensions.
struct Channels {
  bool pair = false;    ///< kappa and kappa X: hourglass control on the non-affine part
  bool second = false;  ///< second-gradient weights: sub-points

  static constexpr int kappa(int dim) { return dim; }        ///< with pairs only
  static constexpr int kappa_x(int dim) { return dim + 1; }  ///< with pairs only
  constexpr int second_gradient(int dim) const { return dim + (pair ? 1 + dim : 0); }
  /// Number of weights per neighbour.
  constexpr int count(int dim) const {
    return second_gradient(dim) + (second ? dim * (dim + 1) / 2 : 0);
  }

  bool operator==(const Channels&) const = default;
};

/// Number of weights per neighbour with every channel there is.
template <int Dim>
inline constexpr int most_channels = Channels{true, true}.count(Dim);

/// The neighbourhood of one row in its reference configuration, the row itself excluded.
template <int Dim>
struct RowGeometry {
  Eigen::Matrix<double, Dim, Eigen::Dynamic> offset;  ///< [m] X_ab = X_b - X_a, one column each
  Eigen::VectorXd volume;                             ///< [m^Dim] V_b
  double own_volume = 0.0;                            ///< [m^Dim] V_a
  double support_radius = 0.0;                        ///< [m] R

  Eigen::Index size() const { return offset.cols(); }
};

/// The corrected weights of one row. Reused from row to row, so that it allocates seldom.
template <int Dim>
struct RowWeights {
  Eigen::VectorXd value;                                ///< [-] N_ab of the neighbours
  double own_value = 0.0;                               ///< [-] N_aa
  Eigen::Matrix<double, Dim, Eigen::Dynamic> gradient;  ///< [1/m] G_ab; the self entry is -sum
  Eigen::VectorXd kappa;                                ///< [1/m^2] kappa_ab
  /// [1/m^2] h_ab with rows XX, XY, YY (2D) or XX, XY, XZ, YY, YZ, ZZ (3D); empty unless asked for.
  Eigen::Matrix<double, second_gradient_size<Dim>, Eigen::Dynamic> second;
  double condition = 0.0;         ///< 1-norm condition number of the moment matrix M
  double second_condition = 0.0;  ///< likewise of A; zero unless second weights are asked for
};

/// Corrected kernel and gradient weights of one row (Chen, Huang & Lyamin 2020, Eq. 1-2), the
/// normalised pair weights kappa_ab = V_b W_ab / sum_c V_c W_ac |X_ac|^2, and, if `second`, the
/// weights of the second gradient from a weighted Taylor fit.
///
/// Value and gradient reproduce linear fields, the second gradient quadratic ones, to round-off.
/// A singular neighbourhood shows as an infinite or NaN condition number; nothing is thrown.
template <int Dim>
void compute_weights(const RowGeometry<Dim>& row, Kernel kernel, bool second,
                     RowWeights<Dim>& weights);

}  // namespace fpm

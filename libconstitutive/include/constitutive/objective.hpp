#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "constitutive/elastic.hpp"
#include "constitutive/tensor.hpp"

/// Objective stress update of Hughes and Winget (1980), Eq. 37-38 of Chen, Huang & Lyamin 2020.
namespace constitutive {

/// Kinematics of one increment in the midpoint form; made by `objective_increment`.
template <int Dim>
struct ObjectiveIncrement {
  SpatialMatrix<Dim> gradient;      ///< L [-].
  SpatialMatrix<Dim> strain;        ///< e = sym L [-].
  SpatialMatrix<Dim> rotation;      ///< Q = (I - w/2)^-1 (I + w/2), w = skew L; orthogonal.
  SpatialMatrix<Dim> half_inverse;  ///< H, the inverse of the midpoint gradient.
  /// Determinant of the midpoint gradient; the increment is usable only while it is > 0
  /// (`is_admissible`).
  double midpoint_determinant = 0;

  /// False if the midpoint configuration is inverted, singular or not finite: shorten the step.
  [[nodiscard]] bool is_admissible() const { return midpoint_determinant > 0; }
};

/// Derivative of an `ObjectiveIncrement` in one direction of dF.
template <int Dim>
struct ObjectiveDerivative {
  SpatialMatrix<Dim> gradient;  ///< dL.
  SpatialMatrix<Dim> strain;    ///< de = sym dL.
  SpatialMatrix<Dim> rotation;  ///< dQ.
};

namespace detail {

inline Eigen::Matrix2d inverse_with_determinant(const Eigen::Matrix2d& m, double& determinant) {
  determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  Eigen::Matrix2d inverse;
  inverse << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return inverse * (1 / determinant);
}

inline Eigen::Matrix3d inverse_with_determinant(const Eigen::Matrix3d& m, double& determinant) {
  Eigen::Matrix3d inverse;
  inverse.col(0) = m.row(1).cross(m.row(2)).transpose();
  inverse.col(1) = m.row(2).cross(m.row(0)).transpose();
  inverse.col(2) = m.row(0).cross(m.row(1)).transpose();
  determinant = m.row(0).dot(inverse.col(0).transpose());
  return inverse * (1 / determinant);
}

/// Cayley transform (I - A)^-1 (I + A) of the skew part A = w / 2 of L / 2, in closed form.
///
/// With a the axial vector of A: I + 2 (A + A^2) / (1 + a.a) in both dimensions.
template <int Dim>
SpatialMatrix<Dim> cayley_rotation(const SpatialMatrix<Dim>& gradient) {
  if constexpr (Dim == 2) {
    const double a = (gradient(0, 1) - gradient(1, 0)) / 4;
    const double scale = 1 / (1 + a * a);
    const double c = (1 - a * a) * scale, s = 2 * a * scale;
    SpatialMatrix<2> q;
    q << c, s, -s, c;
    return q;
  } else {
    const SpatialMatrix<3> a = (gradient - gradient.transpose()) / 4;
    const double square = a(0, 1) * a(0, 1) + a(1, 2) * a(1, 2) + a(0, 2) * a(0, 2);
    return SpatialMatrix<3>::Identity() + 2 / (1 + square) * (a + a * a);
  }
}

}  // namespace detail

/// Midpoint kinematics of an increment of the deformation gradient, L = change midpoint^-1
/// (Hughes-Winget); closed form, no allocation.
///
/// With change = F - F_n and midpoint = (F + F_n) / 2 this is (dF - I) ((dF + I) / 2)^-1 of
/// dF = F F_n^-1, without the inverse and without the cancellation in dF - I. H is midpoint^-1.
/// Never fails: an inverted or non-finite midpoint shows in `is_admissible()`.
template <int Dim>
ObjectiveIncrement<Dim> objective_increment(const Eigen::Matrix<double, Dim, Dim>& change,
                                            const Eigen::Matrix<double, Dim, Dim>& midpoint) {
  ObjectiveIncrement<Dim> inc;
  inc.half_inverse = detail::inverse_with_determinant(midpoint, inc.midpoint_determinant);
  inc.gradient = change * inc.half_inverse;
  inc.strain = (inc.gradient + inc.gradient.transpose()) / 2;
  inc.rotation = detail::cayley_rotation<Dim>(inc.gradient);
  return inc;
}

/// The same from the relative deformation gradient dF = F F_n^-1.
template <int Dim>
ObjectiveIncrement<Dim> objective_increment(const Eigen::Matrix<double, Dim, Dim>& dF) {
  const SpatialMatrix<Dim> identity = SpatialMatrix<Dim>::Identity();
  return objective_increment<Dim>(dF - identity, (dF + identity) / 2);
}

/// Exact directional derivative of `objective_increment` for a change d_dF of dF, or of F where the
/// increment was made from F - F_n.
///
/// dL = (I - L/2) d_dF H, dQ = (I - w/2)^-1 (dw/2) (I + Q); and since (I - w/2)^-1 = (I + Q)/2,
/// dQ = (I + Q) dw (I + Q) / 4, which needs no solve.
template <int Dim>
ObjectiveDerivative<Dim> derivative(const ObjectiveIncrement<Dim>& inc,
                                    const Eigen::Matrix<double, Dim, Dim>& d_dF) {
  const SpatialMatrix<Dim> identity = SpatialMatrix<Dim>::Identity();
  ObjectiveDerivative<Dim> d;
  d.gradient = (identity - inc.gradient / 2) * d_dF * inc.half_inverse;
  d.strain = (d.gradient + d.gradient.transpose()) / 2;
  const SpatialMatrix<Dim> spin = (d.gradient - d.gradient.transpose()) / 2;
  const SpatialMatrix<Dim> i_plus_q = identity + inc.rotation;
  d.rotation = i_plus_q * spin * i_plus_q / 4;
  return d;
}

/// Q sigma Q^T of a stress-like vector; in plane strain zz is untouched.
inline StressVector<2> rotate(const StressVector<2>& v, const Eigen::Matrix2d& q) {
  // First sigma Q^T, then Q (...), written out: this runs for every particle and evaluation.
  const double a00 = v[0] * q(0, 0) + v[3] * q(0, 1), a01 = v[0] * q(1, 0) + v[3] * q(1, 1);
  const double a10 = v[3] * q(0, 0) + v[1] * q(0, 1), a11 = v[3] * q(1, 0) + v[1] * q(1, 1);
  return {q(0, 0) * a00 + q(0, 1) * a10, q(1, 0) * a01 + q(1, 1) * a11, v[2],
          q(0, 0) * a01 + q(0, 1) * a11};
}

/// Q sigma Q^T of a stress-like vector in three dimensions.
inline StressVector<3> rotate(const StressVector<3>& v, const Eigen::Matrix3d& q) {
  const Eigen::Matrix3d rotated = q * to_matrix(v) * q.transpose();
  return from_matrix<3>(rotated);
}

/// dQ sigma Q^T + Q sigma dQ^T: derivative of `rotate` with sigma fixed.
template <int Dim>
StressVector<Dim> rotate_derivative(const StressVector<Dim>& v, const SpatialMatrix<Dim>& q,
                                    const SpatialMatrix<Dim>& dq) {
  const SpatialMatrix<Dim> half = dq * spatial_part<Dim>(v) * q.transpose();
  StressVector<Dim> d;
  d[0] = 2 * half(0, 0);
  d[1] = 2 * half(1, 1);
  d[3] = half(0, 1) + half(1, 0);
  if constexpr (Dim == 2) {
    d[2] = 0;
  } else {
    d[2] = 2 * half(2, 2);
    d[4] = half(1, 2) + half(2, 1);
    d[5] = half(2, 0) + half(0, 2);
  }
  return d;
}

/// Elastic trial stress Q sigma_n Q^T + lambda tr(e) I + 2 mu e of an objective increment.
/// @param stress  converged stress at the *beginning* of the step, never that of the last trial
template <int Dim>
StressVector<Dim> elastic_trial(const StressVector<Dim>& stress, const ObjectiveIncrement<Dim>& inc,
                                const ElasticModuli& m) {
  return rotate(stress, inc.rotation) + elastic_stress<Dim>(m, strain_vector<Dim>(inc.strain));
}

/// Derivative of `elastic_trial` along `d`, the stress at the beginning of the step being fixed.
template <int Dim>
StressVector<Dim> elastic_trial_derivative(const StressVector<Dim>& stress,
                                           const ObjectiveIncrement<Dim>& inc,
                                           const ObjectiveDerivative<Dim>& d,
                                           const ElasticModuli& m) {
  return rotate_derivative<Dim>(stress, inc.rotation, d.rotation) +
         elastic_stress<Dim>(m, strain_vector<Dim>(d.strain));
}

/// Small-strain trial stress sigma_n + D de; `strain_increment` has engineering shear.
///
/// The size of the vectors names the dimension: call as elastic_trial<Dim>(...).
template <int Dim>
StressVector<Dim> elastic_trial(const StressVector<Dim>& stress,
                                const StrainVector<Dim>& strain_increment, const ElasticModuli& m) {
  return stress + elastic_stress<Dim>(m, strain_increment);
}

}  // namespace constitutive

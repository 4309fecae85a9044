#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "constitutive/elastic.hpp"
#include "constitutive/tensor.hpp"

/// Objective stress update of Hughes and Winget (1980), Eq. 37-38 of Chen, Huang & Lyamin 2020.
namespace constitutive {

/// Kinematics of one increment in the midpoint form; made by `objective_increment`.
template <int Dim, class Real = double>
struct ObjectiveIncrement {
  SpatialMatrix<Dim, Real> gradient;      ///< L [-].
  SpatialMatrix<Dim, Real> strain;        ///< e = sym L [-].
  SpatialMatrix<Dim, Real> rotation;      ///< Q = (I - w/2)^-1 (I + w/2), w = skew L; orthogonal.
  SpatialMatrix<Dim, Real> half_inverse;  ///< H, the inverse of the midpoint gradient.
  /// Determinant of the midpoint gradient; the increment is usable only while it is > 0
  /// (`is_admissible`).
  Real midpoint_determinant = 0;

  /// False if the midpoint configuration is inverted, singular or not finite: shorten the step.
  [[nodiscard]] Mask<Real> is_admissible() const { return midpoint_determinant > Real(0); }
};

/// Derivative of an `ObjectiveIncrement` in one direction of dF.
template <int Dim, class Real = double>
struct ObjectiveDerivative {
  SpatialMatrix<Dim, Real> gradient;  ///< dL.
  SpatialMatrix<Dim, Real> strain;    ///< de = sym dL.
  SpatialMatrix<Dim, Real> rotation;  ///< dQ.
};

namespace detail {

template <class Real>
SpatialMatrix<2, Real> inverse_with_determinant(const SpatialMatrix<2, Real>& m,
                                                Real& determinant) {
  determinant = m(0, 0) * m(1, 1) - m(0, 1) * m(1, 0);
  SpatialMatrix<2, Real> inverse;
  inverse << m(1, 1), -m(0, 1), -m(1, 0), m(0, 0);
  return inverse * (1 / determinant);
}

template <class Real>
SpatialMatrix<3, Real> inverse_with_determinant(const SpatialMatrix<3, Real>& m,
                                                Real& determinant) {
  SpatialMatrix<3, Real> inverse;
  inverse.col(0) = m.row(1).cross(m.row(2)).transpose();
  inverse.col(1) = m.row(2).cross(m.row(0)).transpose();
  inverse.col(2) = m.row(0).cross(m.row(1)).transpose();
  determinant = m.row(0).dot(inverse.col(0).transpose());
  return inverse * (1 / determinant);
}

/// Cayley transform (I - A)^-1 (I + A) of the skew part A = w / 2 of L / 2, in closed form.
///
/// With a the axial vector of A: I + 2 (A + A^2) / (1 + a.a) in both dimensions.
template <int Dim, class Real>
SpatialMatrix<Dim, Real> cayley_rotation(const SpatialMatrix<Dim, Real>& gradient) {
  if constexpr (Dim == 2) {
    const Real a = (gradient(0, 1) - gradient(1, 0)) / 4;
    const Real scale = 1 / (1 + a * a);
    const Real c = (1 - a * a) * scale, s = 2 * a * scale;
    SpatialMatrix<2, Real> q;
    q << c, s, -s, c;
    return q;
  } else {
    const SpatialMatrix<3, Real> a = (gradient - gradient.transpose()) / Real(4);
    const Real square = a(0, 1) * a(0, 1) + a(1, 2) * a(1, 2) + a(0, 2) * a(0, 2);
    return SpatialMatrix<3, Real>::Identity() + Real(2 / (1 + square)) * (a + a * a);
  }
}

}  // namespace detail

/// Midpoint kinematics of an increment of the deformation gradient, L = change midpoint^-1
/// (Hughes-Winget); closed form, no allocation.
///
/// With change = F - F_n and midpoint = (F + F_n) / 2 this is (dF - I) ((dF + I) / 2)^-1 of
/// dF = F F_n^-1, without the inverse and without the cancellation in dF - I. H is midpoint^-1.
/// Never fails: an inverted or non-finite midpoint shows in `is_admissible()`.
template <int Dim, class Real>
ObjectiveIncrement<Dim, Real> objective_increment(const Eigen::Matrix<Real, Dim, Dim>& change,
                                                  const Eigen::Matrix<Real, Dim, Dim>& midpoint) {
  ObjectiveIncrement<Dim, Real> inc;
  inc.half_inverse = detail::inverse_with_determinant(midpoint, inc.midpoint_determinant);
  inc.gradient = change * inc.half_inverse;
  inc.strain = (inc.gradient + inc.gradient.transpose()) / Real(2);
  inc.rotation = detail::cayley_rotation<Dim>(inc.gradient);
  return inc;
}

/// The same from the relative deformation gradient dF = F F_n^-1.
template <int Dim, class Real>
ObjectiveIncrement<Dim, Real> objective_increment(const Eigen::Matrix<Real, Dim, Dim>& dF) {
  const SpatialMatrix<Dim, Real> identity = SpatialMatrix<Dim, Real>::Identity();
  return objective_increment<Dim>(SpatialMatrix<Dim, Real>(dF - identity),
                                  SpatialMatrix<Dim, Real>((dF + identity) / Real(2)));
}

/// Exact directional derivative of `objective_increment` for a change d_dF of dF, or of F where the
/// increment was made from F - F_n.
///
/// dL = (I - L/2) d_dF H, dQ = (I - w/2)^-1 (dw/2) (I + Q); and since (I - w/2)^-1 = (I + Q)/2,
/// dQ = (I + Q) dw (I + Q) / 4, which needs no solve.
template <int Dim, class Real>
ObjectiveDerivative<Dim, Real> derivative(const ObjectiveIncrement<Dim, Real>& inc,
                                          const Eigen::Matrix<Real, Dim, Dim>& d_dF) {
  using Matrix = SpatialMatrix<Dim, Real>;
  ObjectiveDerivative<Dim, Real> d;
  d.gradient = (Matrix::Identity() - inc.gradient / Real(2)) * d_dF * inc.half_inverse;
  d.strain = (d.gradient + d.gradient.transpose()) / Real(2);
  const Matrix spin = (d.gradient - d.gradient.transpose()) / Real(2);
  const Matrix i_plus_q = Matrix::Identity() + inc.rotation;
  d.rotation = i_plus_q * spin * i_plus_q / Real(4);
  return d;
}

/// Q sigma Q^T of a stress-like vector; in plane strain zz is untouched.
template <class Real>
StressVector<2, Real> rotate(const StressVector<2, Real>& v, const SpatialMatrix<2, Real>& q) {
  // First sigma Q^T, then Q (...), written out: this runs for every particle and evaluation.
  const Real a00 = v[0] * q(0, 0) + v[3] * q(0, 1), a01 = v[0] * q(1, 0) + v[3] * q(1, 1);
  const Real a10 = v[3] * q(0, 0) + v[1] * q(0, 1), a11 = v[3] * q(1, 0) + v[1] * q(1, 1);
  return {q(0, 0) * a00 + q(0, 1) * a10, q(1, 0) * a01 + q(1, 1) * a11, v[2],
          q(0, 0) * a01 + q(0, 1) * a11};
}

/// Q sigma Q^T of a stress-like vector in three dimensions.
template <class Real>
StressVector<3, Real> rotate(const StressVector<3, Real>& v, const SpatialMatrix<3, Real>& q) {
  const SpatialMatrix<3, Real> m = q * spatial_part<3>(v) * q.transpose();
  return {m(0, 0),
          m(1, 1),
          m(2, 2),
          (m(0, 1) + m(1, 0)) / 2,
          (m(1, 2) + m(2, 1)) / 2,
          (m(2, 0) + m(0, 2)) / 2};
}

/// dQ sigma Q^T + Q sigma dQ^T: derivative of `rotate` with sigma fixed.
template <int Dim, class Real>
StressVector<Dim, Real> rotate_derivative(const StressVector<Dim, Real>& v,
                                          const SpatialMatrix<Dim, Real>& q,
                                          const SpatialMatrix<Dim, Real>& dq) {
  const SpatialMatrix<Dim, Real> half = dq * spatial_part<Dim>(v) * q.transpose();
  StressVector<Dim, Real> d;
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
template <int Dim, class Real>
StressVector<Dim, Real> elastic_trial(const StressVector<Dim, Real>& stress,
                                      const ObjectiveIncrement<Dim, Real>& inc,
                                      const ElasticModuli& m) {
  return rotate(stress, inc.rotation) + elastic_stress<Dim>(m, strain_vector<Dim>(inc.strain));
}

/// Derivative of `elastic_trial` along `d`, the stress at the beginning of the step being fixed.
template <int Dim, class Real>
StressVector<Dim, Real> elastic_trial_derivative(const StressVector<Dim, Real>& stress,
                                                 const ObjectiveIncrement<Dim, Real>& inc,
                                                 const ObjectiveDerivative<Dim, Real>& d,
                                                 const ElasticModuli& m) {
  return rotate_derivative<Dim>(stress, inc.rotation, d.rotation) +
         elastic_stress<Dim>(m, strain_vector<Dim>(d.strain));
}

/// Small-strain trial stress sigma_n + D de; `strain_increment` has engineering shear.
///
/// The size of the vectors names the dimension: call as elastic_trial<Dim>(...).
template <int Dim, class Real>
StressVector<Dim, Real> elastic_trial(const StressVector<Dim, Real>& stress,
                                      const StrainVector<Dim, Real>& strain_increment,
                                      const ElasticModuli& m) {
  return stress + elastic_stress<Dim>(m, strain_increment);
}

}  // namespace constitutive

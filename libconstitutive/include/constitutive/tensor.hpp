#pragma once

#include "constitutive/real.hpp"

/// Voigt conventions of this library.
///
/// Tension is positive. Rows are xx yy zz xy in plane strain (Dim = 2) and xx yy zz xy yz zx in
/// three dimensions (Dim = 3). Shear rows hold the tensor component in *stress* vectors and twice
/// the tensor component (engineering shear) in *strain* vectors, so that stress . strain is work.
namespace constitutive {

/// Rows of a Voigt vector: 4 in plane strain (Dim = 2), 6 in three dimensions (Dim = 3).
template <int Dim>
requires(Dim == 2 || Dim == 3) inline constexpr int stress_size = Dim == 2 ? 4 : 6;

/// Stress-like symmetric tensor: shear rows hold tensor components. `Real`: see real.hpp.
template <int Dim, class Real = double>
using StressVector = Eigen::Matrix<Real, stress_size<Dim>, 1>;

/// Strain-like symmetric tensor: shear rows hold twice the tensor components.
template <int Dim, class Real = double>
using StrainVector = Eigen::Matrix<Real, stress_size<Dim>, 1>;

/// Derivative of one Voigt vector with respect to another.
template <int Dim, class Real = double>
using TangentMatrix = Eigen::Matrix<Real, stress_size<Dim>, stress_size<Dim>>;

/// Second-order tensor of the kinematics: in-plane 2 x 2 in plane strain, 3 x 3 otherwise.
template <int Dim, class Real = double>
using SpatialMatrix = Eigen::Matrix<Real, Dim, Dim>;

namespace detail {

template <int Rows>
inline constexpr bool is_voigt = Rows == 4 || Rows == 6;

}  // namespace detail

/// Trace of a stress or strain vector (its first three rows in either dimension).
template <class Real, int Rows>
requires detail::is_voigt<Rows> Real trace(const Eigen::Matrix<Real, Rows, 1>& v) {
  return v[0] + v[1] + v[2];
}

/// Mean stress p = tr(sigma) / 3, tension positive [units of stress].
template <class Real, int Rows>
requires detail::is_voigt<Rows> Real mean_stress(const Eigen::Matrix<Real, Rows, 1>& stress) {
  return trace(stress) / 3;
}

/// The vector with its mean removed from the three normal rows (stress or strain).
template <class Real, int Rows>
requires detail::is_voigt<Rows> Eigen::Matrix<Real, Rows, 1> deviator(
    const Eigen::Matrix<Real, Rows, 1>& v) {
  Eigen::Matrix<Real, Rows, 1> s = v;
  s.template head<3>().array() -= trace(v) / 3;
  return s;
}

/// The isotropic vector p I.
template <int Dim, class Real>
StressVector<Dim, Real> isotropic(const Real& p) {
  StressVector<Dim, Real> v = StressVector<Dim, Real>::Zero();
  v.template head<3>().setConstant(p);
  return v;
}

/// Double contraction a : b of two *stress-like* vectors (shear rows count twice).
template <class Real, int Rows>
requires detail::is_voigt<Rows> Real contract(const Eigen::Matrix<Real, Rows, 1>& a,
                                              const Eigen::Matrix<Real, Rows, 1>& b) {
  return a.template head<3>().dot(b.template head<3>()) +
         2 * a.template tail<Rows - 3>().dot(b.template tail<Rows - 3>());
}

/// sqrt(J2) = sqrt(s : s / 2) of a vector that is already deviatoric and stress-like.
template <class Real, int Rows>
requires detail::is_voigt<Rows> Real sqrt_j2_of_deviator(const Eigen::Matrix<Real, Rows, 1>& s) {
  using std::sqrt;
  return sqrt(contract(s, s) / 2);
}

/// Second invariant J2 = s : s / 2 of the deviator of a stress vector [stress^2].
template <class Real, int Rows>
requires detail::is_voigt<Rows> Real j2(const Eigen::Matrix<Real, Rows, 1>& stress) {
  const Eigen::Matrix<Real, Rows, 1> s = deviator(stress);
  return contract(s, s) / 2;
}

/// Strain-like copy of a stress-like vector: shear rows doubled.
template <class Real, int Rows>
requires detail::is_voigt<Rows> Eigen::Matrix<Real, Rows, 1> with_engineering_shear(
    Eigen::Matrix<Real, Rows, 1> v) {
  v.template tail<Rows - 3>() *= 2;
  return v;
}

/// Stress-like copy of a strain vector: shear rows halved.
template <class Real, int Rows>
requires detail::is_voigt<Rows> Eigen::Matrix<Real, Rows, 1> with_tensor_shear(
    Eigen::Matrix<Real, Rows, 1> v) {
  v.template tail<Rows - 3>() /= 2;
  return v;
}

/// Symmetric 3 x 3 matrix of a stress-like vector; yz and zx vanish in plane strain.
inline Eigen::Matrix3d to_matrix(const StressVector<2>& v) {
  Eigen::Matrix3d m;
  m << v[0], v[3], 0, v[3], v[1], 0, 0, 0, v[2];
  return m;
}

/// Symmetric 3 x 3 matrix of a stress-like vector.
inline Eigen::Matrix3d to_matrix(const StressVector<3>& v) {
  Eigen::Matrix3d m;
  m << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
  return m;
}

/// Stress-like vector of the symmetric part of a 3 x 3 matrix; Dim = 2 drops yz and zx.
template <int Dim>
StressVector<Dim> from_matrix(const Eigen::Matrix3d& m) {
  StressVector<Dim> v;
  v.template head<3>() = m.diagonal();
  v[3] = (m(0, 1) + m(1, 0)) / 2;
  if constexpr (Dim == 3) {
    v[4] = (m(1, 2) + m(2, 1)) / 2;
    v[5] = (m(2, 0) + m(0, 2)) / 2;
  }
  return v;
}

/// The part of a stress that acts in the plane of the motion: 2 x 2 in plane strain, all in 3D.
template <int Dim, class Real>
SpatialMatrix<Dim, Real> spatial_part(const StressVector<Dim, Real>& v) {
  SpatialMatrix<Dim, Real> m;
  if constexpr (Dim == 2) {
    m << v[0], v[3], v[3], v[1];
  } else {
    m << v[0], v[3], v[5], v[3], v[1], v[4], v[5], v[4], v[2];
  }
  return m;
}

/// Strain vector (engineering shear) of the symmetric part of a Dim x Dim matrix; zz = 0 if Dim
/// = 2.
template <int Dim, class Real>
StrainVector<Dim, Real> strain_vector(const SpatialMatrix<Dim, Real>& e) {
  StrainVector<Dim, Real> v;
  v[0] = e(0, 0);
  v[1] = e(1, 1);
  v[3] = e(0, 1) + e(1, 0);
  if constexpr (Dim == 2) {
    v[2] = Real(0);
  } else {
    v[2] = e(2, 2);
    v[4] = e(1, 2) + e(2, 1);
    v[5] = e(2, 0) + e(0, 2);
  }
  return v;
}

}  // namespace constitutive

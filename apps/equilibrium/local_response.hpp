#pragma once

#include <array>

#include "constitutive/objective.hpp"
#include "constitutive/state.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/types.hpp"

/// One particle between kinematics and stress: here, and only here, strain increments of libfpm
/// meet the stress updates of libconstitutive.
namespace equilibrium {

/// A particle at the beginning of a step. `Real` is double, or `Lanes` for several particles.
template <int Dim, class Real = double>
struct ParticleStart {
  fpm::Tensor<Dim, Real> gradient;                 // F_a(n); identity in small strain
  fpm::SecondGradient<Dim, Real> second_gradient;  // H_a(n), total; with sub-points only
  Real reference_volume = 0.0;                     // Vref
  constitutive::PointState<Dim, Real> point;
  // With sub-points only.
  std::array<constitutive::StressVector<Dim, Real>, fpm::subpoint_count> deviator;
};

/// The increments the row's neighbourhood gives it.
template <int Dim, class Real = double>
struct ParticleIncrement {
  fpm::Tensor<Dim, Real> gradient;                 // sum du x G
  fpm::SecondGradient<Dim, Real> second_gradient;  // sum du x h; with sub-points only
};

/// What comes out: nominal stresses for the forces, and the end-of-step point.
template <int Dim, class Real = double>
struct ParticleResponse {
  constitutive::Mask<Real> admissible{};         // false: inverted or not finite, the rest is void
  fpm::Tensor<Dim, Real> nominal;                // P_a = V sigma F^-T, volume included
  fpm::SecondGradient<Dim, Real> second_stress;  // T_a, conjugate to H; with sub-points only
  fpm::Tensor<Dim, Real> rotation;               // Q of the step
  constitutive::PointState<Dim, Real> point;
  std::array<constitutive::StressVector<Dim, Real>, fpm::subpoint_count> deviator;
  Real plastic_increment = 0.0;
  constitutive::Mask<Real> plastic{};
};

/// Number of generalised strains: gradient, and with sub-points the second gradient.
template <int Dim, bool Mixed>
inline constexpr int generalised_size = Dim* Dim +
                                        (Mixed ? Dim * fpm::second_gradient_size<Dim> : 0);

/// d(P, T) / d(gradient, second gradient), both column-major, and dQ / d(gradient).
template <int Dim, bool Mixed, class Real = double>
struct ParticleTangent {
  Eigen::Matrix<Real, generalised_size<Dim, Mixed>, generalised_size<Dim, Mixed>> stress;
  Eigen::Matrix<Real, Dim * Dim, Dim * Dim> rotation;
};

namespace detail {

/// F = F(n) + increment: its determinant and inverse.
template <int Dim, class Real>
struct CurrentGradient {
  CurrentGradient(const fpm::Tensor<Dim, Real>& start, const fpm::Tensor<Dim, Real>& increment)
      : inverse(constitutive::detail::inverse_with_determinant(
            fpm::Tensor<Dim, Real>(start + increment), determinant)) {}
  Real determinant = 0.0;
  fpm::Tensor<Dim, Real> inverse;
  // False for a NaN too.
  constitutive::Mask<Real> admissible() const { return determinant > Real(0.0); }
};
template <class Real, int Dim>
CurrentGradient(const Eigen::Matrix<Real, Dim, Dim>&, const Eigen::Matrix<Real, Dim, Dim>&)
    -> CurrentGradient<Dim, Real>;

template <class Matrix>
Matrix unit(int column_major_index) {
  Matrix m = Matrix::Zero();
  m.data()[column_major_index] = 1.0;
  return m;
}

template <class Derived>
auto flat(const Eigen::PlainObjectBase<Derived>& m) {
  return Eigen::Map<const Eigen::Matrix<typename Derived::Scalar, Derived::SizeAtCompileTime, 1>>(
      m.data());
}

template <class Real, int Dim>
fpm::Tensor<Dim, Real> symmetric(const Eigen::Matrix<Real, Dim, Dim>& m) {
  return Real(0.5) * (m + m.transpose());
}

/// F(n) + increment / 2.
template <class Real, int Dim>
fpm::Tensor<Dim, Real> midpoint(const Eigen::Matrix<Real, Dim, Dim>& start,
                                const Eigen::Matrix<Real, Dim, Dim>& increment) {
  return start + Real(0.5) * increment;
}

}  // namespace detail
}  // namespace equilibrium

#pragma once

#include <array>

#include "constitutive/objective.hpp"
#include "constitutive/state.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/types.hpp"

/// One particle between kinematics and stress: here, and only here, strain increments of libfpm
/// meet the stress updates of libconstitutive.
namespace wiring {

/// A particle at the beginning of a step.
template <int Dim>
struct ParticleStart {
  fpm::Tensor<Dim> gradient;            // F_a(n); identity in small strain
  fpm::SecondGradient second_gradient;  // H_a(n), total; with sub-points only
  double reference_volume = 0.0;        // Vref
  constitutive::PointState<Dim> point;
  const double* deviator = nullptr;  // 4 x 4, with sub-points only
};

/// The increments the row's neighbourhood gives it.
template <int Dim>
struct ParticleIncrement {
  fpm::Tensor<Dim> gradient;            // sum du x G
  fpm::SecondGradient second_gradient;  // sum du x h; with sub-points only
};

/// What comes out: nominal stresses for the forces, and the end-of-step point.
template <int Dim>
struct ParticleResponse {
  bool admissible = false;            // false: inverted or not finite, everything else is void
  fpm::Tensor<Dim> nominal;           // P_a = V sigma F^-T, volume included
  fpm::SecondGradient second_stress;  // T_a, conjugate to H; with sub-points only
  fpm::Tensor<Dim> rotation;          // Q of the step
  constitutive::PointState<Dim> point;
  std::array<constitutive::StressVector<2>, fpm::subpoint_count> deviator;
  double plastic_increment = 0.0;
  bool plastic = false;
};

/// Number of generalised strains: gradient, and with sub-points the second gradient.
template <int Dim, bool Mixed>
inline constexpr int generalised_size = Dim* Dim + (Mixed ? 2 * 3 : 0);

/// d(P, T) / d(gradient, second gradient), both column-major, and dQ / d(gradient).
template <int Dim, bool Mixed>
struct ParticleTangent {
  Eigen::Matrix<double, generalised_size<Dim, Mixed>, generalised_size<Dim, Mixed>> stress;
  Eigen::Matrix<double, Dim * Dim, Dim * Dim> rotation;
};

namespace detail {

/// F = F(n) + increment: its determinant and inverse.
template <int Dim>
struct CurrentGradient {
  CurrentGradient(const fpm::Tensor<Dim>& start, const fpm::Tensor<Dim>& increment)
      : inverse(constitutive::detail::inverse_with_determinant(fpm::Tensor<Dim>(start + increment),
                                                               determinant)) {}
  double determinant = 0.0;
  fpm::Tensor<Dim> inverse;
  bool admissible() const { return determinant > 0.0; }  // false for a NaN too
};

template <class Matrix>
Matrix unit(int column_major_index) {
  Matrix m = Matrix::Zero();
  m.data()[column_major_index] = 1.0;
  return m;
}

template <class Derived>
auto flat(const Eigen::PlainObjectBase<Derived>& m) {
  return Eigen::Map<const Eigen::Matrix<double, Derived::SizeAtCompileTime, 1>>(m.data());
}

template <int Dim>
fpm::Tensor<Dim> symmetric(const fpm::Tensor<Dim>& m) {
  return 0.5 * (m + m.transpose());
}

}  // namespace detail
}  // namespace wiring

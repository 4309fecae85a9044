#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <type_traits>

#include "constitutive/parameters.hpp"
#include "constitutive/state.hpp"
#include "constitutive/tensor.hpp"

namespace constitutive {

/// Isotropic elastic moduli [Pa]; made by `elastic_moduli`.
struct ElasticModuli {
  double lame = 0;   ///< Lamé's first constant lambda = K - 2 mu / 3.
  double shear = 0;  ///< Shear modulus mu.
  double bulk = 0;   ///< Bulk modulus K.
};

/// Moduli of Young's modulus E > 0 [Pa] and Poisson's ratio -1 < nu < 1/2.
///
/// mu = E / (2 (1 + nu)), K = E / (3 (1 - 2 nu)). The range is the caller's duty (`validate`).
inline ElasticModuli elastic_moduli(double youngs_modulus, double poissons_ratio) {
  const double shear = youngs_modulus / (2 * (1 + poissons_ratio));
  const double lame =
      youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  const double bulk = youngs_modulus / (3 * (1 - 2 * poissons_ratio));
  return {lame, shear, bulk};
}

/// Radians of an angle in degrees.
inline double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}

/// Elastic stiffness D = d(stress)/d(strain), strain with engineering shear [Pa].
template <int Dim>
TangentMatrix<Dim> elastic_stiffness(const ElasticModuli& m) {
  TangentMatrix<Dim> d = TangentMatrix<Dim>::Zero();
  d.template topLeftCorner<3, 3>().setConstant(m.lame);
  d.diagonal().template head<3>().array() += 2 * m.shear;
  d.diagonal().template tail<stress_size<Dim> - 3>().setConstant(m.shear);
  return d;
}

/// Elastic stiffness of E [Pa] and nu; see the overload on `ElasticModuli`.
template <int Dim>
TangentMatrix<Dim> elastic_stiffness(double youngs_modulus, double poissons_ratio) {
  return elastic_stiffness<Dim>(elastic_moduli(youngs_modulus, poissons_ratio));
}

/// D strain: the stress increment of a strain vector with engineering shear, without forming D.
template <int Dim, class Real>
StressVector<Dim, Real> elastic_stress(const ElasticModuli& m,
                                       const StrainVector<Dim, Real>& strain) {
  StressVector<Dim, Real> stress = Real(2 * m.shear) * strain;
  stress.template tail<stress_size<Dim> - 3>() /= Real(2);
  stress.template head<3>().array() += m.lame * trace(strain);
  return stress;
}

/// Equivalent strain sqrt(2/3 e : e) of the elastic strain whose stress has invariants p and
/// sqrt(J2).
///
/// With e = s / (2 mu) + p I / (3 K) this is sqrt(J2 / (3 mu^2) + 2 p^2 / (9 K^2)); applied to
/// (trial stress - stress) it is the equivalent plastic strain increment of any return.
template <class Real>
Real equivalent_elastic_strain(const ElasticModuli& m, const Real& p, const Real& sqrt_j2) {
  using std::hypot;
  return hypot(sqrt_j2 / (std::sqrt(3.0) * m.shear), std::sqrt(2.0) / 3 * p / m.bulk);
}

/// Isotropic linear elasticity (hypoelastic at finite strain: the trial stress is the stress).
struct Elastic {
  static constexpr std::array<ModelInfo, 1> models{{{.name = "elastic", .yields = false}}};

  ElasticModuli moduli;

  static Elastic make(const MaterialParameters& p, const ModelInfo&) {
    return {elastic_moduli(p.youngs_modulus, p.poissons_ratio)};
  }
};

/// Accepts the trial stress; fails only if it is not finite.
template <int Dim, class Real>
BasicUpdateOutcome<Real> update(const Elastic&,
                                const std::type_identity_t<StressVector<Dim, Real>>& trial,
                                const PointState<Dim, Real>& s0, PointState<Dim, Real>& s1) {
  Mask<Real> finite = is_finite(trial[0]);
  for (int row = 1; row < stress_size<Dim>; ++row) finite = finite & is_finite(trial[row]);
  s1.plastic_strain = s0.plastic_strain;
  s1.plastic_volume_strain = s0.plastic_volume_strain;
  for (int row = 0; row < stress_size<Dim>; ++row) {
    s1.stress[row] = select(finite, trial[row], s0.stress[row]);
  }
  return {.failed = !finite};
}

/// d(stress)/d(trial stress): the identity.
template <int Dim, class Real>
TangentMatrix<Dim, Real> trial_tangent(const Elastic&,
                                       const std::type_identity_t<StressVector<Dim, Real>>&,
                                       const PointState<Dim, Real>&) {
  return TangentMatrix<Dim, Real>::Identity();
}

}  // namespace constitutive

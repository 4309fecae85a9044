#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "constitutive/cone.hpp"
#include "constitutive/cut_cone.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/no_subpoints.hpp"
#include "constitutive/spectral.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// `VonMises`, `DruckerPrager` or `MohrCoulomb` whose cohesion and friction angle go linearly, with
/// the accumulated equivalent plastic strain k, to residual values: softening, or hardening where
/// these are higher. Plane strain and 3D.
///
/// `make_material` makes it of parameters that have a `residual_strain`.
struct HardeningSoil {
  static constexpr std::array<ModelInfo, 0> models{};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;
  static constexpr bool without_subpoints = true;

  /// Whose surface it has.
  enum class Surface : std::uint8_t { cylinder, plane_strain_cone, compression_cone, pyramid };

  ElasticModuli moduli;
  Surface surface = Surface::cylinder;
  double cohesion = 0, residual_cohesion = 0;  ///< [Pa]
  double friction = 0, residual_friction = 0;  ///< [rad]
  double dilation = 0;                         ///< [rad], at most either friction angle.
  double residual_strain = 1;                  ///< k from which on the residual values hold, > 0.
  /// No dilation in a step that begins with plastic_volume_strain >= this [-].
  double dilation_cutoff = std::numeric_limits<double>::infinity();

  /// Strength at a plastic strain.
  [[nodiscard]] double cohesion_at(double k) const {
    return cohesion + share(k) * (residual_cohesion - cohesion);
  }
  [[nodiscard]] double friction_at(double k) const {
    return friction + share(k) * (residual_friction - friction);
  }
  /// How far of the way to the residual values.
  [[nodiscard]] double share(double k) const { return std::clamp(k / residual_strain, 0.0, 1.0); }
};

namespace detail {

/// A return to the surface of some plastic strain k in principal stresses.
struct HardeningReturn {
  bool plastic = false, apex = false;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;                             ///< Of the stress by the trial, at that k.
  Eigen::Vector3d of_strain = Eigen::Vector3d::Zero();  ///< Of the stress by k, at that trial [Pa].
};

/// The strength at some plastic strain, and by how much it grows with it.
struct Strength {
  double cohesion, friction, cohesion_slope = 0, friction_slope = 0;

  Strength(const HardeningSoil& m, double k)
      : cohesion(m.cohesion_at(k)), friction(m.friction_at(k)) {
    if (k >= m.residual_strain) return;
    cohesion_slope = (m.residual_cohesion - m.cohesion) / m.residual_strain;
    friction_slope = (m.residual_friction - m.friction) / m.residual_strain;
  }
};

/// The cone at some strength, and its change with the plastic strain.
struct ConeChange {
  Cone cone;
  double alpha = 0, strength = 0;
};

inline ConeChange cone_change(HardeningSoil::Surface surface, const Strength& now, double psi) {
  const double sine = std::sin(now.friction), cosine = std::cos(now.friction);
  const double sine_slope = cosine * now.friction_slope;
  // Of c cos phi.
  const double term = now.cohesion_slope * cosine - now.cohesion * sine * now.friction_slope;
  if (surface == HardeningSoil::Surface::cylinder) {
    return {{.alpha = 0, .beta = 0, .strength = now.cohesion}, 0, now.cohesion_slope};
  }
  ConeChange r;
  if (surface == HardeningSoil::Surface::plane_strain_cone) {
    r.cone = plane_strain_cone(now.cohesion, now.friction, psi);
    const double beta = r.cone.beta, q0 = std::sqrt(1 - 3 * beta * beta);
    const double divisor = q0 + beta * sine;
    r.alpha = q0 / (3 * divisor * divisor) * sine_slope;
    r.strength =
        (term * (1 - 3 * r.cone.alpha * beta) - now.cohesion * cosine * 3 * beta * r.alpha) / q0;
    return r;
  }
  r.cone = compression_cone(now.cohesion, now.friction, psi);
  const double root = std::sqrt(3.0), divisor = 3 - sine;
  r.alpha = 6 / (root * divisor * divisor) * sine_slope;
  r.strength =
      6 / root * (term / divisor + now.cohesion * cosine * sine_slope / (divisor * divisor));
  return r;
}

inline HardeningReturn return_to_cone_at(const HardeningSoil& m, const Strength& now, double psi,
                                         const Eigen::Vector3d& trial) {
  const ConeChange change = cone_change(m.surface, now, psi);
  const Cone& cone = change.cone;
  const CutConeReturn base = return_to_cone_alone(cone, m.moduli, trial);
  HardeningReturn r{.plastic = base.regime != CutConeRegime::elastic,
                    .apex = base.regime == CutConeRegime::cone_apex,
                    .stress = base.stress,
                    .jacobian = base.jacobian};
  if (!r.plastic) return r;
  const double rest = 3 * base.stress.mean() * change.alpha - change.strength;
  if (r.apex) {
    r.of_strain.setConstant(-rest / (3 * cone.alpha));
    return r;
  }
  const double multiplier = rest / (m.moduli.shear + 9 * m.moduli.bulk * cone.alpha * cone.beta);
  const Eigen::Vector3d s = trial.array() - trial.mean();
  const double j = std::sqrt(s.squaredNorm() / 2);
  r.of_strain =
      (-multiplier * m.moduli.shear / j * s).array() - 3 * m.moduli.bulk * cone.beta * multiplier;
  return r;
}

/// The active planes A with flows D B: G dl = dA^T stress - d(strength), and all rows are equal, as
/// the stresses that two planes exchange are.
inline Eigen::Vector3d pyramid_change(const MohrCoulomb& m, double sin_psi, const Strength& now,
                                      const PrincipalReturn& r) {
  const double term = 2 * (now.cohesion_slope * m.cos_friction -
                           now.cohesion * m.sin_friction * now.friction_slope);
  const double rest = m.cos_friction * now.friction_slope * (r.stress[0] + r.stress[2]) - term;
  const Eigen::Vector3d a = plane_gradient(m.sin_friction, 0, 2);
  Eigen::Vector3d flow = principal_flow(m.moduli, sin_psi, 0, 2);
  if (r.regime == MohrCoulombRegime::compression_edge) {
    flow += principal_flow(m.moduli, sin_psi, 1, 2);
  } else if (r.regime == MohrCoulombRegime::extension_edge) {
    flow += principal_flow(m.moduli, sin_psi, 0, 1);
  } else if (r.regime == MohrCoulombRegime::apex) {
    const double cotangent = m.cos_friction / m.sin_friction;
    return Eigen::Vector3d::Constant(now.cohesion_slope * cotangent -
                                     now.cohesion * now.friction_slope /
                                         (m.sin_friction * m.sin_friction));
  }
  return -rest / a.dot(flow) * flow;
}

inline HardeningReturn return_to_pyramid_at(const HardeningSoil& m, const Strength& now, double psi,
                                            const Eigen::Vector3d& trial) {
  const MohrCoulomb base{.moduli = m.moduli,
                         .cohesion = now.cohesion,
                         .sin_friction = std::sin(now.friction),
                         .cos_friction = std::cos(now.friction)};
  const double sin_psi = std::sin(psi);
  const PrincipalReturn at = return_to_pyramid(base, sin_psi, trial);
  HardeningReturn r{.plastic = at.regime != MohrCoulombRegime::elastic,
                    .apex = at.regime == MohrCoulombRegime::apex,
                    .stress = at.stress,
                    .jacobian = at.jacobian};
  if (r.plastic) r.of_strain = pyramid_change(base, sin_psi, now, at);
  return r;
}

/// Equivalent plastic strain of what a return removed, and its gradient by that.
struct RemovedStrain {
  double strain = 0;
  Eigen::RowVector3d gradient = Eigen::RowVector3d::Zero();

  RemovedStrain(const ElasticModuli& m, const Eigen::Vector3d& removed) {
    const double p = removed.mean();
    const Eigen::Vector3d s = removed.array() - p;
    strain = equivalent_elastic_strain(m, p, std::sqrt(s.squaredNorm() / 2));
    if (strain == 0) return;
    const double of_mean = 2 * p / (27 * m.bulk * m.bulk);
    gradient = ((s / (6 * m.shear * m.shear)).array() + of_mean).matrix().transpose() / strain;
  }
};

/// The implicit return: k such that it is the plastic strain that the return to its surface makes.
struct HardeningStep {
  double strain = 0;  ///< k at the end.
  HardeningReturn at;
  Eigen::RowVector3d gradient =
      Eigen::RowVector3d::Zero();  ///< Of the plastic strain of the step by what is removed.
};

/// k - k0 - (plastic strain of the return at k) is negative at k0 and positive far beyond; Newton's
/// method inside a bracket. Where strength is lost faster than a point can be followed, several k
/// solve it; the bracket then holds one of them.
inline HardeningStep hardening_step(const HardeningSoil& m, double k0, double psi,
                                    const Eigen::Vector3d& trial) {
  HardeningStep step;
  double rest = 0, slope = 1;
  const auto take = [&](double k) {
    const Strength now(m, k);
    step.strain = k;
    step.at = m.surface == HardeningSoil::Surface::pyramid
                  ? return_to_pyramid_at(m, now, psi, trial)
                  : return_to_cone_at(m, now, psi, trial);
    const RemovedStrain removed(m.moduli, trial - step.at.stress);
    step.gradient = removed.gradient;
    rest = k - k0 - (step.at.plastic ? removed.strain : 0);
    slope = 1 + (step.at.plastic ? removed.gradient.dot(step.at.of_strain) : 0);
    return rest;
  };
  if (take(k0); !step.at.plastic) return step;
  double reach = -rest, low = k0, high = k0 + reach;
  if (!(high > k0)) return step;  // below round-off of what has been
  while (take(high) < 0) {
    low = high;
    reach *= 2;
    high = k0 + reach;
  }
  // Bisection alone needs as many steps as a double has bits.
  constexpr double eps = std::numeric_limits<double>::epsilon();
  for (int count = 0; count < 100 && std::abs(rest) > eps * step.strain; ++count) {
    (rest < 0 ? low : high) = step.strain;
    const double newton = step.strain - rest / slope;
    const bool inside = newton > low && newton < high && count % 8 != 7;
    const double next = inside ? newton : low + (high - low) / 2;
    if (!(next > low && next < high) || next == step.strain) break;
    take(next);
  }
  return step;
}

template <int Dim>
HardeningStep hardening_step_of(const HardeningSoil& m, const PointState<Dim>& s0,
                                const Eigen::Vector3d& trial) {
  const double psi = s0.plastic_volume_strain >= m.dilation_cutoff ? 0 : m.dilation;
  return hardening_step(m, s0.plastic_strain, psi, trial);
}

}  // namespace detail

/// Stress update of `HardeningSoil` from the elastic trial stress, in principal stress space: on
/// the surface of the plastic strain at the end of the step.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const HardeningSoil& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  if (!std::isfinite(j2(trial)) || !std::isfinite(trace(trial))) {
    s1 = s0;
    return {.failed = true};
  }
  const Spectrum x = spectrum(trial);
  const detail::HardeningStep step = detail::hardening_step_of(material, s0, x.values);
  s1 = s0;
  if (!step.at.plastic) {
    s1.stress = trial;
    return {};
  }
  s1.stress = recompose<Dim>(step.at.stress, x.directions);
  s1.plastic_strain = step.strain;
  s1.plastic_volume_strain += (x.values - step.at.stress).mean() / material.moduli.bulk;
  return {.apex = step.at.apex, .plastic = true};
}

/// d(stress)/d(trial stress) of `update` at a finite trial, the change of strength included.
///
/// With A and b the derivatives of the return at k by trial and by k, and e that of its plastic
/// strain by the stress removed, dk = e (I - A) d(trial) / (1 + e b).
template <int Dim>
TangentMatrix<Dim> trial_tangent(const HardeningSoil& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  const Spectrum x = spectrum(trial);
  const detail::HardeningStep step = detail::hardening_step_of(material, s0, x.values);
  if (!step.at.plastic) return TangentMatrix<Dim>::Identity();
  const Eigen::Vector3d& of_strain = step.at.of_strain;
  const double slope = 1 + step.gradient.dot(of_strain);
  Eigen::Matrix3d jacobian = step.at.jacobian;
  if (slope != 0) {
    const Eigen::RowVector3d along = step.gradient * (Eigen::Matrix3d::Identity() - jacobian);
    jacobian += of_strain * along / slope;
  }
  return isotropic_function_derivative<Dim>(x, step.at.stress, jacobian);
}

}  // namespace constitutive

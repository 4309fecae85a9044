#include "constitutive/hardening.hpp"

#include <cmath>
#include <limits>

#include "constitutive/cut_cone.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/spectral.hpp"

namespace constitutive {

namespace detail {

namespace {

HardeningReturn return_to_cone_at(const HardeningSoil& m, const Strength& now, double psi,
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
Eigen::Vector3d pyramid_change(const MohrCoulomb& m, double sin_psi, const Strength& now,
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

HardeningReturn return_to_pyramid_at(const HardeningSoil& m, const Strength& now, double psi,
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

}  // namespace

ConeChange cone_change(HardeningSoil::Surface surface, const Strength& now, double psi) {
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

HardeningStep hardening_step(const HardeningSoil& m, double k0, double psi,
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

template HardeningStep hardening_step_of(const HardeningSoil&, const PointState<2>&,
                                         const Eigen::Vector3d&);
template HardeningStep hardening_step_of(const HardeningSoil&, const PointState<3>&,
                                         const Eigen::Vector3d&);

}  // namespace detail

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

template UpdateOutcome update(const HardeningSoil&, const std::type_identity_t<StressVector<2>>&,
                              const PointState<2>&, PointState<2>&);
template UpdateOutcome update(const HardeningSoil&, const std::type_identity_t<StressVector<3>>&,
                              const PointState<3>&, PointState<3>&);
template TangentMatrix<2> trial_tangent(const HardeningSoil&,
                                        const std::type_identity_t<StressVector<2>>&,
                                        const PointState<2>&);
template TangentMatrix<3> trial_tangent(const HardeningSoil&,
                                        const std::type_identity_t<StressVector<3>>&,
                                        const PointState<3>&);

}  // namespace constitutive

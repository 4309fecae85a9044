#include "constitutive/cut_cone.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "accept_return.hpp"
#include "constitutive/rankine.hpp"
#include "constitutive/spectral.hpp"

namespace constitutive {

namespace detail {

namespace {

/// On the cone with sigma_1 = T: the cone's return of trial - l D e_1, l such that it is there.
///
/// sigma_1 of that return falls with l from above T, at l = 0, to T or below, where the trial
/// without the cone would have it: Newton's method inside that bracket.
CutConeReturn return_to_cone_and_plane(const Cone& cone, const ElasticModuli& m, double tension,
                                       const Eigen::Vector3d& trial) {
  const Eigen::Vector3d flow = rankine_plane(m, tension, 0).flow;
  double low = 0, high = (trial[0] - tension) / flow[0], at = high;
  CutConeReturn r = return_to_cone_alone(cone, m, trial - at * flow);
  // Bisection alone needs as many steps as a double has bits.
  for (int step = 0; step < 60 && high > low; ++step) {
    const double rest = r.stress[0] - tension;
    if (std::abs(rest) <= yield_round_off / 8 * (std::abs(trial[0]) + tension)) break;
    (rest > 0 ? low : high) = at;
    const double slope = -(r.jacobian.row(0) * flow).value();
    double next = slope < 0 ? at - rest / slope : low;
    if (!(next > low && next < high)) next = (low + high) / 2;
    if (next == at) break;
    at = next;
    r = return_to_cone_alone(cone, m, trial - at * flow);
  }
  const Eigen::Vector3d along = r.jacobian * flow;
  const Eigen::RowVector3d first = r.jacobian.row(0);
  if (along[0] != 0) r.jacobian -= along * first / along[0];
  r.stress[0] = tension;
  r.regime = CutConeRegime::cone_and_plane;
  return r;
}

/// The point of the cone with sigma_1 = sigma_2 = T; nothing if the cone is not as wide there.
std::optional<Eigen::Vector3d> cone_and_edge_point(const Cone& cone, double tension) {
  const double root = std::sqrt(3.0);
  // sqrt(J2) = (T - sigma_3) / sqrt 3 and p = (2 T + sigma_3) / 3 on the cone.
  const double slack = cone.strength - 3 * cone.alpha * tension;
  const double slope = 1 / root - cone.alpha;
  if (!(slack > 0) || !(slope > 0)) return std::nullopt;
  return Eigen::Vector3d(tension, tension, tension - slack / slope);
}

/// Whether a trial returns to that point: none of the three multipliers is negative.
bool returns_to(const Cone& cone, const ElasticModuli& m, double tension,
                const Eigen::Vector3d& point, const Eigen::Vector3d& trial, double looser) {
  const Eigen::Vector3d s = point.array() - point.mean();
  const double j = std::sqrt(s.squaredNorm() / 2);
  Eigen::Matrix3d flows;
  flows.col(0) = (m.shear / j * s).array() + 3 * m.bulk * cone.beta;
  flows.col(1) = rankine_plane(m, tension, 0).flow;
  flows.col(2) = rankine_plane(m, tension, 1).flow;
  return none_negative<3>(flows.inverse() * (trial - point), looser);
}

/// Whether a returned stress is within cone and cut-off, and in order.
bool is_admissible(const Cone& cone, double tension, const Eigen::Vector3d& y,
                   const Eigen::Vector3d& trial, double looser) {
  const double allowed = looser * plane_allowance(trial, tension);
  const double j = std::sqrt((y.array() - y.mean()).square().sum() / 2);
  const double slack = j - cone.radius(y.mean());
  const double of_cone = 4 * allowed + 4 * looser * yield_round_off * cone.strength;
  return y.maxCoeff() <= tension + allowed && y[0] >= y[1] - allowed && y[1] >= y[2] - allowed &&
         slack <= of_cone;
}

/// Every part of the surface that has a plane of the cut-off, the larger ones first; order and
/// multipliers decide. Whether one of them is the one.
bool returns_to_cut(const Cone& cone, const ElasticModuli& m, double tension,
                    const Eigen::Vector3d& trial, double looser, CutConeReturn& r) {
  using Regime = CutConeRegime;
  const std::array<PrincipalPlane, 3> cut{
      rankine_plane(m, tension, 0), rankine_plane(m, tension, 1), rankine_plane(m, tension, 2)};
  const auto takes = [&](const PlaneReturn& planes, Regime regime, int rows) {
    if (!planes.found) return false;
    r = {regime, planes.stress, planes.jacobian};
    r.stress.head(rows).setConstant(tension);
    return is_admissible(cone, tension, r.stress, trial, looser);
  };
  if (takes(return_to_planes<1>({&cut[0]}, trial, looser), Regime::plane, 1) ||
      takes(return_to_planes<2>({&cut[0], &cut[1]}, trial, looser), Regime::edge, 2) ||
      takes(return_to_planes<3>({&cut[0], &cut[1], &cut[2]}, trial, looser), Regime::corner, 3)) {
    return true;
  }
  r = return_to_cone_and_plane(cone, m, tension, trial);
  if (is_admissible(cone, tension, r.stress, trial, looser)) return true;
  const auto point = cone_and_edge_point(cone, tension);
  if (!point || !returns_to(cone, m, tension, *point, trial, looser)) return false;
  r = {Regime::cone_and_edge, *point, Eigen::Matrix3d::Zero()};
  return true;
}

/// Return of sorted principal trial stresses (falling order) to the cut cone: what the cone alone
/// returns, if the cut-off admits it.
CutConeReturn return_to_cut_cone(const Cone& cone, const ElasticModuli& m, double tension,
                                 const Eigen::Vector3d& trial) {
  CutConeReturn r = return_to_cone_alone(cone, m, trial);
  if (r.stress[0] <= tension + plane_allowance(trial, tension)) return r;
  // A trial between two parts may miss both by round-off, the more the flatter a corner is.
  for (double looser = 1; looser < 1e9; looser *= 1e3) {
    if (returns_to_cut(cone, m, tension, trial, looser, r)) return r;
  }
  return {CutConeRegime::corner, Eigen::Vector3d::Constant(std::min(tension, cone.apex_pressure())),
          Eigen::Matrix3d::Zero()};
}

template <int Dim>
Cone cone_of(const CutCone& material, const PointState<Dim>& s0) {
  return yield_cone<double>(material.soil, s0.plastic_volume_strain);
}

}  // namespace

CutConeReturn return_to_cone_alone(const Cone& cone, const ElasticModuli& m,
                                   const Eigen::Vector3d& trial) {
  CutConeReturn r{CutConeRegime::elastic, trial, Eigen::Matrix3d::Identity()};
  const Eigen::Vector3d ones = Eigen::Vector3d::Ones();
  const double p = trial.mean();
  const Eigen::Vector3d s = trial - p * ones;
  const double j = std::sqrt(s.squaredNorm() / 2);
  if (!cone.is_exceeded(j, p)) return r;
  const double stiffness = m.shear + 9 * m.bulk * cone.alpha * cone.beta;
  const double multiplier = (j + 3 * cone.alpha * p - cone.strength) / stiffness;
  const double radius = j - m.shear * multiplier;
  if (radius <= 0) {
    return {CutConeRegime::cone_apex, cone.apex_pressure() * ones, Eigen::Matrix3d::Zero()};
  }
  const double ratio = radius / j;
  r.regime = CutConeRegime::cone;
  r.stress = (p - 3 * m.bulk * cone.beta * multiplier) * ones + ratio * s;
  const Eigen::RowVector3d of_j = s.transpose() / (2 * j);
  const Eigen::RowVector3d of_multiplier = (of_j + cone.alpha * ones.transpose()) / stiffness;
  const Eigen::Matrix3d deviatoric = Eigen::Matrix3d::Identity() - ones * ones.transpose() / 3;
  r.jacobian = ratio * deviatoric + s / j * ((1 - ratio) * of_j - m.shear * of_multiplier) +
               ones * (ones.transpose() / 3 - 3 * m.bulk * cone.beta * of_multiplier);
  return r;
}

}  // namespace detail

template <int Dim>
UpdateOutcome update(const CutCone& material, const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  const Cone cone = detail::cone_of(material, s0);
  s1 = s0;
  if (!std::isfinite(j2(trial)) || !std::isfinite(trace(trial))) return {.failed = true};
  const Spectrum x = spectrum(trial);
  const detail::CutConeReturn r =
      detail::return_to_cut_cone(cone, material.moduli, material.tension, x.values);
  if (r.regime == detail::CutConeRegime::elastic) {
    s1.stress = trial;
    return {};
  }
  detail::accept_return(material.moduli, x, r.stress, s1);
  const bool apex =
      r.regime == detail::CutConeRegime::cone_apex || r.regime == detail::CutConeRegime::corner;
  return {.apex = apex, .plastic = true};
}

template <int Dim>
TangentMatrix<Dim> trial_tangent(const CutCone& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  const Spectrum x = spectrum(trial);
  const detail::CutConeReturn r = detail::return_to_cut_cone(
      detail::cone_of(material, s0), material.moduli, material.tension, x.values);
  if (r.regime == detail::CutConeRegime::elastic) return TangentMatrix<Dim>::Identity();
  return isotropic_function_derivative<Dim>(x, r.stress, r.jacobian);
}

template UpdateOutcome update(const CutCone&, const std::type_identity_t<StressVector<2>>&,
                              const PointState<2>&, PointState<2>&);
template UpdateOutcome update(const CutCone&, const std::type_identity_t<StressVector<3>>&,
                              const PointState<3>&, PointState<3>&);
template TangentMatrix<2> trial_tangent(const CutCone&,
                                        const std::type_identity_t<StressVector<2>>&,
                                        const PointState<2>&);
template TangentMatrix<3> trial_tangent(const CutCone&,
                                        const std::type_identity_t<StressVector<3>>&,
                                        const PointState<3>&);

}  // namespace constitutive

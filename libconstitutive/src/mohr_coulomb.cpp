#include "constitutive/mohr_coulomb.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "accept_return.hpp"
#include "constitutive/rankine.hpp"
#include "constitutive/spectral.hpp"

namespace constitutive {

namespace detail {

namespace {

/// The planes of the pyramid that meet sorted stresses, and those of the cut-off.
struct CutPyramid {
  std::array<PrincipalPlane, 6> planes;
  enum : std::size_t { major, compression, extension, first, second, third };

  CutPyramid(const MohrCoulomb& m, double sin_psi) {
    const double strength = 2 * m.cohesion * m.cos_friction;
    const auto pyramid = [&](int row, int other) {
      return PrincipalPlane{plane_gradient(m.sin_friction, row, other),
                            principal_flow(m.moduli, sin_psi, row, other), strength};
    };
    planes = {pyramid(0, 2),
              pyramid(1, 2),
              pyramid(0, 1),
              rankine_plane(m.moduli, m.tension, 0),
              rankine_plane(m.moduli, m.tension, 1),
              rankine_plane(m.moduli, m.tension, 2)};
  }

  /// Whether the return to these planes is the one; equal stresses are made so to the last bit.
  template <std::size_t N>
  bool returns_to(const std::array<std::size_t, N>& active, const Eigen::Vector3d& trial,
                  double looser, PrincipalReturn& r) const {
    std::array<const PrincipalPlane*, N> chosen;
    for (std::size_t i = 0; i < N; ++i) chosen[i] = &planes[active[i]];
    const PlaneReturn found = return_to_planes<N>(chosen, trial, looser);
    if (!found.found) return false;
    r.regime = MohrCoulombRegime::tension;
    r.stress = found.stress;
    r.jacobian = found.jacobian;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const PrincipalPlane& plane = planes[i];
      if (std::find(active.begin(), active.end(), i) != active.end()) {
        if (i >= first) r.stress[static_cast<int>(i - first)] = plane.bound;
        continue;
      }
      const double allowed =
          looser * plane_allowance(trial, plane.bound) * plane.normal.cwiseAbs().sum();
      if (plane.normal.dot(r.stress) > plane.bound + allowed) return false;
    }
    return true;
  }

  /// Every part of the surface that has a plane of the cut-off, the larger ones first: the plane,
  /// its edges with the main plane and with its neighbour, and the points where these end.
  bool returns(const MohrCoulomb& m, const Eigen::Vector3d& trial, double looser,
               PrincipalReturn& r) const {
    if (returns_to<1>({first}, trial, looser, r) ||
        returns_to<2>({major, first}, trial, looser, r) ||
        returns_to<2>({first, second}, trial, looser, r)) {
      return true;
    }
    const double least =
        ((1 + m.sin_friction) * m.tension - 2 * m.cohesion * m.cos_friction) / (1 - m.sin_friction);
    // Four planes meet where both largest stresses are T: two of three cover its cone of trials.
    if (returns_to<3>({major, first, second}, trial, looser, r) ||
        returns_to<3>({major, compression, first}, trial, looser, r)) {
      r.stress = {m.tension, m.tension, least};
      return true;
    }
    if (returns_to<3>({major, extension, first}, trial, looser, r)) {
      r.stress = {m.tension, least, least};
      return true;
    }
    if (!returns_to<3>({first, second, third}, trial, looser, r)) return false;
    r.regime = MohrCoulombRegime::apex;
    return true;
  }
};

/// Return to the pyramid with its cut-off, where the pyramid's own lies beyond the latter.
PrincipalReturn return_to_cut_pyramid(const MohrCoulomb& m, double sin_psi,
                                      const Eigen::Vector3d& trial) {
  const CutPyramid cut(m, sin_psi);
  PrincipalReturn r;
  // A trial between two parts may miss both by round-off, the more the flatter a corner is.
  for (double looser = 1; looser < 1e9; looser *= 1e3) {
    if (cut.returns(m, trial, looser, r)) return r;
  }
  r.regime = MohrCoulombRegime::apex;
  r.stress.setConstant(m.tension);
  r.jacobian.setZero();
  return r;
}

}  // namespace

Eigen::Vector3d principal_flow(const ElasticModuli& m, double sine, int major, int minor) {
  Eigen::Vector3d flow = Eigen::Vector3d::Constant(2 * m.lame * sine);
  flow[major] += 2 * m.shear * (1 + sine);
  flow[minor] -= 2 * m.shear * (1 - sine);
  return flow;
}

Eigen::Vector3d plane_gradient(double sine, int major, int minor) {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  a[major] = 1 + sine;
  a[minor] = -(1 - sine);
  return a;
}

bool return_to_edge(const MohrCoulomb& m, double sin_psi, const Eigen::Vector3d& trial, int major,
                    int minor, PrincipalReturn& r) {
  const Eigen::Vector3d a1 = plane_gradient(m.sin_friction, 0, 2);
  const Eigen::Vector3d a2 = plane_gradient(m.sin_friction, major, minor);
  const Eigen::Vector3d flow1 = principal_flow(m.moduli, sin_psi, 0, 2);
  const Eigen::Vector3d flow2 = principal_flow(m.moduli, sin_psi, major, minor);
  const double strength = 2 * m.cohesion * m.cos_friction;
  const double f1 = a1.dot(trial) - strength, f2 = a2.dot(trial) - strength;
  const double g = a1.dot(flow1), h = a1.dot(flow2);
  const double mean = (f1 + f2) / (g + h) / 2, half = (f1 - f2) / (g - h) / 2;
  r.stress = trial - (mean + half) * flow1 - (mean - half) * flow2;
  // The two rows that are equal on this edge: make them so to the last bit.
  const int first = major == 0 ? 1 : 0, second = first + 1;
  r.stress[first] = r.stress[second] = (r.stress[first] + r.stress[second]) / 2;
  const Eigen::Vector3d sum = (flow1 + flow2) / (g + h) / 2,
                        difference = (flow1 - flow2) / (g - h) / 2;
  r.jacobian = Eigen::Matrix3d::Identity() - sum * (a1 + a2).transpose() -
               difference * (a1 - a2).transpose();
  r.regime = major == 0 ? MohrCoulombRegime::extension_edge : MohrCoulombRegime::compression_edge;
  return m.sin_friction == 0 || r.stress[0] >= r.stress[2];
}

PrincipalReturn return_to_pyramid(const MohrCoulomb& m, double sin_psi,
                                  const Eigen::Vector3d& trial) {
  PrincipalReturn r;
  r.stress = trial;
  r.jacobian.setIdentity();
  const Eigen::Vector3d a = plane_gradient(m.sin_friction, 0, 2);
  const double strength = 2 * m.cohesion * m.cos_friction;
  const double f = a.dot(trial) - strength;
  if (f <= yield_round_off * (a.cwiseAbs().dot(trial.cwiseAbs()) + strength)) return r;

  const Eigen::Vector3d flow = principal_flow(m.moduli, sin_psi, 0, 2);
  const double stiffness = a.dot(flow);
  r.stress = trial - f / stiffness * flow;
  const bool compression_side = r.stress[1] > r.stress[0];
  const bool extension_side = r.stress[2] > r.stress[1];
  if (!compression_side && !extension_side) {
    r.regime = MohrCoulombRegime::plane;
    r.jacobian = Eigen::Matrix3d::Identity() - flow / stiffness * a.transpose();
    return r;
  }
  if (compression_side && return_to_edge(m, sin_psi, trial, 1, 2, r)) return r;
  if (extension_side && return_to_edge(m, sin_psi, trial, 0, 1, r)) return r;
  r.regime = MohrCoulombRegime::apex;
  r.stress.setConstant(m.cohesion * m.cos_friction / m.sin_friction);
  r.jacobian.setZero();
  return r;
}

PrincipalReturn return_principal(const MohrCoulomb& m, double sin_psi,
                                 const Eigen::Vector3d& trial) {
  const PrincipalReturn r = return_to_pyramid(m, sin_psi, trial);
  // No tension at all, as for nearly every soil, costs a comparison.
  if (r.stress[0] <= m.tension || r.stress[0] <= m.tension + plane_allowance(trial, m.tension)) {
    return r;
  }
  return return_to_cut_pyramid(m, sin_psi, trial);
}

}  // namespace detail

template <int Dim>
UpdateOutcome update(const MohrCoulomb& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  const double sin_psi = detail::sine_of_dilation(material, s0);
  s1 = s0;
  if (!std::isfinite(j2(trial)) || !std::isfinite(trace(trial))) {
    return {.failed = true};
  }
  if (detail::is_within_for_sure(material, mean_stress(trial), std::sqrt(j2(trial)))) {
    s1.stress = trial;
    return {};
  }
  const Spectrum x = spectrum(trial);
  const detail::PrincipalReturn r = detail::return_principal(material, sin_psi, x.values);
  if (r.regime == detail::MohrCoulombRegime::elastic) {
    s1.stress = trial;
    return {};
  }
  detail::accept_return(material.moduli, x, r.stress, s1);
  const bool apex = r.regime == detail::MohrCoulombRegime::apex;
  return {.apex = apex, .plastic = true};
}

template <int Dim>
TangentMatrix<Dim> trial_tangent(const MohrCoulomb& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  if (detail::is_within_for_sure(material, mean_stress(trial), std::sqrt(j2(trial)))) {
    return TangentMatrix<Dim>::Identity();
  }
  const Spectrum x = spectrum(trial);
  const detail::PrincipalReturn r =
      detail::return_principal(material, detail::sine_of_dilation(material, s0), x.values);
  if (r.regime == detail::MohrCoulombRegime::elastic) return TangentMatrix<Dim>::Identity();
  return isotropic_function_derivative<Dim>(x, r.stress, r.jacobian);
}

template UpdateOutcome update(const MohrCoulomb&, const std::type_identity_t<StressVector<2>>&,
                              const PointState<2>&, PointState<2>&);
template UpdateOutcome update(const MohrCoulomb&, const std::type_identity_t<StressVector<3>>&,
                              const PointState<3>&, PointState<3>&);
template TangentMatrix<2> trial_tangent(const MohrCoulomb&,
                                        const std::type_identity_t<StressVector<2>>&,
                                        const PointState<2>&);
template TangentMatrix<3> trial_tangent(const MohrCoulomb&,
                                        const std::type_identity_t<StressVector<3>>&,
                                        const PointState<3>&);

}  // namespace constitutive

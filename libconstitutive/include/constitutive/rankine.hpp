#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <cstddef>

#include "constitutive/elastic.hpp"
#include "constitutive/state.hpp"

/// Rankine's tension cut-off: no principal stress above T, associated flow, with all its corners.
///
/// In principal stress space, falling order. The planes of the cut-off and those of a pyramid are
/// returned to together: a return to a few planes is linear, so every corner is closed form.
namespace constitutive::detail {

/// A plane normal . sigma <= bound in principal stress space, and D times its flow direction.
struct PrincipalPlane {
  Eigen::Vector3d normal;
  Eigen::Vector3d flow;
  double bound = 0;
};

/// The plane sigma_i <= T of the cut-off.
inline PrincipalPlane rankine_plane(const ElasticModuli& m, double tension, int row) {
  Eigen::Vector3d flow = Eigen::Vector3d::Constant(m.lame);
  flow[row] += 2 * m.shear;
  return {Eigen::Vector3d::Unit(row), flow, tension};
}

/// A return to planes: stress, its derivative by the trial; whether it is one.
struct PlaneReturn {
  bool found = false;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;
};

/// By how much a stress may be outside: round-off of the trial and of the bound it is held against,
/// as many times as `yield_round_off` takes it.
inline double plane_allowance(const Eigen::Vector3d& trial, double bound) {
  return 4 * yield_round_off * (trial.cwiseAbs().maxCoeff() + std::abs(bound));
}

/// Whether no multiplier is negative but for round-off, `looser` times what it is.
template <int N>
bool none_negative(const Eigen::Matrix<double, N, 1>& multiplier, double looser) {
  return (multiplier.array() >= -4 * looser * yield_round_off * multiplier.cwiseAbs().maxCoeff())
      .all();
}

/// Return onto the planes of `active`; found if no multiplier is negative.
template <std::size_t N>
PlaneReturn return_to_planes(const std::array<const PrincipalPlane*, N>& active,
                             const Eigen::Vector3d& trial, double looser) {
  constexpr int n = static_cast<int>(N);
  Eigen::Matrix<double, n, 3> normals;
  Eigen::Matrix<double, 3, n> flows;
  Eigen::Matrix<double, n, 1> bounds;
  for (int i = 0; i < n; ++i) {
    const PrincipalPlane& plane = *active[static_cast<std::size_t>(i)];
    normals.row(i) = plane.normal.transpose();
    flows.col(i) = plane.flow;
    bounds[i] = plane.bound;
  }
  PlaneReturn r;
  Eigen::Matrix<double, n, 1> multiplier;
  if constexpr (N == 3) {
    // Three planes meet in a point, whatever the trial.
    r.stress = normals.inverse() * bounds;
    r.jacobian.setZero();
    multiplier = flows.inverse() * (trial - r.stress);
  } else {
    const Eigen::Matrix<double, n, n> inverse =
        Eigen::Matrix<double, n, n>(normals * flows).inverse();
    multiplier = inverse * (normals * trial - bounds);
    r.stress = trial - flows * multiplier;
    r.jacobian = Eigen::Matrix3d::Identity() - flows * inverse * normals;
  }
  r.found = none_negative<n>(multiplier, looser);
  return r;
}

}  // namespace constitutive::detail

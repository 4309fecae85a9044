#include "constitutive/rankine.hpp"

#include <Eigen/LU>
#include <cmath>

namespace constitutive::detail {

PrincipalPlane rankine_plane(const ElasticModuli& m, double tension, int row) {
  Eigen::Vector3d flow = Eigen::Vector3d::Constant(m.lame);
  flow[row] += 2 * m.shear;
  return {Eigen::Vector3d::Unit(row), flow, tension};
}

double plane_allowance(const Eigen::Vector3d& trial, double bound) {
  return 4 * yield_round_off * (trial.cwiseAbs().maxCoeff() + std::abs(bound));
}

template <int N>
bool none_negative(const Eigen::Matrix<double, N, 1>& multiplier, double looser) {
  return (multiplier.array() >= -4 * looser * yield_round_off * multiplier.cwiseAbs().maxCoeff())
      .all();
}

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

template bool none_negative<3>(const Eigen::Vector3d&, double);
template PlaneReturn return_to_planes(const std::array<const PrincipalPlane*, 1>&,
                                      const Eigen::Vector3d&, double);
template PlaneReturn return_to_planes(const std::array<const PrincipalPlane*, 2>&,
                                      const Eigen::Vector3d&, double);
template PlaneReturn return_to_planes(const std::array<const PrincipalPlane*, 3>&,
                                      const Eigen::Vector3d&, double);

}  // namespace constitutive::detail

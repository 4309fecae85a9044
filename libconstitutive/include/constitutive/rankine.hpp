#pragma once

#include <Eigen/Core>
#include <array>
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
PrincipalPlane rankine_plane(const ElasticModuli& m, double tension, int row);

/// A return to planes: stress, its derivative by the trial; whether it is one.
struct PlaneReturn {
  bool found = false;
  Eigen::Vector3d stress;
  Eigen::Matrix3d jacobian;
};

/// By how much a stress may be outside: round-off of the trial and of the bound it is held against,
/// as many times as `yield_round_off` takes it.
double plane_allowance(const Eigen::Vector3d& trial, double bound);

/// Whether no multiplier is negative but for round-off, `looser` times what it is; N is 1, 2 or 3.
template <int N>
bool none_negative(const Eigen::Matrix<double, N, 1>& multiplier, double looser);

/// Return onto the planes of `active`; found if no multiplier is negative. N is 1, 2 or 3.
template <std::size_t N>
PlaneReturn return_to_planes(const std::array<const PrincipalPlane*, N>& active,
                             const Eigen::Vector3d& trial, double looser);

}  // namespace constitutive::detail

#pragma once

#include <cmath>

#include "constitutive/real.hpp"

namespace constitutive {

/// How two bodies that meet at a face act on each other. Springs of a stiffness far above the
/// bodies' hold them together, so a small gap goes with every traction.
struct InterfaceLaw {
  bool tied = true;               ///< neither slides nor opens, whatever strength it has
  double shear_stiffness = 1.0;   ///< over the stiffness across, > 0
  double friction_tangent = 0.0;  ///< [-] tan delta, >= 0; 0 is smooth
  double adhesion = 0.0;          ///< [Pa] >= 0, shear strength without pressure
  bool tension = false;           ///< bears tension across, so that it never opens
};

/// Whether a face resists sliding at all while it is closed.
[[nodiscard]] inline bool sticks(const InterfaceLaw& law) {
  return law.tied || law.friction_tangent > 0.0 || law.adhesion > 0.0;
}

enum class InterfaceState { sticking, sliding, open };

/// Traction at one point, and what it depends on.
template <int Dim>
struct InterfaceResponse {
  Eigen::Matrix<double, Dim, 1> traction;   ///< [Pa] on the first body
  Eigen::Matrix<double, Dim, 1> slip;       ///< [m] irreversible, tangential
  Eigen::Matrix<double, Dim, Dim> tangent;  ///< [Pa/m] d traction / d gap
  InterfaceState state = InterfaceState::sticking;
};

/// Traction on the first body after the second has moved by `gap` relative to it: elastic springs,
/// and Coulomb's law |t_t| <= adhesion - tan(delta) t_n by an elastic predictor and a radial
/// return. Sliding does not dilate. What opens loses its adhesion over the gap in which the springs
/// would bear it as a pull, so that the law is continuous; beyond, a point bears nothing and
/// forgets its stick.
/// @param stiffness  [Pa/m] > 0
/// @param normal  unit vector out of the first body
/// @param initial  [Pa] traction on the first body at gap and slip 0
/// @param gap  [m] displacement of the second body relative to the first
/// @param slip  [m] at the start of the step
template <int Dim>
InterfaceResponse<Dim> interface_response(const InterfaceLaw& law, double stiffness,
                                          const Eigen::Matrix<double, Dim, 1>& normal,
                                          const Eigen::Matrix<double, Dim, 1>& initial,
                                          const Eigen::Matrix<double, Dim, 1>& gap,
                                          const Eigen::Matrix<double, Dim, 1>& slip) {
  using Vector = Eigen::Matrix<double, Dim, 1>;
  using Matrix = Eigen::Matrix<double, Dim, Dim>;
  InterfaceResponse<Dim> response;
  response.slip = slip;
  const double along_face = law.shear_stiffness * stiffness;
  const Matrix across = normal * normal.transpose();
  response.tangent = along_face * Matrix::Identity() + (stiffness - along_face) * across;
  response.traction = initial + response.tangent * (gap - slip);
  if (law.tied) return response;

  const double pull = normal.dot(response.traction);
  const Vector shear = response.traction - pull * normal;
  const bool opens = pull > 0.0 && !law.tension;
  const double slope = opens ? 1.0 : pull < 0.0 ? law.friction_tangent : 0.0;
  const double strength = law.adhesion - slope * pull;
  if (opens && strength <= 0.0) {
    response.state = InterfaceState::open;
    response.slip = slip + shear / along_face;
    response.traction.setZero();
    response.tangent.setZero();
    return response;
  }
  if (opens) {
    response.traction = shear;
    response.tangent = along_face * (Matrix::Identity() - across);
  }
  const double size = shear.norm();
  if (size <= strength) return response;

  response.state = InterfaceState::sliding;
  const Vector direction = shear / size;
  response.slip = slip + (size - strength) / along_face * direction;
  response.traction = strength * direction;
  const Matrix along = Matrix::Identity() - across - direction * direction.transpose();
  response.tangent = along_face * strength / size * along;
  if (!opens) {
    response.traction += pull * normal;
    response.tangent += stiffness * across;
  }
  if (slope > 0.0) response.tangent -= stiffness * slope * direction * normal.transpose();
  return response;
}

}  // namespace constitutive

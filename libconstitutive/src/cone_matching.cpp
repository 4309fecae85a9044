#include <cmath>
#include <numbers>

#include "constitutive/cone.hpp"

namespace constitutive {

namespace {

double compression_slope(double angle) {
  return 2 * std::sin(angle) / (std::numbers::sqrt3 * (3 - std::sin(angle)));
}

}  // namespace

Cone plane_strain_cone(double cohesion, double friction_angle, double dilation_angle) {
  const double sin_phi = std::sin(friction_angle), sin_psi = std::sin(dilation_angle);
  Cone cone;
  cone.beta = sin_psi / std::sqrt(9 + 3 * sin_psi * sin_psi);
  const double q0 = std::sqrt(1 - 3 * cone.beta * cone.beta);
  cone.alpha = sin_phi / (3 * (q0 + cone.beta * sin_phi));
  cone.strength = cohesion * std::cos(friction_angle) * (1 - 3 * cone.alpha * cone.beta) / q0;
  return cone;
}

Cone compression_cone(double cohesion, double friction_angle, double dilation_angle) {
  Cone cone;
  cone.alpha = compression_slope(friction_angle);
  cone.beta = compression_slope(dilation_angle);
  cone.strength = 6 * cohesion * std::cos(friction_angle) /
                  (std::numbers::sqrt3 * (3 - std::sin(friction_angle)));
  return cone;
}

}  // namespace constitutive

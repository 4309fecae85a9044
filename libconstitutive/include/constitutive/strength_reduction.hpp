#pragma once

#include <cmath>
#include <numbers>

#include "constitutive/interface_law.hpp"
#include "constitutive/parameters.hpp"

namespace constitutive {

/// A material whose cohesion and tan(phi), residual ones included, are divided by a factor, and
/// tan(psi) with them, so that flow that is associated stays so; of a curved envelope the shear
/// strength under every normal stress.
/// @param factor  > 0; below 1 it strengthens
[[nodiscard]] inline MaterialParameters with_strength_over(MaterialParameters parameters,
                                                           double factor) {
  constexpr double degree = std::numbers::pi / 180.0;
  const auto divided = [&](double angle) {
    return std::atan(std::tan(angle * degree) / factor) / degree;
  };
  if (factor == 1.0) return parameters;
  parameters.cohesion /= factor;
  parameters.strength_factor *= factor;
  parameters.friction_angle = divided(parameters.friction_angle);
  parameters.dilation_angle = divided(parameters.dilation_angle);
  parameters.residual_cohesion /= factor;
  if (std::isfinite(parameters.residual_friction_angle)) {
    parameters.residual_friction_angle = divided(parameters.residual_friction_angle);
  }
  return parameters;
}

/// A face whose adhesion and tan(delta) are divided by a factor; one that is tied stays so.
/// @param factor  > 0; below 1 it strengthens
[[nodiscard]] inline InterfaceLaw with_strength_over(InterfaceLaw law, double factor) {
  law.friction_tangent /= factor;
  law.adhesion /= factor;
  return law;
}

}  // namespace constitutive

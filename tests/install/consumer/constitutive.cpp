// Shears a Drucker-Prager point beyond yield: the stress comes back to the cone.
#include <cmath>
#include <constitutive/cone_update.hpp>

int main() {
  using namespace constitutive;
  const double cohesion = 10e3, friction = 0.35, dilation = 0.1;
  const DruckerPrager material{.moduli = elastic_moduli(20e6, 0.3),
                               .cone = plane_strain_cone(cohesion, friction, dilation)};
  StressVector<2> trial;
  trial << -5e3, -5e3, -5e3, 50e3;
  const PointState<2> before{};
  PointState<2> after{};
  const UpdateOutcome outcome = update(material, trial, before, after);

  const double p = mean_stress(after.stress);
  const double distance = sqrt_j2_of_deviator(deviator(after.stress)) - material.cone.radius(p);
  // A dozen roundings of numbers no larger than the trial stress.
  const bool on_the_cone = std::abs(distance) < 1e-14 * 50e3;
  return outcome.plastic && on_the_cone && after.plastic_strain > 0.0 ? 0 : 1;
}

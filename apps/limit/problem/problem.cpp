#include "limit/problem/problem.hpp"

namespace limit::problem {

Problem in_units(const Problem& problem, const Units& units) {
  Problem scaled = problem;
  const double force = units.stress * units.length;
  for (mesh::Point& node : scaled.mesh.nodes) node /= units.length;
  const double live = units.multiplier_per_stress;
  for (Soil& soil : scaled.soils) {
    soil.cohesion /= units.stress;
    soil.cohesion_gradient /= units.stress / units.length;
    soil.tension /= units.stress;
    soil.envelope.stress /= units.stress;
    soil.centre /= units.length;
    soil.unit_weight /= units.stress / units.length;
    soil.live_unit_weight *= live * units.length;
    soil.weight_gradient /= units.stress / (units.length * units.length);
    soil.live_weight_gradient *= live * units.length * units.length;
    soil.variation_length *= units.length;
    soil.variation_stress *= units.stress;
    soil.seepage /= units.stress / units.length;
    soil.live_seepage *= live * units.length;
  }
  for (Boundary& boundary : scaled.boundaries) {
    boundary.normal_stress /= units.stress;
    boundary.shear_stress /= units.stress;
    boundary.live_normal_stress *= live;
    boundary.live_shear_stress *= live;
  }
  Footing& footing = scaled.footing;
  footing.centre /= units.length;
  for (std::size_t i = 0; i < 3; ++i) {
    const double arm = i == 2 ? units.length : 1.0;
    footing.dead_load[i] /= force * arm;
    footing.live_load[i] *= live / (units.length * arm);
  }
  scaled.pressure_length *= units.length;
  scaled.pressure_stress *= scaled.pressure_is_live ? 1.0 / live : units.stress;
  if (scaled.most_multiplier) *scaled.most_multiplier /= units.multiplier();
  return scaled;
}

}  // namespace limit::problem

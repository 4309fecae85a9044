#include "limit/programme/weight_power.hpp"

namespace limit::programme {

// The integral of a corner's barycentric coordinate times a quadratic shape function, over the
// area: of the corner's own 1/30, of another corner's -1/60, of a middle next to it 2/15, of the
// one across 1/15. Of all three corners together a corner has nothing, and a middle a third.
WeightForces weight_forces(const problem::Problem& problem, const problem::MeshPressure& water,
                           std::size_t triangle) {
  const mesh::Triangle& of = problem.mesh.triangles[triangle];
  const problem::Soil& soil = problem.soils[static_cast<std::size_t>(of.region)];
  const double area = mesh::twice_area(problem.mesh, of) / 2.0;
  WeightForces forces;
  forces.dead.fill(mesh::Point::Zero());
  forces.live.fill(mesh::Point::Zero());
  const auto add = [&](std::size_t place, const mesh::Point& at, double share) {
    forces.dead[place] += share * area * problem.force(soil, at);
    forces.live[place] += share * area * problem.live_force(soil, at);
    auto& with_water = problem.pressure_is_live ? forces.live : forces.dead;
    with_water[place] += share * area * water.force(triangle);
  };
  if (!soil.has_uneven_weight()) {
    for (std::size_t middle = 3; middle < 6; ++middle) add(middle, soil.centre, 1.0 / 3.0);
    return forces;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const mesh::Point& at = problem.mesh.nodes[static_cast<std::size_t>(of.nodes[k])];
    for (std::size_t i = 0; i < 3; ++i) {
      add(i, at, i == k ? 1.0 / 30.0 : -1.0 / 60.0);
      const bool is_next = i == k || (i + 1) % 3 == k;  // the middle between corners i and i + 1
      add(3 + i, at, is_next ? 2.0 / 15.0 : 1.0 / 15.0);
    }
  }
  return forces;
}

}  // namespace limit::programme

#include "limit/ground/ground_boundary.hpp"

namespace limit::ground {

problem::Boundary boundary_of(const GroundScene& scene, const GroundSide& side) {
  problem::Boundary boundary{side.name};
  switch (side.kind) {
    case SideKind::fixed:
      boundary.normal = boundary.tangential = problem::Known::support;
      break;
    case SideKind::roller:
    case SideKind::symmetry:
      boundary.normal = problem::Known::support;
      break;
    case SideKind::footing:
      boundary.normal = problem::Known::footing;
      boundary.tangential =
          side.base == BaseKind::rough ? problem::Known::footing : problem::Known::traction;
      boundary.may_open = !side.tension;
      break;
    case SideKind::loaded:
      boundary.normal_stress = -side.pressure;
      boundary.shear_stress = side.shear;
      if (scene.load.sought == Sought::traction) {
        boundary.live_normal_stress = -side.live_pressure;
        boundary.live_shear_stress = side.live_shear;
      }
      break;
    case SideKind::free:
      break;
  }
  return boundary;
}

}  // namespace limit::ground

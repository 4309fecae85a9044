#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/envelope.hpp"
#include "limit/problem/variation.hpp"

namespace limit::problem {

/// A rigid-perfectly-plastic Mohr-Coulomb soil (Tresca if the friction angle is 0), associated.
struct Soil {
  double cohesion = 0.0;          // [Pa] where it changes linearly, that at `centre`
  double friction_angle = 0.0;    // [rad] 0 <= phi < pi/2
  double unit_weight = 0.0;       // [N/m3] acts along Problem::pull
  double live_unit_weight = 0.0;  // [N/m3] per unit of the multiplier, along Problem::live_pull
  mesh::Point cohesion_gradient{0.0, 0.0};  // [Pa/m]
  mesh::Point centre{0.0, 0.0};             // [m]
  /// [N/m3] of the pore water on the grains, less the gradient of its pressure: stresses are then
  /// effective ones. Per unit of the multiplier, too.
  mesh::Point seepage{0.0, 0.0}, live_seepage{0.0, 0.0};
  /// [Pa] a tension cut-off (Rankine): no principal stress is more. Infinite: none.
  double tension = std::numeric_limits<double>::infinity();
  /// Behind an upright free face of soil without tension: a lower bound has it bear along uprights
  /// only (bare_corners.hpp).
  bool stands = false;
  /// Where it is there, the strength; cohesion and friction angle are then those of a tangent that
  /// is typical of the ground, for scales and guesses alone.
  Envelope envelope{};

  /// [N/m3 per m] Of the unit weights, which are those at `centre`.
  mesh::Point weight_gradient{0.0, 0.0}, live_weight_gradient{0.0, 0.0};
  /// A strength that changes in another way (local_soil.hpp), over a divisor; cohesion and friction
  /// angle above are then typical of it.
  std::shared_ptr<const Variation> variation = nullptr;
  double variation_length = 1.0, variation_stress = 1.0;  // [m], [Pa] in the problem's units
  double divisor = 1.0;                                   // of that cohesion and tan(phi)

  [[nodiscard]] bool cuts_tension() const { return std::isfinite(tension); }
  [[nodiscard]] bool is_curved() const { return envelope.is_there(); }
  /// Whether it has no cohesion anywhere: it bears nothing where nothing presses on it.
  [[nodiscard]] bool is_loose() const {
    return cohesion == 0.0 && cohesion_gradient.isZero(0.0) && variation == nullptr && !is_curved();
  }
  /// Whether its strength or its weight changes from place to place.
  [[nodiscard]] bool varies() const {
    return variation != nullptr || !cohesion_gradient.isZero(0.0) || has_uneven_weight();
  }
  [[nodiscard]] bool has_uneven_weight() const {
    return !weight_gradient.isZero(0.0) || !live_weight_gradient.isZero(0.0);
  }
  [[nodiscard]] double unit_weight_at(const mesh::Point& place) const {
    return unit_weight + weight_gradient.dot(place - centre);
  }
  [[nodiscard]] double live_unit_weight_at(const mesh::Point& place) const {
    return live_unit_weight + live_weight_gradient.dot(place - centre);
  }
  [[nodiscard]] double cohesion_at(const mesh::Point& place) const {
    return cohesion + cohesion_gradient.dot(place - centre);
  }
  /// The same soil with this cohesion everywhere.
  [[nodiscard]] Soil with_cohesion(double value) const {
    Soil even = *this;
    even.cohesion = value;
    even.cohesion_gradient.setZero();
    return even;
  }
};

/// What is known on a boundary in one direction (normal or tangential to it).
enum class Known {
  traction,  // the traction; the velocity is free
  support,   // the velocity is zero; the traction is whatever it must be
  footing,   // the velocity is the footing's; the tractions have the footing's resultant
};

/// A part of the outline with the same conditions.
struct Boundary {
  std::string name;
  Known normal = Known::traction;
  Known tangential = Known::traction;
  double normal_stress = 0.0;       // [Pa] tension positive; where normal == traction
  double shear_stress = 0.0;        // [Pa] along the outline, body to the left
  double live_normal_stress = 0.0;  // [Pa] per unit of the multiplier, in addition
  double live_shear_stress = 0.0;
  bool may_open = false;  // where normal == footing: no tension, the footing may leave the soil
};

/// A rigid body on the boundaries whose conditions name it. Its three motions are those along x and
/// y and the rotation (counterclockwise) about its centre; loads are work-conjugate to them.
struct Footing {
  mesh::Point centre{0.0, 0.0};  // [m]
  std::array<bool, 3> may_move{false, false, false};
  std::array<double, 3> dead_load{};  // [N/m, N/m, N]
  std::array<double, 3> live_load{};  // per unit of the multiplier
};

class PorePressure;

/// A collapse problem: how far the live loads (on the footing, on the outline, of the soil's
/// weight) can grow by their common multiplier. The multiplier has the unit that makes a live load
/// times it a load; for a footing pressure it is a pressure, for a weight a number.
struct Problem {
  mesh::Mesh mesh;
  std::vector<Soil> soils;           // by Triangle::region
  std::vector<Boundary> boundaries;  // by BoundaryEdge::boundary
  Footing footing;
  /// Body forces per unit weight: down, or aslant as an earthquake's are taken to be.
  mesh::Point pull{0.0, -1.0}, live_pull{0.0, -1.0};
  /// Where the multiplier is not followed any further, in its unit: where more weight makes more
  /// strength than it takes, nothing limits it. Absent: wherever it ends.
  std::optional<double> most_multiplier;
  /// A pore pressure that is not linear in each soil, beside their seepage (pore_pressure.hpp);
  /// stresses are then effective ones.
  std::shared_ptr<const PorePressure> pore_pressure = nullptr;
  double pressure_length = 1.0, pressure_stress = 1.0;  // [m], [Pa] in the problem's units
  bool pressure_is_live = false;                        // per unit of the multiplier

  [[nodiscard]] bool has_water() const {
    return pore_pressure != nullptr ||
           std::any_of(soils.begin(), soils.end(), [](const Soil& soil) {
             return !soil.seepage.isZero(0.0) || !soil.live_seepage.isZero(0.0);
           });
  }
  /// Body force on a soil at a place, [N/m3]; live, per unit of the multiplier.
  [[nodiscard]] mesh::Point force(const Soil& soil, const mesh::Point& place) const {
    return soil.unit_weight_at(place) * pull + soil.seepage;
  }
  [[nodiscard]] mesh::Point live_force(const Soil& soil, const mesh::Point& place) const {
    return soil.live_unit_weight_at(place) * live_pull + soil.live_seepage;
  }
};

/// What is made of order one before anything is solved.
struct Units {
  double length = 1.0;                 // [m]
  double stress = 1.0;                 // [Pa]
  double multiplier_per_stress = 1.0;  // 1 if the multiplier is a pressure

  /// Of the multiplier.
  [[nodiscard]] double multiplier() const { return stress * multiplier_per_stress; }
};

/// The same problem in other units; its multiplier is the old one over `units.multiplier()`.
[[nodiscard]] Problem in_units(const Problem& problem, const Units& units);

}  // namespace limit::problem

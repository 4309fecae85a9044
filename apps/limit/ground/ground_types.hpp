#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limit/problem/case.hpp"
#include "limit/problem/problem.hpp"
#include "scene/mesh_file.hpp"
#include "tables/varying_number.hpp"

namespace limit::ground {

/// What the strength of a material is over the normal stress; of a curved envelope its numbers.
enum class StrengthModel { mohr_coulomb, hoek_brown, power_law };
struct GroundCurve {
  StrengthModel model = StrengthModel::mohr_coulomb;
  std::optional<double> intact_strength;  // [Pa] of Hoek and Brown, sigma_ci
  std::optional<double> m_i, gsi, disturbance;
  std::optional<double> power_coefficient, power_exponent;
  std::optional<double> power_tension, reference_stress;  // [Pa]
};

/// A soil by its name.
struct GroundMaterial {
  std::string name;
  GroundCurve curve;
  tables::VaryingNumber cohesion;        // [Pa]
  tables::VaryingNumber friction_angle;  // [deg]
  tables::VaryingNumber unit_weight;     // [N/m3]
  problem::Soil soil;                    // made of these (ground_soils.hpp)
  double dilation_angle = 0.0;           // [rad] 0 .. friction angle
  std::optional<double> tension_cutoff;  // [Pa] of the largest principal stress
  std::optional<tables::VaryingNumber> saturated_unit_weight;  // [N/m3] below the water table
  bool grows = true;  // its weight is multiplied where gravity is sought
};

/// A polygon of one soil.
struct GroundRegion {
  std::string name;
  std::string material_name;
  std::size_t material = 0;          // its index
  std::size_t number = 0;            // in the scene, of which it may be a part
  std::vector<mesh::Point> outline;  // [m] either way around
  std::vector<std::vector<mesh::Point>> holes;
  std::string group;  // of a mesh, which gives them; empty once read
};

/// A symmetry is a roller once it has been read.
enum class SideKind { free, loaded, fixed, roller, footing, symmetry };
enum class BaseKind { rough, smooth };

/// A named part of the ground's outline. Pressures are positive in compression.
struct GroundSide {
  std::string name;
  SideKind kind = SideKind::free;
  std::vector<mesh::Point> along;  // [m] either way
  std::string group;               // of a mesh, which gives it; empty once read
  double pressure = 0.0;           // [Pa] loaded, footing: given
  double shear = 0.0;          // [Pa] loaded: given, along the outline with the ground to the left
  double live_pressure = 0.0;  // [Pa] loaded: per unit of the multiplier
  double live_shear = 0.0;
  BaseKind base = BaseKind::rough;  // footing
  bool tension = true;              // footing: bonded to the soil; else it may lift off
};

enum class Sought { footing, traction, gravity, strength, earthquake };

// The names of each enumeration's values as written, in the order of the enumerators.
namespace names {
inline constexpr std::array<std::string_view, 3> strength{"mohr_coulomb", "hoek_brown",
                                                          "power_law"};
inline constexpr std::array<std::string_view, 6> side{"free",   "loaded",  "fixed",
                                                      "roller", "footing", "symmetry"};
inline constexpr std::array<std::string_view, 2> base{"rough", "smooth"};
inline constexpr std::array<std::string_view, 5> sought{"footing", "traction", "gravity",
                                                        "strength", "earthquake"};
}  // namespace names
constexpr std::span<const std::string_view> names_of(StrengthModel) {
  return names::strength;
}
constexpr std::span<const std::string_view> names_of(SideKind) {
  return names::side;
}
constexpr std::span<const std::string_view> names_of(BaseKind) {
  return names::base;
}
constexpr std::span<const std::string_view> names_of(Sought) {
  return names::sought;
}

/// What is to grow until collapse.
struct GroundLoad {
  Sought sought = Sought::footing;
  double inclination = 0.0;   // [rad] of the footing's load, from the base's normal
  double eccentricity = 0.0;  // [m] of the footing's load, from the base's middle
  double kh = 0.0;            // horizontal weight over weight, along +x; with an earthquake sought,
                              // per unit of the multiplier
  double kv = 0.0;            // share of the weight that is lifted
  std::optional<bool> guided;  // the footing moves along its normal alone; absent: if it ends at a
                               // roller, whose mirror image completes it
};

class GroundPressure;

/// Pore water, hydrostatic below its table, a share of the overburden, or as told.
struct GroundWater {
  std::vector<mesh::Point> table;                      // [m] from left to right
  double unit_weight = 9810.0;                         // [N/m3]
  std::optional<double> r_u;                           // its pressure over the overburden
  std::optional<tables::VaryingNumber> pore_pressure;  // [Pa] below zero: none
  /// Of that, once the ground is wet (ground_water.hpp): if it is told in triangles, and else none.
  std::shared_ptr<const GroundPressure> in_triangles = nullptr;

  [[nodiscard]] bool is_there() const {
    return !table.empty() || r_u.value_or(0.0) > 0.0 || pore_pressure.has_value();
  }
  /// Whether it is told in triangles, between points or the values of a raster.
  [[nodiscard]] bool is_in_triangles() const {
    return pore_pressure && pore_pressure->samples &&
           pore_pressure->samples->kind != tables::Samples::Kind::table;
  }
};

/// Ground of polygons, its sides and its load, as a scene of fpm-limit's own describes it.
struct GroundScene {
  std::string title;
  problem::UnitNames units;
  scene::MeshFile mesh;
  GroundWater water;
  std::vector<GroundMaterial> materials;
  std::vector<GroundRegion> regions;
  std::vector<GroundSide> sides;
  GroundLoad load;
};

}  // namespace limit::ground

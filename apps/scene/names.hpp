#pragma once

#include <array>
#include <span>
#include <string_view>
#include <type_traits>

#include "scene/choices.hpp"

namespace scene {

// The names of each enumeration's values, in the order of the enumerators.
namespace names {
inline constexpr std::array<std::string_view, 2> layout{"cell", "vertex"};
inline constexpr std::array<std::string_view, 2> mesh_particles{"cells", "elements"};
inline constexpr std::array<std::string_view, 3> kernel{"cubic_spline", "quintic_spline",
                                                        "wendland_c2"};
inline constexpr std::array<std::string_view, 3> switch_{"auto", "on", "off"};
inline constexpr std::array<std::string_view, 2> kinematics{"finite_strain", "small_strain"};
inline constexpr std::array<std::string_view, 6> control{"auto",      "none",        "viscosity",
                                                         "stiffness", "incremental", "mixed"};
inline constexpr std::array<std::string_view, 3> axis{"x", "y", "z"};
inline constexpr std::array<std::string_view, 6> side{"left", "right", "bottom",
                                                      "top",  "front", "back"};
inline constexpr std::array<std::string_view, 5> method{"auto", "direct", "penalty", "ghosts",
                                                        "contact"};
inline constexpr std::array<std::string_view, 3> cutout{"free", "fixed", "roller"};
inline constexpr std::array<std::string_view, 6> outline{"free",   "loaded",  "fixed",
                                                         "roller", "footing", "symmetry"};
inline constexpr std::array<std::string_view, 2> base{"rough", "smooth"};
inline constexpr std::array<std::string_view, 5> sought{"footing", "traction", "gravity",
                                                        "strength", "earthquake"};
inline constexpr std::array<std::string_view, 4> initial_stress{"none", "geostatic", "gravity",
                                                                "uniform"};
inline constexpr std::array<std::string_view, 4> drive{"none", "displacement", "load", "strength"};
inline constexpr std::array<std::string_view, 5> drive_method{"auto", "direct", "ghosts", "contact",
                                                              "tied"};
inline constexpr std::array<std::string_view, 3> interface { "through", "tied", "contact" };
inline constexpr std::array<std::string_view, 2> lateral{"fixed", "free"};
inline constexpr std::array<std::string_view, 3> load{"traction", "gravity", "plate"};
inline constexpr std::array<std::string_view, 7> measure{
    "displacement", "stress",           "plastic_strain", "reaction",
    "resultant",    "max_displacement", "particle_stress"};
inline constexpr std::array<std::string_view, 2> preset{"default", "appendix_a"};
inline constexpr std::array<std::string_view, 3> solver{"hybrid", "newton_krylov", "multisecant"};
inline constexpr std::array<std::string_view, 2> jacobian{"analytic", "finite_difference"};
inline constexpr std::array<std::string_view, 4> preconditioner{"two_level", "factors",
                                                                "block_jacobi", "none"};
}  // namespace names

/// The names of an enumeration's values as written in a scene, in the enumerators' order.
constexpr std::span<const std::string_view> names_of(Layout) {
  return names::layout;
}
constexpr std::span<const std::string_view> names_of(MeshParticles) {
  return names::mesh_particles;
}
constexpr std::span<const std::string_view> names_of(CutoutKind) {
  return names::cutout;
}
constexpr std::span<const std::string_view> names_of(OutlineKind) {
  return names::outline;
}
constexpr std::span<const std::string_view> names_of(Base) {
  return names::base;
}
constexpr std::span<const std::string_view> names_of(Sought) {
  return names::sought;
}
constexpr std::span<const std::string_view> names_of(KernelKind) {
  return names::kernel;
}
constexpr std::span<const std::string_view> names_of(Switch) {
  return names::switch_;
}
constexpr std::span<const std::string_view> names_of(KinematicsKind) {
  return names::kinematics;
}
constexpr std::span<const std::string_view> names_of(HourglassControl) {
  return names::control;
}
constexpr std::span<const std::string_view> names_of(Axis) {
  return names::axis;
}
constexpr std::span<const std::string_view> names_of(Side) {
  return names::side;
}
constexpr std::span<const std::string_view> names_of(SupportMethod) {
  return names::method;
}
constexpr std::span<const std::string_view> names_of(DriveMethod) {
  return names::drive_method;
}
constexpr std::span<const std::string_view> names_of(InterfaceKind) {
  return names::interface;
}
constexpr std::span<const std::string_view> names_of(InitialStressKind) {
  return names::initial_stress;
}
constexpr std::span<const std::string_view> names_of(DriveKind) {
  return names::drive;
}
constexpr std::span<const std::string_view> names_of(Lateral) {
  return names::lateral;
}
constexpr std::span<const std::string_view> names_of(LoadKind) {
  return names::load;
}
constexpr std::span<const std::string_view> names_of(MeasureKind) {
  return names::measure;
}
constexpr std::span<const std::string_view> names_of(SolverPreset) {
  return names::preset;
}
constexpr std::span<const std::string_view> names_of(SolverMethod) {
  return names::solver;
}
constexpr std::span<const std::string_view> names_of(JacobianKind) {
  return names::jacobian;
}
constexpr std::span<const std::string_view> names_of(PreconditionerKind) {
  return names::preconditioner;
}

/// The name of a value as written in a scene: `name_of(Side::top) == "top"`.
template <class Enum>
requires std::is_enum_v<Enum>
constexpr std::string_view name_of(Enum value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

/// Particle fields a frame can hold, as [output] fields names them.
inline constexpr std::array<std::string_view, 15> output_field_names{
    "displacement",      "stress",
    "mean_stress",       "recovered_mean_stress",
    "pore_pressure",     "total_stress",
    "deviatoric_stress", "utilisation",
    "plastic_strain",    "plastic_volume_strain",
    "volume_ratio",      "yielding",
    "material",          "reaction",
    "searched"};

}  // namespace scene

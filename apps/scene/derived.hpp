#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/box.hpp"
#include "scene/choices.hpp"
#include "scene/drives.hpp"

namespace constitutive {
struct MaterialParameters;
struct ModelInfo;
}  // namespace constitutive

namespace scene {

struct Contact;
struct Geometry;
struct Interface;
struct Material;
struct Measure;
struct Scene;
struct Solver;
struct Support;

/// The model of a material, by its family and match.
[[nodiscard]] const constitutive::ModelInfo& model_of(const Material& material);

/// A material as libconstitutive takes it; what its model does not use is left out.
[[nodiscard]] constitutive::MaterialParameters parameters_of(const Material& material);

/// Whether strength or stiffness of a material change from place to place; `parameters_of` has
/// those of one place.
[[nodiscard]] bool varies(const Material& material);

/// Its parameters at a place.
[[nodiscard]] constitutive::MaterialParameters parameters_at(const Material& material,
                                                             std::span<const double> place);

/// Whether a material has a strength.
[[nodiscard]] bool yields(const Material& material);

/// The control `automatic` stands for: stiffness if every material is elastic; under a load that
/// grows, or where stages try the ground, incremental; else mixed in 2D when every material yields
/// and its sub-points can share one pressure, incremental otherwise.
[[nodiscard]] HourglassControl resolve_control(const Scene& scene);

/// Whether a material gives way in its shape far more than in its volume (Poisson's ratio above
/// 0.45): its mean stress alternates from particle to particle.
[[nodiscard]] bool is_nearly_incompressible(const Material& material);

/// Of all materials; -1 if there is none.
[[nodiscard]] double largest_poissons_ratio(const Scene& scene);

/// Hourglass modulus ratio gamma in force: the scene's, else 0.1 for stiffness and incremental, the
/// latter 0.001 under a load that grows and 0.01 where stages try ground that yields, 0.01 for
/// mixed, 0 for none and viscosity.
[[nodiscard]] double resolve_stiffness_ratio(const Scene& scene);

/// Whether the control is as weak as it is for the sake of a collapse only, to which loads that
/// grow, and stages that try the ground, need not lead.
[[nodiscard]] bool is_controlled_for_collapse(const Scene& scene);

/// How a support holds: its method, where `automatic` means ghosts if images can hold its side, and
/// direct otherwise: the layout is `vertex`, it is no side, a mirror, a side that the drive moves
/// or one that is not held across, or the paper's viscosity is the control. In stages one answer
/// for all of them, direct also where the support begins later.
[[nodiscard]] SupportMethod resolve_method(const Scene& scene, const Support& support);

/// How a displacement is imposed: likewise.
[[nodiscard]] DriveMethod resolve_drive_method(const Scene& scene);
/// The same of one of several drives.
[[nodiscard]] DriveMethod resolve_drive_method(const Scene& scene, const Drive& drive);

/// The drive that moves or holds its side by images: one at most, as none begins with them later.
[[nodiscard]] std::optional<ActingDrive> drive_by_images(const Scene& scene);

/// Whether the drive's plate is a wall, which from the first bears what ground at rest presses
/// against it: of an upright side that it moves across itself, by images or by particles, and on
/// which no load presses from the start.
[[nodiscard]] bool drives_wall(const Scene& scene);

/// A name as that of a column of the curve: neither commas nor spaces.
[[nodiscard]] std::string column_name(const std::string& name);

/// Whether the body is not the whole box: it has cutouts or is one of regions.
[[nodiscard]] bool is_cut(const Scene& scene);

/// Whether the consistency correction is on: `automatic` means on for jittered and graded sets,
/// for bodies that are not whole boxes, where sides are held by images and, what the particles
/// decide, where materials are bodies of their own.
[[nodiscard]] bool resolve_consistency(const Scene& scene);

/// The solver's settings with the preset's values filled in.
struct SolverSettings {
  double tolerance = 0.0;
  SolverMethod method = SolverMethod::hybrid;
  JacobianKind jacobian = JacobianKind::analytic;
  PreconditionerKind preconditioner = PreconditionerKind::two_level;
  bool operator==(const SolverSettings&) const = default;
};

/// Whether ground that yields, or what slides by contact, is asked for more than it may bear: by
/// loads that grow, strength that is divided, or stages that try it.
[[nodiscard]] bool may_give_way(const Scene& scene);

/// Fills absent keys of the solver from its preset and the scene.
[[nodiscard]] SolverSettings resolve_solver(const Scene& scene);

/// Particles along x, y, z (1 along z in 2D), without ghosts.
[[nodiscard]] std::array<std::int64_t, 3> lattice_counts(const Geometry& geometry);

/// Product of `lattice_counts`.
[[nodiscard]] std::int64_t particle_count(const Geometry& geometry);

/// Nominal number of steps of the programme: the scene's, else for a displacement
/// ceil(target / (increment_over_spacing spacing)); 1 without a drive.
[[nodiscard]] std::int64_t nominal_steps(const Scene& scene);

/// What the curve shows beside the drive: the scene's measures, or, if it has none and drives no
/// displacement, the reaction of each support and the largest displacement.
[[nodiscard]] std::vector<Measure> resolve_measures(const Scene& scene);

/// Index of the material at a place: of the region that holds it, or the last one whose box does.
[[nodiscard]] std::size_t material_at(const Scene& scene, std::span<const double> place);

/// Horizontal over vertical geostatic stress in a material.
[[nodiscard]] double resolve_k0(const Scene& scene, const Material& material);
/// The same along z.
[[nodiscard]] double resolve_k0_z(const Scene& scene, const Material& material);

/// Components of a uniform initial stress [Pa], rows xx yy zz xy yz zx, in a material.
[[nodiscard]] std::array<double, 6> uniform_stress(const Scene& scene, const Material& material);

/// What happens where two materials meet, by their numbers: the scene's table of them, or its
/// approximation.interfaces.
[[nodiscard]] Interface interface_between(const Scene& scene, std::size_t one, std::size_t other);

/// Stiffness of a face over the softer Young's modulus per spacing: the scene's, else 100 between
/// elastic materials, whose gap is all the error there is, and 10 where one yields.
[[nodiscard]] double resolve_stiffness_factor(const Contact& contact, bool yields);

/// What the springs of a face between elastic materials count by, over Young's modulus: 1, and next
/// to incompressibility the modulus of compression without strain across. A body that is held all
/// around gives way by that, and springs of a hundred Young's moduli would be softer than all of
/// it.
[[nodiscard]] double modulus_ratio_of_springs(const Material& material);

/// Whether every soil dilates by its friction angle.
[[nodiscard]] bool is_associated(const Scene& scene);

}  // namespace scene

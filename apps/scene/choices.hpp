#pragma once

namespace scene {

// What a scene chooses among. Apart from the scene, as much that needs a choice needs no key.

enum class Layout { cell, vertex };
/// What the particles of a body drawn in Gmsh are: those of cells within its outline, or its
/// elements.
enum class MeshParticles { cells, elements };
enum class KernelKind { cubic_spline, quintic_spline, wendland_c2 };
enum class Switch { automatic, on, off };
enum class KinematicsKind { finite_strain, small_strain };
enum class HourglassControl { automatic, none, viscosity, stiffness, incremental, mixed };
enum class Axis { x, y, z };
/// Faces of the box: left and right are x- and x+, bottom and top y- and y+, front and back z- and
/// z+. Up is y, in 3D as well.
enum class Side { left, right, bottom, top, front, back };
enum class SupportMethod { automatic, direct, penalty, ghosts, contact };
enum class DriveMethod { automatic, direct, ghosts, contact, tied };
/// How rows see across the interface of two materials: as one body, or each its own.
enum class InterfaceKind { through, tied, contact };
/// What happens at the surface that something cut out leaves.
enum class CutoutKind { free, fixed, roller };
/// What a part of the outline of regions is.
enum class OutlineKind { free, loaded, fixed, roller, footing, symmetry };
/// How a footing lies on the ground.
enum class Base { rough, smooth };
/// What fpm-limit lets grow until collapse.
enum class Sought { footing, traction, gravity, strength, earthquake };
enum class InitialStressKind { none, geostatic, gravity, uniform };
enum class DriveKind { none, displacement, load, strength };
enum class Lateral { fixed, free };
enum class LoadKind { traction, gravity, plate };
enum class MeasureKind {
  displacement,
  stress,
  plastic_strain,
  reaction,
  resultant,
  max_displacement,
  particle_stress
};
enum class SolverPreset { standard, appendix_a };
enum class SolverMethod { hybrid, newton_krylov, multisecant };
enum class JacobianKind { analytic, finite_difference };
enum class PreconditionerKind { two_level, factors, block_jacobi, none };

}  // namespace scene

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "constitutive/interface_law.hpp"
#include "constitutive/material.hpp"
#include "constitutive/parameters.hpp"
#include "fpm/bodies.hpp"
#include "fpm/boundary_loads.hpp"
#include "fpm/cells.hpp"
#include "fpm/ghosts.hpp"
#include "fpm/hourglass.hpp"
#include "fpm/particles.hpp"
#include "fpm/rows.hpp"
#include "model/material_index.hpp"
#include "model/state.hpp"
#include "scene/choices.hpp"

namespace model {

/// A pressure that follows the boundary.
template <int Dim>
struct FollowingPressure {
  fpm::PointOperator<Dim> op;
  fpm::BoundaryPoints<Dim> points;
  double pressure = 0.0;  // [Pa] positive pushes
  bool scaled = false;    // grows with the load parameter
};

/// A support by penalty on the true face of the body.
template <int Dim>
struct PenaltySupport {
  fpm::PointOperator<Dim> op;
  fpm::BoundaryPoints<Dim> points;
  fpm::PenaltyOptions<Dim> options;
  fpm::Field<Dim> target;  // [m] prescribed displacement of the points
  std::string name;        // of the support
};

/// A rigid plate that moves as the body lets it, in some ways at least. Its motions are the
/// translations of the point at which it is pushed or loaded, then its rotations about it, small.
template <int Dim>
struct Plate {
  static constexpr int motions = Dim == 2 ? 3 : 6;
  using Motion = Eigen::Matrix<double, motions, 1>;

  fpm::Vector<Dim> at = fpm::Vector<Dim>::Zero();          // [m]
  fpm::Vector<Dim> force = fpm::Vector<Dim>::Zero();       // [N/m or N] at load parameter 1
  fpm::Vector<Dim> held_force = fpm::Vector<Dim>::Zero();  // [N/m or N] that stays besides
  bool reported = false;                                   // by the curve
  double arm = 1.0;  // [m] rotations count as displacements there
  std::array<bool, motions> free{};

  /// Displacement of a place of the plate by each of its motions, a rotation by 1 m at its arm.
  Eigen::Matrix<double, Dim, motions> modes(const fpm::Vector<Dim>& place) const {
    Eigen::Matrix<double, Dim, motions> m;
    m.template leftCols<Dim>().setIdentity();
    const fpm::Vector<Dim> r = (place - at) / arm;
    if constexpr (Dim == 2) {
      m.col(2) << -r[1], r[0];
    } else {
      m.template rightCols<3>() << 0.0, r[2], -r[1], -r[2], 0.0, r[0], r[1], -r[0], 0.0;
    }
    return m;
  }
};

/// Faces at which bodies, or a body and a rigid one, meet under one law.
template <int Dim>
struct Interface {
  fpm::Interface<Dim> faces;
  constitutive::InterfaceLaw law;
  Eigen::VectorXd stiffness;                            // [Pa/m] of each point
  fpm::Field<Dim> initial_traction;                     // [Pa] on the first body, of each point
  fpm::Vector<Dim> drive = fpm::Vector<Dim>::Zero();    // [m] of a rigid body, at load parameter 1
  fpm::Vector<Dim> held = fpm::Vector<Dim>::Zero();     // [m] of it, whatever the load parameter
  fpm::Vector<Dim> measure = fpm::Vector<Dim>::Zero();  // weight of its force in the reported load
  std::string support;              // whose the rigid body is; empty: a drive's, or none
  std::string of_drive;             // whose plate it is; empty: none
  std::optional<Plate<Dim>> plate;  // a rigid body that is not driven in every way
  // Where strength is divided: of each point, whether its own is, too; empty: of none. Of tied clay
  // the cohesion of the side that is weakened is, and that of another one is kept.
  std::vector<char> weakens;
  double divided_adhesion = 0.0;                                   // [Pa]
  double kept_adhesion = std::numeric_limits<double>::infinity();  // [Pa]

  // Whether these points, not those of a finer rule, are the body's boundary to the consistency
  // correction, so that what they bear is what a constant stress asks of them.
  bool is_boundary = false;

  bool is_rigid() const { return faces.second.size() == 0; }
  bool weakens_at(fpm::Index point) const {
    return !weakens.empty() && weakens[static_cast<std::size_t>(point)] != 0;
  }
};

/// A law whose strength is divided as a run goes on.
struct ReducedLaw {
  LawIndex law = 0;
  constitutive::MaterialParameters parameters;  // undivided
};

/// A piece of the surface of a body of any shape that is one particle's.
template <int Dim>
struct SurfacePiece;

/// A straight one, with the body to its left, within a cell or an edge of an element.
template <>
struct SurfacePiece<2> {
  Eigen::Vector2d from, to;  // [m]
  fpm::Index particle = 0;
  int cut = -1;   // index of the cutout that made it
  int side = -1;  // index of the scene's side
  int face = -1;  // of the box: 0 left, 1 right, 2 bottom, 3 top
};

/// A flat one, of a face of an element or of a cell.
template <>
struct SurfacePiece<3> {
  Eigen::Vector3d middle;   // [m] centroid
  Eigen::Vector3d outward;  // unit normal
  double area = 0.0;        // [m2]
  fpm::Index particle = 0;
  int cut = -1;   // none
  int side = -1;  // as above
  int face = -1;  // as above, 4 front, 5 back
  // [m] Two edges of a rectangle; zero of what is none, or no wider than particles are apart.
  std::array<Eigen::Vector3d, 2> edges{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

inline Eigen::Vector2d middle_of(const SurfacePiece<2>& piece) {
  return 0.5 * (piece.from + piece.to);
}
inline Eigen::Vector3d middle_of(const SurfacePiece<3>& piece) {
  return piece.middle;
}

/// A piece of where two regions of a body meet.
template <int Dim>
struct JointPiece;

/// A straight one, about a spacing long; the particle `first` is to its left.
template <>
struct JointPiece<2> {
  Eigen::Vector2d from, to;  // [m]
  fpm::Index first = 0, second = 0;
};

/// A flat one.
template <>
struct JointPiece<3> {
  Eigen::Vector3d middle;  // [m]
  Eigen::Vector3d normal;  // unit, from the first into the second
  double area = 0.0;       // [m2]
  fpm::Index first = 0, second = 0;
};

/// A face between two materials that is none: at a place one of them runs out into a tip that has
/// too few particles for rows of its own.
struct JoinedFace {
  fpm::Index first = 0, second = 0;  // of the scene's materials
  Eigen::Vector2d place;             // [m]
};

/// A layer with too few particles across for rows of its own, of one body with a neighbour that is
/// another material.
template <int Dim>
struct ThinLayer {
  fpm::Index layer = 0, beside = 0;  // of the scene's materials
  fpm::Vector<Dim> place;            // [m] one where they meet
};

/// A scene turned into particles, materials, constraints and loads: everything that stays the same
/// during a run. Vectors over unknowns are component-major (all x, then all y, ...), length n Dim.
template <int Dim>
struct Model {
  fpm::Cells<Dim> cells;  // one around each particle, unless they are elements of a mesh
  // Of those: about as wide as particles are apart, for a grid behind them.
  fpm::Cells<Dim> background;
  fpm::ParticleSet<Dim> particles;
  fpm::Ghosts<Dim> ghosts;
  fpm::RowOptions row_options;
  fpm::Channels channels;
  StateLayout layout;
  bool consistency = false;
  fpm::Field<Dim> area_vector;  // boundary area of each particle, with the correction only

  // One of each of the scene's materials; of one whose values change from place to place one for
  // each of them.
  std::vector<constitutive::Material> laws;
  std::vector<double> youngs_modulus;  // of each law [Pa]
  std::vector<LawIndex> law;           // of each particle
  std::vector<ReducedLaw> reduced_laws;
  std::vector<MaterialIndex> material;  // of each particle
  Eigen::VectorXd mass;                 // [kg] of each particle
  // Of pore water, or empty for none: its pressure where each particle is at the start, and the
  // dead load by which the pressure's fall acts on the ground [N/m or N].
  Eigen::VectorXd pore_pressure;  // [Pa]
  Eigen::VectorXd water_load;

  scene::HourglassControl control = scene::HourglassControl::none;
  fpm::PairControlOptions pair_control;
  double viscosity = 0.0;  // theta per step, of the paper's viscosity

  std::vector<char> prescribed;       // per unknown: displacement is given
  Eigen::VectorXd drive;              // [m] prescribed displacement at load parameter 1
  std::vector<char> driven_particle;  // moved by the drive: the rigid plate
  Eigen::VectorXd measure;            // per unknown: weight of its reaction in the reported load
  Eigen::VectorXd constant_load;      // [N/m or N] dead loads that act from the start
  Eigen::VectorXd scaled_load;        // [N/m or N] dead loads at load parameter 1
  // Before the first step, or empty for none: the stress of each particle, and the loads it is in
  // equilibrium with, the weight and its own traction on free sides [N/m or N].
  Eigen::Matrix<double, constitutive::stress_size<Dim>, Eigen::Dynamic> initial_stress;
  Eigen::VectorXd initial_load;
  // Of ground that stages change, in place of initial_stress: that of each particle at first.
  Eigen::Matrix<double, constitutive::stress_size<Dim>, Eigen::Dynamic> stress_at_rest;
  bool wall_bears = false;  // whether what the drive moves bears that stress from the first
  // [N/m or N] Of a wall whose particles are moved themselves: what it presses with at first.
  std::optional<fpm::Vector<Dim>> wall_force;
  fpm::Vector<Dim> box_min;  // [m]
  fpm::Vector<Dim> box_max;  // [m]
  double spacing = 0.0;      // [m] the finest
  // Of each plane of the ghosts; empty if none moves.
  std::vector<fpm::Vector<Dim>> plane_drive;    // [m] displacement at load parameter 1
  std::vector<fpm::Vector<Dim>> plane_held;     // [m] displacement whatever the load parameter
  std::vector<fpm::Vector<Dim>> plane_measure;  // weight of its reaction in the reported load
  std::vector<scene::Side> plane_side;          // of each plane, whether or not one moves
  std::vector<FollowingPressure<Dim>> following_pressures;
  std::vector<PenaltySupport<Dim>> penalty_supports;
  std::vector<Interface<Dim>> interfaces;
  std::vector<SurfacePiece<Dim>> surface;  // of a body with cutouts or regions only
  std::vector<JointPiece<Dim>> joints;     // of a body of regions only
  // Particles of one region that meet where cells between them have gone to one of them; likewise.
  std::vector<std::pair<fpm::Index, fpm::Index>> meeting;
  std::vector<JoinedFace> joined_faces;  // likewise
  std::vector<ThinLayer<Dim>> thin_layers;

  /// [Pa] Young's modulus of a particle.
  double youngs_modulus_of(Eigen::Index particle) const {
    return youngs_modulus[law[static_cast<std::size_t>(particle)]];
  }

  /// Number of points of supports by penalty whose targets are part of the state.
  Eigen::Index penalty_points() const;

  /// Number of plates that are free in some ways.
  Eigen::Index plates() const;

  /// Number of points of all interfaces.
  Eigen::Index interface_points() const;

  /// A point next to the body [m], by whose distance its coordinates lose no digits: the origin of
  /// the scene unless that is further away than the body is wide.
  fpm::Vector<Dim> nearby_origin() const;

  /// [m] Spacing of the particles around one.
  double spacing_at(Eigen::Index particle) const {
    return particles.spacing.size() > 0 ? particles.spacing[particle] : spacing;
  }

  Eigen::Index size() const { return particles.position.rows(); }
  Eigen::Index unknowns() const { return size() * Dim; }
};

template <int Dim>
Eigen::Index Model<Dim>::interface_points() const {
  Eigen::Index count = 0;
  for (const Interface<Dim>& interface : interfaces) count += interface.faces.points.size();
  return count;
}

template <int Dim>
Eigen::Index Model<Dim>::plates() const {
  Eigen::Index count = 0;
  for (const Interface<Dim>& interface : interfaces) count += interface.plate ? 1 : 0;
  return count;
}

// Where stages change the ground one may begin when the ground has moved.
template <int Dim>
Eigen::Index Model<Dim>::penalty_points() const {
  Eigen::Index count = 0;
  for (const PenaltySupport<Dim>& support : penalty_supports) {
    if (layout.staged) count += support.points.weight.size();
  }
  return count;
}

template <int Dim>
fpm::Vector<Dim> Model<Dim>::nearby_origin() const {
  fpm::Vector<Dim> origin = fpm::Vector<Dim>::Zero();
  for (int i = 0; i < Dim; ++i) {
    const double width = box_max[i] - box_min[i];
    if (box_min[i] > width || box_max[i] < -width) origin[i] = box_min[i];
  }
  return origin;
}

}  // namespace model

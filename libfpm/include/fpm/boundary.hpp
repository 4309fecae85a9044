#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fpm/cells.hpp"
#include "fpm/ghosts.hpp"
#include "fpm/particles.hpp"
#include "fpm/points.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// A face of an axis-parallel box.
struct Face {
  int axis = 0;        ///< the axis it is normal to: 0, 1 or 2
  bool upper = false;  ///< at the box's upper end of that axis; its outward normal points up it

  bool operator==(const Face&) const = default;
};

/// The 2 Dim faces of a box: lower and upper of the first axis, then of the second ...
template <int Dim>
std::vector<Face> all_faces();

/// Points that stand for a piece of the boundary each, in the reference configuration.
template <int Dim>
struct BoundaryPoints {
  Field<Dim> position = Field<Dim>(0, Dim);  ///< [m] m x Dim
  Field<Dim> normal = Field<Dim>(0, Dim);    ///< [-] m x Dim, outward unit normals
  Eigen::VectorXd weight;                    ///< [m^(Dim-1)] m, areas; per unit thickness in 2D

  Index size() const { return static_cast<Index>(weight.size()); }
  /// Appends the points of another piece.
  void append(const BoundaryPoints& other);
};

/// A part of a box's face, and how finely to cover it.
template <int Dim>
struct BoundaryQuadratureOptions {
  Vector<Dim> min = Vector<Dim>::Zero();  ///< [m] lower corner of the box
  Vector<Dim> max = Vector<Dim>::Ones();  ///< [m] upper corner of the box, > min
  double spacing = 0.1;                   ///< [m] > 0, that of the particles
  Face face = {};
  /// [m] The part of the face to cover, clipped to the face; the entry along `face.axis` is
  /// ignored.
  Vector<Dim> range_min = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity());
  Vector<Dim> range_max = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
  /// [-] >= 1: the cells of the midpoint rule are spacing / points_per_spacing wide. Its error on a
  /// smooth traction is (spacing / points_per_spacing)^2 / 24 times the second derivative.
  int points_per_spacing = 2;
};

/// What is wrong with the options; empty if nothing is.
template <int Dim>
std::vector<std::string> validate(const BoundaryQuadratureOptions<Dim>& options);

/// Midpoint rule on a part of a face. The cells start at the box's corner and those at the ends of
/// the range are cut, so linear functions (area and first moment with them) are integrated to
/// round-off whether the range fits the spacing or not.
/// @throws std::invalid_argument with every message of `validate` if there is one.
template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(const BoundaryQuadratureOptions<Dim>& options);

/// `boundary_quadrature` of several whole faces of one box, in their order.
template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(BoundaryQuadratureOptions<Dim> options,
                                        const std::vector<Face>& faces);

/// `boundary_quadrature` of a part of a face of the box that cells fill, by the spacing at each
/// cell of the face.
/// @param range_min, range_max  [m] as in the options
/// @throws std::invalid_argument if there is no such face or the range misses it.
template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(
    const Cells<Dim>& cells, const Face& face,
    const Vector<Dim>& range_min = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity()),
    const Vector<Dim>& range_max = Vector<Dim>::Constant(std::numeric_limits<double>::infinity()));

/// Boundary particles as quadrature points.
template <int Dim>
struct TributaryPoints {
  BoundaryPoints<Dim> points;
  std::vector<Index> particle;  ///< the particle each point is; for PointOperator::at_particles
};

/// The particles of a vertex lattice on a face, each with the part of the face (and of the range,
/// if one is given) that is nearer to it than to the others. The areas sum to that of the clipped
/// range. With them and `tributary_area_vectors` in the consistency correction, a uniform traction
/// is in equilibrium with the constant stress it stands for (the force patch test is exact).
/// @throws std::invalid_argument unless the lattice is a vertex lattice without jitter and the
///   range meets the face.
template <int Dim>
TributaryPoints<Dim> tributary_points(
    const LatticeOptions<Dim>& lattice, Face face,
    const Vector<Dim>& range_min = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity()),
    const Vector<Dim>& range_max = Vector<Dim>::Constant(std::numeric_limits<double>::infinity()));

/// Area vectors of a vertex lattice for the consistency correction: each boundary particle's
/// tributary area times the outward normal, summed over its faces, n x Dim.
///
/// Over all faces, sum s = 0 and sum s x X = |Omega| I to round-off. `faces` leaves out planes of
/// symmetry.
/// @throws std::invalid_argument unless the lattice is a vertex lattice without jitter.
template <int Dim>
Field<Dim> tributary_area_vectors(const LatticeOptions<Dim>& lattice,
                                  const std::vector<Face>& faces = all_faces<Dim>());

/// Area vectors of any set for the consistency correction, s_b = sum_c N_cb n_c w_c, n x Dim.
///
/// If the points cover the whole boundary, sum s = 0 and sum s x X = |Omega| I to round-off,
/// because N reproduces linear fields. Faces on planes of symmetry are left out of the points.
/// @throws ShapeError if sizes disagree.
template <int Dim>
Field<Dim> area_vectors(const PointOperator<Dim>& points, const BoundaryPoints<Dim>& boundary);

}  // namespace fpm

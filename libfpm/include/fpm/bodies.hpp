#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "fpm/boundary.hpp"
#include "fpm/cells.hpp"
#include "fpm/particles.hpp"
#include "fpm/points.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// Bodies of a set: its cells with equal labels that share faces, and those whose labels are
/// `joined`.
/// @param label  of each particle
/// @param joined  whether cells with two different labels, the smaller first, are of one body
/// @param thickness  [cells] a body that is thinner than that, along any axis, everywhere
///   joins its neighbours: rows of its own would be singular
/// @param meeting  pairs of cells that meet though they share no face, as if they did
/// @returns a body for each particle, numbered by first appearance; jitter does not matter.
/// @throws ShapeError if there is not one label per particle.
template <int Dim>
std::vector<Index> bodies_of(const Cells<Dim>& cells, const std::vector<Index>& label,
                             const std::function<bool(Index, Index)>& joined, Index thickness,
                             const std::vector<std::pair<Index, Index>>& meeting = {});

/// The same of particles around which there are no cells, however thin their bodies.
/// @param meeting  pairs of particles whose elements share a face
std::vector<Index> bodies_of(const std::vector<Index>& label,
                             const std::vector<std::pair<Index, Index>>& meeting,
                             const std::function<bool(Index, Index)>& joined);

/// Of each body, whether it is so thin that `bodies_of` joins it to its neighbours.
/// @param body  of each particle, numbered from 0
/// @throws ShapeError if there is not one body per particle.
template <int Dim>
std::vector<bool> thin_bodies(const Cells<Dim>& cells, const std::vector<Index>& body,
                              Index thickness);

/// Points where two bodies meet, one per particle and face: more of them than particles would lock
/// a body that flows.
template <int Dim>
struct CommonFaces {
  BoundaryPoints<Dim> points;  ///< normals from the first body into the second
  std::vector<Index> first;    ///< particle whose cell is on the first side of each point
  std::vector<Index> second;   ///< ... on the second
};

/// The faces that cells of different bodies share; of two cells' the narrower's.
/// @throws ShapeError if there is not one body per particle.
template <int Dim>
CommonFaces<Dim> common_faces(const Cells<Dim>& cells, const std::vector<Index>& body);

/// One point on the outer face of each cell at a face of the box, in the order of the particles:
/// `first` only.
template <int Dim>
CommonFaces<Dim> outer_faces(const Cells<Dim>& cells, const Face& face);

/// Two bodies that meet at points, or one and a rigid one.
template <int Dim>
struct Interface {
  BoundaryPoints<Dim> points;  ///< normals out of the first body
  PointOperator<Dim> first;
  PointOperator<Dim> second;  ///< of size 0: the other body is rigid

  /// [m] Displacement of the second body relative to the first at one point.
  /// @param motion  [m] of a rigid second body
  Vector<Dim> gap(Index point, const FieldView<Dim>& displacement,
                  const Vector<Dim>& motion) const {
    const Vector<Dim> other = second.size() > 0 ? second.value(point, displacement) : motion;
    return other - first.value(point, displacement);
  }

  /// Adds the forces of a traction that acts on the first body, and against the second, to those
  /// *by* the bodies: minus and plus weight N traction.
  void add_force(Index point, const Vector<Dim>& traction, FieldTarget<Dim> force) const {
    const Vector<Dim> on_first = points.weight[point] * traction;
    first.add_transposed_value(point, -on_first, force);
    if (second.size() > 0) second.add_transposed_value(point, on_first, force);
  }
};

}  // namespace fpm

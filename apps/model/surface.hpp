#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "fpm/bodies.hpp"
#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Cuts the cells and the particles of a plane body with cutouts: a particle is at the centroid of
/// what is left of its cell and stands for its area. What is left of a cell and too small for a
/// particle of its own goes to a cell beside it. Fills `model.surface` with the pieces of the
/// surface, each within one cell.
template <int Dim>
void cut_body(const scene::Scene& scene, Model<Dim>& model);

/// A part of the surface: what a cutout left, by its index, or what is left of a face of the box,
/// within a range along it.
struct SurfacePart {
  std::optional<std::size_t> cutout;
  fpm::Face face{};
  double from = -std::numeric_limits<double>::infinity();  // [m] along a face
  double to = std::numeric_limits<double>::infinity();

  /// Number of a face in `SurfacePiece::source`.
  static int source_of(const fpm::Face& face) { return -1 - 2 * face.axis - (face.upper ? 1 : 0); }
};

/// Points on a part of the surface, and the operator between them and the particles.
template <int Dim>
struct SurfacePoints {
  fpm::PointOperator<Dim> op;
  fpm::BoundaryPoints<Dim> points;
};

/// Points on a part of the surface, at least two to a spacing, as quadrature wants them.
template <int Dim>
SurfacePoints<Dim> surface_points(const Model<Dim>& model, const SurfacePart& part);

/// One per particle and straight piece, as a contact wants them.
template <int Dim>
fpm::CommonFaces<Dim> surface_faces(const Model<Dim>& model, const SurfacePart& part);

}  // namespace model

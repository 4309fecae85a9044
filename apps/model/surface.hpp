#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "fpm/bodies.hpp"
#include "model/model.hpp"

namespace model {

/// `SurfacePiece::side` of a piece that was next to a region that is not there.
inline constexpr int exposed_side = -2;

/// A part of the surface: what a cutout left, a side of the scene, what is left of a face of the
/// box, within a range along it, or what was next to a region that is not there.
struct SurfacePart {
  enum class Of { cutout, side, face, exposed };
  Of of = Of::cutout;
  int index = 0;
  // [m] Of a face what counts, along its axes.
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> from{-infinity, -infinity, -infinity}, to{infinity, infinity, infinity};
  // Of a side, what does not count: its pieces on each face of the box, and those on none.
  std::array<bool, 7> without{};

  static SurfacePart of_cutout(std::size_t i) { return {Of::cutout, static_cast<int>(i)}; }
  static SurfacePart of_side(std::size_t i) { return {Of::side, static_cast<int>(i)}; }
  static SurfacePart of_exposed() { return {Of::exposed, 0}; }
  static constexpr std::size_t no_face = 6;
  static SurfacePart of_face(const fpm::Face& face) {
    return {Of::face, 2 * face.axis + (face.upper ? 1 : 0)};
  }
};

/// Points on a part of the surface, and the operator between them and the particles.
template <int Dim>
struct SurfacePoints {
  fpm::PointOperator<Dim> op;
  fpm::BoundaryPoints<Dim> points;
};

/// How many points `surface_points` has on a piece, evenly along it: at least two to a spacing.
int point_count(const Model<2>& model, const SurfacePiece<2>& piece);

/// Points on a part of the surface, at least two to a spacing, as quadrature wants them.
template <int Dim>
SurfacePoints<Dim> surface_points(const Model<Dim>& model, const SurfacePart& part);

/// One per particle and straight piece, as a contact wants them.
template <int Dim>
fpm::CommonFaces<Dim> surface_faces(const Model<Dim>& model, const SurfacePart& part);

/// One per piece of the joints at which two bodies of particles meet.
template <int Dim>
fpm::CommonFaces<Dim> joint_faces(const Model<Dim>& model);

}  // namespace model

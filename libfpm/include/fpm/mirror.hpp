#pragma once

#include <vector>

#include "fpm/types.hpp"

namespace fpm {

/// A plane of symmetry, normal to a coordinate axis.
struct SymmetryPlane {
  int axis = 0;           ///< 0, 1 or 2: the axis the plane is normal to
  double position = 0.0;  ///< [m] coordinate of the plane on that axis
};

/// Mirror images of the particles near planes of symmetry, appended to the set as ghosts.
///
/// A ghost has no row of its own: it serves real rows as a neighbour. With E the linear map that
/// extends a nodal field to the ghosts, strains are W E u and forces E^T W^T S, so the half model
/// is exactly the symmetric full one.
/// (A particle on the plane has no image and keeps the volume it is given, so a vertex lattice cut
/// at a plane is only close to the full one.)
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mirror-ghosts.md).
template <int Dim>
class MirrorGhosts {
 public:
  MirrorGhosts() = default;

  /// Ghosts of all particles closer than `reach` to a plane (and, where two planes meet, the
  /// images of images). The reach is that of the widest support, max_enlargement times the usual
  /// one, and less than the distance of two parallel planes. A particle on the plane itself (within
  /// 1e-9 reach) has no image.
  MirrorGhosts(const Field<Dim>& position, const std::vector<SymmetryPlane>& planes, double reach);

  Index size() const { return static_cast<Index>(source_.size()); }

  /// Particle whose image ghost g is.
  Index source(Index g) const { return source_[static_cast<std::size_t>(g)]; }

  /// Value of a vector field (n x Dim) at ghost g: its normal component changes sign.
  Vector<Dim> image(const Field<Dim>& field, Index g) const {
    const auto k = static_cast<std::size_t>(g);
    return sign_[k].cwiseProduct(field.row(source_[k]).transpose());
  }

  /// Sign of component i at ghost g, relative to its source.
  double sign(Index g, int i) const { return sign_[static_cast<std::size_t>(g)][i]; }

  /// Appends the image positions: rows [n, n + size()) of `extended` from rows [0, n).
  /// The columns are `stride` apart in memory.
  void extend_positions(double* extended, Eigen::Index n, Eigen::Index stride) const;

  /// Appends the images of a vector field (its normal component changes sign).
  void extend_vectors(double* extended, Eigen::Index n, Eigen::Index stride) const;

  /// The transposed map: adds the ghosts' forces to their sources, in order of the ghosts.
  void fold_forces(double* extended, Eigen::Index n, Eigen::Index stride) const;

 private:
  std::vector<Index> source_;
  std::vector<Vector<Dim>> sign_;    // +1 or -1 per component
  std::vector<Vector<Dim>> offset_;  // image position = sign * position + offset
};

}  // namespace fpm

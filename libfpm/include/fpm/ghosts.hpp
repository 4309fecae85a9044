#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "fpm/types.hpp"

namespace fpm {

/// A plane normal to a coordinate axis, or a part of one, behind which images of the particles
/// continue the body.
///
/// In a held direction the plane's displacement is given, v, and an image moves by 2 v - u of its
/// source: the plane itself moves by v, whatever the strain. In the others it moves as its source.
/// Held in its normal direction alone and at rest, the plane is one of symmetry.
template <int Dim>
struct GhostPlane {
  int axis = 0;           ///< 0 ... Dim - 1: the axis the plane is normal to
  double position = 0.0;  ///< [m] coordinate of the plane on that axis
  std::array<bool, static_cast<std::size_t>(Dim)> held{};  ///< by direction
  /// [m] The part of the plane that has images (the entry of its own axis does not matter). Rows
  /// of particles beside that part do not see them.
  Vector<Dim> range_min = Vector<Dim>::Constant(-std::numeric_limits<double>::infinity());
  Vector<Dim> range_max = Vector<Dim>::Constant(std::numeric_limits<double>::infinity());
  /// The images are the other half of the body, which is not modelled, and no support of it: they
  /// take part in what is interpolated at points (points.hpp).
  bool symmetry = false;

  bool has_range() const {
    return range_min.maxCoeff() > -infinity || range_max.minCoeff() < infinity;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// A plane of symmetry.
template <int Dim>
GhostPlane<Dim> symmetry_plane(int axis, double position);

/// Images of the particles near planes, appended to the set as ghosts.
///
/// A ghost has no row of its own: it serves real rows as a neighbour. With E the linear map that
/// extends a nodal field to the ghosts, and c what the planes' own motion adds to it, strains are
/// W (E u + c) and forces E^T W^T S. So a half model is exactly the symmetric full one, and a body
/// is held at a plane face as if it went on there with the strain it has.
/// (A particle on the plane has no image and keeps the volume it is given, so a vertex lattice cut
/// at a plane is only close to the full one; where the plane is held its displacement is given.)
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/mirror-ghosts.md,
/// held-planes.md).
template <int Dim>
class Ghosts {
 public:
  Ghosts() = default;

  /// Ghosts of all particles closer than `reach` to a plane and within its range (and, where two
  /// planes meet, the images of images, made by the later of the two: planes with a range come
  /// first). The reach is that of the widest support, max_enlargement times the usual one, and less
  /// than the distance of two parallel planes. A particle on the plane itself (within 1e-9 reach)
  /// has no image.
  /// @throws std::invalid_argument if an axis does not exist.
  Ghosts(const Field<Dim>& position, const std::vector<GhostPlane<Dim>>& planes, double reach)
      : Ghosts(position, planes, Eigen::VectorXd::Constant(position.rows(), reach)) {}

  /// The same with a reach [m] of each particle (`make_ghosts` of rows.hpp finds it).
  /// @throws std::invalid_argument as above; ShapeError if sizes disagree.
  Ghosts(const Field<Dim>& position, const std::vector<GhostPlane<Dim>>& planes,
         const Eigen::VectorXd& reach);

  Index size() const { return static_cast<Index>(source_.size()); }
  const std::vector<GhostPlane<Dim>>& planes() const { return planes_; }

  /// Particle whose image ghost g is.
  Index source(Index g) const { return source_[static_cast<std::size_t>(g)]; }

  /// Particles that have an image by a plane, ascending.
  std::vector<Index> sources_of(std::size_t plane) const;

  /// Value of a vector field (n x Dim) that vanishes in the held directions at ghost g: the
  /// components of those directions change sign.
  Vector<Dim> image(const Field<Dim>& field, Index g) const {
    const auto k = static_cast<std::size_t>(g);
    return sign_[k].cwiseProduct(field.row(source_[k]).transpose());
  }

  /// Sign of component i at ghost g, relative to its source.
  double sign(Index g, int i) const { return sign_[static_cast<std::size_t>(g)][i]; }

  /// Whether all planes that made ghost g are planes of symmetry.
  bool by_symmetry(Index g) const;
  /// Whether all planes that made ghost g are among some.
  /// @param some  for each plane, whether it is
  bool made_by(Index g, const std::vector<char>& some) const;

  /// Whether a row whose particle is at `x` may have ghost g as a neighbour: it lies within the
  /// ranges of the planes that made it.
  /// @param motion  [m] displacement of each plane, or empty for none
  bool visible_from(const Vector<Dim>& x, Index g,
                    const std::vector<Vector<Dim>>& motion = {}) const;

  /// Whether ghost g still stands for its source, now at `x`: a particle that has left from behind
  /// a part of a plane, along it or past it, has no image there.
  bool stands_for(const Vector<Dim>& x, Index g, const std::vector<Vector<Dim>>& motion = {}) const;

  /// What displacements of the planes add to the displacements of the ghosts, size() x Dim.
  /// @param motion  [m] of each plane; components that are not held do not matter
  /// @throws ShapeError if there is not one for each plane.
  Field<Dim> of_motion(const std::vector<Vector<Dim>>& motion) const;

  /// The transposed map: the force by which each plane holds the body, in the held directions.
  /// @param extended  forces on the nodes; rows [n, n + size()), the ghosts', are read
  /// @param[out] force  one per plane; nothing is allocated if it has that size
  void plane_forces(const double* extended, Eigen::Index n, Eigen::Index stride,
                    std::vector<Vector<Dim>>& force) const;

  /// The same for one plane by particle: what each particle's images carry onto it is added to the
  /// particle's row.
  void add_reactions(std::size_t plane, const double* extended, Eigen::Index n, Eigen::Index stride,
                     Field<Dim>& reaction) const;

  /// Appends the image positions: rows [n, n + size()) of `extended` from rows [0, n); planes are
  /// where they were at first. The columns are `stride` apart in memory.
  void extend_positions(double* extended, Eigen::Index n, Eigen::Index stride) const;

  /// Appends the images of a vector field (components of held directions change sign).
  void extend_vectors(double* extended, Eigen::Index n, Eigen::Index stride) const;

  /// The transposed map: adds the ghosts' forces to their sources, in order of the ghosts.
  void fold_forces(double* extended, Eigen::Index n, Eigen::Index stride) const;

 private:
  // What made a ghost, plane by plane: c += factor * motion of the plane, component by component.
  struct Share {
    std::size_t plane;
    Vector<Dim> factor;
    double side;  // of the plane that the source is on: -1 or 1
  };
  std::span<const Share> shares(Index g) const;
  bool within(const GhostPlane<Dim>& plane, const Vector<Dim>& x, const Vector<Dim>& motion) const;

  std::vector<GhostPlane<Dim>> planes_;
  std::vector<Index> source_;
  std::vector<Vector<Dim>> sign_;    // +1 or -1 per component
  std::vector<Vector<Dim>> offset_;  // image position = sign * position + offset
  std::vector<Share> share_;
  std::vector<std::size_t> share_begin_{0};
  double slack_ = 0.0;  // [m] round-off of a place beside the end of a range
};

}  // namespace fpm

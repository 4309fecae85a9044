#pragma once

#include <cstdint>
#include <vector>

#include "fpm/types.hpp"

namespace fpm {

/// A set of particles: where they are and what volume each stands for.
template <int Dim>
struct ParticleSet {
  Field<Dim> position;     ///< [m] n x Dim
  Eigen::VectorXd volume;  ///< [m^Dim] n; per unit thickness in 2D
  /// Body that each belongs to, or empty: one body. Neighbours are of one body (bodies.hpp).
  std::vector<Index> body = {};
  /// [m] Spacing of the particles around each, or empty: the same for all (cells.hpp).
  Eigen::VectorXd spacing = {};

  Index size() const { return static_cast<Index>(position.rows()); }
};

/// Where the particles of a lattice sit in their box.
enum class LatticeLayout {
  cell,    ///< at cell centres; all volumes are equal
  vertex,  ///< at cell corners, so also on the boundary; boundary volumes are halved per face
};

/// A regular lattice in a box, row by row (x fastest), so that neighbouring rows of the operator
/// share their stencil.
template <int Dim>
struct LatticeOptions {
  Vector<Dim> min = Vector<Dim>::Zero();  ///< [m] lower corner of the box
  Vector<Dim> max = Vector<Dim>::Ones();  ///< [m] upper corner of the box
  double spacing = 0.1;                   ///< [m] > 0; every extent is a whole multiple of it
  LatticeLayout layout = LatticeLayout::cell;
  double jitter = 0.0;     ///< [-] 0..0.45: particles move by up to jitter * spacing per component;
                           ///< those of a vertex lattice keep to the faces they lie on
  std::uint64_t seed = 1;  ///< of the jitter; the same seed gives the same set on every machine
};

/// Number of lattice cells along each axis.
/// @throws std::invalid_argument unless each extent is a whole multiple of the spacing (to 1e-6).
template <int Dim>
Eigen::Matrix<Index, Dim, 1> lattice_cells(const LatticeOptions<Dim>& options);

/// The particles of a lattice; the volumes sum to that of the box.
/// @throws std::invalid_argument on options outside their range.
template <int Dim>
ParticleSet<Dim> make_lattice(const LatticeOptions<Dim>& options);

}  // namespace fpm

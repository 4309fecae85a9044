#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "fpm/particles.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// The spacing [m] wanted in a part of space: the smallest over the box between two corners.
template <int Dim>
using WantedSpacing = std::function<double(const Vector<Dim>& lower, const Vector<Dim>& upper)>;

/// The cells around the particles of a set in a box, one each, in the particles' order: those of a
/// lattice, or of a tree.
///
/// The cells of a tree (a quadtree, in space an octree) are squares (cubes) of 1, 2, 4, ... of the
/// finest spacings; no cell touches one more than twice or less than half as wide, at corners
/// neither. They are sorted by width, the finest first, then as in a lattice, so that rows of equal
/// neighbourhoods follow each other.
/// Departure: Chen, Huang & Lyamin 2020 use one spacing (share/doc/decisions/graded-particles.md).
template <int Dim>
class Cells {
 public:
  using Place = Eigen::Matrix<Index, Dim, 1>;

  Cells() = default;

  /// Those of a lattice. The cell of a particle of a vertex lattice is what is nearer to it than to
  /// the others.
  /// @throws std::invalid_argument as `lattice_cells` does
  explicit Cells(const LatticeOptions<Dim>& lattice);

  /// Those of a tree: as wide as `wanted` allows, the box and the neighbours permitting.
  /// @param finest  the lattice of the narrowest cells, whose spacing is a floor to what is wanted;
  ///   of the layout `cell`
  /// @throws std::invalid_argument as `lattice_cells` does, on another layout, and if the box is
  ///   more than 2^19 (2^29 in the plane) finest spacings wide
  Cells(const LatticeOptions<Dim>& finest, const WantedSpacing<Dim>& wanted);

  /// A tree of cells that are each up to 2^levels times as wide as the narrowest of this set
  /// inside.
  /// @throws std::invalid_argument on a vertex lattice
  Cells coarsened(int levels) const;

  /// The cells of a tree that are left where a part of the box is cut away.
  /// @param owner  of each cell, the cell that stands for it: itself, one beside it, which takes
  /// over
  ///   what is left of it, or -1 for none. An owner owns itself.
  /// @throws std::invalid_argument unless this is a tree; ShapeError if an owner is none.
  Cells restricted(const std::vector<Index>& owner) const;

  /// The lattice, or that of the finest cells.
  const LatticeOptions<Dim>& lattice() const { return lattice_; }
  /// Whether cells differ in width.
  bool graded() const { return graded_; }
  Index size() const { return graded_ ? static_cast<Index>(place_.size()) : count_.prod(); }

  /// Spacing of the particles around [m]: the width of a cell that no face of the box cuts.
  double width(Index cell) const { return steps(cell) * lattice_.spacing; }
  Vector<Dim> lower(Index cell) const;  ///< [m] lower corner
  Vector<Dim> upper(Index cell) const;  ///< [m] upper corner
  Vector<Dim> site(Index cell) const;   ///< [m] its particle's place, but for the jitter

  /// The cell that a point of the box is in or that took it over; of a point outside the box that
  /// of the nearest point within, and -1 where the box is cut away.
  Index containing(const Vector<Dim>& point) const;

  /// A cell that shares a face with another: the first of them if there are several; -1 at a face
  /// of the box.
  Index beside(Index cell, int axis, bool upper) const;

  /// Calls visit(low, high, axis) for all cells that share a face, `low` being below along `axis`;
  /// the face is that of the narrower.
  template <class Visitor>
  void for_each_pair(Visitor&& visit) const {
    for (Index a = 0; a < size(); ++a) {
      for (int i = 0; i < Dim; ++i) {
        const Index below = beside(a, i, false), above = beside(a, i, true);
        // Of several narrower cells each has this one beside it, and so has each that is beside
        // what this one has taken over.
        if (below >= 0 && (width(below) > width(a) || beside(below, i, true) != a)) {
          visit(below, a, i);
        }
        if (above >= 0 && width(above) >= width(a)) visit(a, above, i);
      }
    }
  }

  /// Lower corner of a cell in finest spacings from that of the box.
  Place place(Index cell) const;
  /// Width of a cell in finest spacings.
  Index steps(Index cell) const {
    return graded_ ? Index{1} << level_[static_cast<std::size_t>(cell)] : 1;
  }
  /// The cell that holds a finest one, by its lower corner in finest spacings; -1 outside the box.
  Index holding(const Place& finest) const;

 private:
  bool vertex() const { return lattice_.layout == LatticeLayout::vertex; }
  template <class Split>
  void build(Split&& split);

  LatticeOptions<Dim> lattice_;
  Place count_ = Place::Zero();  // finest cells along each axis
  // Of a tree.
  bool graded_ = false;
  std::vector<Place> place_;
  std::vector<std::int8_t> level_;
  int top_level_ = 0;
  std::unordered_map<std::uint64_t, Index> index_;
};

/// The particles of cells: at their centres, moved by the lattice's jitter (times their own width),
/// or at the vertices of a vertex lattice. The volumes sum to that of the box.
/// @throws std::invalid_argument on options outside their range
template <int Dim>
ParticleSet<Dim> make_particles(const Cells<Dim>& cells);

}  // namespace fpm

#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// Which diagonals of a Jacobian are occupied, as far as single columns of it tell: few on lattices
/// and chains that are numbered node by node or field by field.
///
/// Indices lie on a ring, as the last unknown of a periodic system is the neighbour of the first:
/// the way from one to another is the shorter one.
class LatticePattern {
 public:
  /// Forgets everything; for n unknowns. The main diagonal is known.
  void reset(Eigen::Index n);

  /// A column as it was seen.
  struct Column {
    Eigen::Index index = 0;
    std::vector<Eigen::Index> offsets;  // row - index
  };
  /// Reads the rows that are occupied within a way of `half` from column j from a product that
  /// holds J e_j there; zero where F does not depend on the unknown.
  [[nodiscard]] Column read(Eigen::Index j, const Vector& product, Eigen::Index half) const;
  /// The longest way to an occupied row.
  [[nodiscard]] Eigen::Index width(const Column& column) const;
  /// Learns which diagonals are occupied; their mirror images count as well.
  /// @return whether any was new
  bool learn(const Column& column);

  /// The largest `width` so far.
  [[nodiscard]] Eigen::Index width() const { return width_; }
  /// How far from the main diagonal the outermost lies, in the matrix and not on the ring.
  [[nodiscard]] Eigen::Index reach() const {
    return std::max(-diagonals_.front(), diagonals_.back());
  }
  /// Lets it be that, or more.
  void widen(Eigen::Index width);

  /// Zeros on the occupied diagonals; symmetric in structure.
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const;

  /// Calls `walk` on every number that decides what is known, for saving and loading; `reset` must
  /// have been called.
  template <class Walker>
  void for_each_field(Walker& walk) {
    auto count = static_cast<std::int64_t>(diagonals_.size());
    walk(count);
    if (count < 1 || count > 2 * n_) count = 1;  // damaged, as the reader will find out
    diagonals_.resize(static_cast<std::size_t>(count));
    for (Eigen::Index& diagonal : diagonals_) {
      walk(diagonal);
      if (diagonal < -n_ || diagonal > n_) diagonal = 0;
    }
    walk(width_);
  }

 private:
  [[nodiscard]] Eigen::Index way(Eigen::Index offset) const;

  Eigen::Index n_ = 0;
  Eigen::Index width_ = 0;
  std::vector<Eigen::Index> diagonals_;  // row - column, ascending
};

}  // namespace jfnk::detail

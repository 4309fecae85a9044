#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk {

/// Diagonal blocks of a matrix, inverted: the preconditioner for unknowns that come in groups (the
/// displacements of a node, the species of a cell).
class BlockJacobi {
 public:
  /// Blocks of `block` unknowns one after the other.
  /// @throws std::invalid_argument if the matrix is not square or its size is no multiple of
  /// `block`
  BlockJacobi(const Eigen::SparseMatrix<double>& matrix, int block);
  /// Takes new values. A singular block becomes the identity.
  /// @throws std::invalid_argument if the size has changed
  void update(const Eigen::SparseMatrix<double>& matrix);
  /// z = D^-1 r.
  void apply(const Vector& r, Vector& z) const;
  /// Blocks that were singular at the last update.
  [[nodiscard]] int singular_blocks() const { return singular_; }

 private:
  int block_;
  int singular_ = 0;
  std::vector<Eigen::MatrixXd> inverse_;
};

}  // namespace jfnk

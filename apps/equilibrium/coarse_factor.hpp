#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace equilibrium {

/// Cholesky factor of a symmetric positive definite matrix, in single precision.
///
/// Where unknowns sorted along a body keep the factor close to its diagonal, as on grids of the
/// plane, each row is kept from its first entry on, in whole registers: more numbers than in a
/// sparse factor, but read in order. Elsewhere it is a sparse one, ordered for little fill.
class CoarseFactor {
 public:
  CoarseFactor() = default;
  /// @param matrix  n x n, both triangles
  /// @param sorted  the unknowns as sorted along the body, a permutation of 0 ... n - 1
  /// @throws std::runtime_error if the matrix is not positive definite
  CoarseFactor(const Eigen::SparseMatrix<double>& matrix, const std::vector<int>& sorted);

  /// x = A^-1 x. No allocation.
  void solve(Eigen::VectorXf& x);

  bool by_rows() const { return !rows_.first.empty(); }
  std::size_t bytes() const;

 private:
  // By rows: row i has the columns from first[i] to the end of the register that the diagonal is
  // in, zeros from the diagonal on; they are at begin[i].
  struct Rows {
    std::vector<std::size_t> begin;
    std::vector<int> first;
    std::vector<float> entries;
    std::vector<float> inverse_diagonal;
  };
  static Rows rows_of(const Eigen::SparseMatrix<float>& factor);
  static void sweep(const Rows& rows, float* x);

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_;
  Eigen::VectorXf work_;  // the unknowns in that order, then zeros
  Rows rows_;
  Eigen::SparseMatrix<float> sparse_;  // lower
};

}  // namespace equilibrium

#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace equilibrium {

/// Cholesky factor of a symmetric positive definite matrix, in single precision.
///
/// Where unknowns sorted along a body keep the factor close to its diagonal, as on grids of the
/// plane, each row is kept from its first entry on, in whole registers: more numbers than in a
/// sparse factor, but read in order. It is then eliminated from both ends of the body at once,
/// which meet in the middle: two threads share the work, and the bits are the same for any number.
/// Elsewhere it is a sparse one, ordered for little fill.
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
  /// Whether by rows from both ends.
  bool from_both_ends() const { return rows_.ends.front < rows_.ends.back; }
  std::size_t bytes() const;

 private:
  // Rows [0, front) are those of one end, [front, back) those of the other from its own end on, and
  // the rest, to which alone both are coupled, what is between; of these the columns below `front`
  // are kept apart. The front ends with a register, so that no row of it reaches into the back.
  struct Ends {
    int front = 0, back = 0;
    std::vector<std::size_t> begin;
    std::vector<int> first;
    std::vector<float> entries;
  };
  static Ends ends_of(const Eigen::SparseMatrix<double>& swept);
  // By rows: row i has the columns from first[i] to the end of the register that the diagonal is
  // in, zeros from the diagonal on; they are at begin[i].
  struct Rows {
    std::vector<std::size_t> begin;
    std::vector<int> first;
    std::vector<float> entries;
    std::vector<float> inverse_diagonal;
    Ends ends;
  };
  // What is done in one go. Down and up the triangle from either end; what is between in one.
  enum class Part { front_down, back_down, middle, back_up, front_up };
  static Rows rows_of(const Eigen::SparseMatrix<float>& factor, const Ends& ends);
  static void sweep(const Rows& rows, Part part, float* x);
  void sweep_all();

  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order_;
  Eigen::VectorXf work_;  // the unknowns in that order, then zeros
  Rows rows_;
  Eigen::SparseMatrix<float> sparse_;  // lower
};

}  // namespace equilibrium

#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// LU factors of a sparse matrix in the order it comes in, without pivoting, as one loop over the
/// rows of L and columns of U (Davis 2006, section 4.8, for two triangles at once).
///
/// For systems of some thousand unknowns this takes a third of the time of a supernodal method.
/// Whether the factors are any good is for the caller to find out.
class SymmetricLu {
 public:
  /// Where entries of the factors will be, by the elimination tree of A + A^T.
  void analyse(const Eigen::SparseMatrix<double>& A);
  /// Multiplications and additions of `factorise`, and the most that it pays for.
  [[nodiscard]] double operations() const { return operations_; }
  static constexpr double most_operations = 5e7;
  /// @param A  with the occupied entries that were analysed
  /// @return false if a pivot is zero or not finite
  [[nodiscard]] bool factorise(const Eigen::SparseMatrix<double>& A);
  /// z becomes A^-1 z.
  void solve(Vector& z) const;

 private:
  using Index = Eigen::Index;
  int reach_of(const Eigen::SparseMatrix<double>& pattern, int row);

  int n_ = 0;
  double operations_ = 0.0;
  Eigen::SparseMatrix<double> columns_;  // A, with zeros where only A^T has entries
  Eigen::SparseMatrix<double> rows_;     // its transpose
  std::vector<int> parent_;
  std::vector<int> met_;
  std::vector<int> path_;
  std::vector<int> reach_;  // columns of L with an entry in the row at hand, from the back
  std::vector<Index> begin_;
  std::vector<Index> end_;     // of a column so far
  std::vector<int> row_;       // of entries of L below the diagonal, by columns
  std::vector<double> lower_;  // L, of unit diagonal
  std::vector<double> upper_;  // U^T, likewise without its diagonal
  std::vector<double> pivot_;
  std::vector<double> x_;
  std::vector<double> y_;
};

}  // namespace jfnk::detail

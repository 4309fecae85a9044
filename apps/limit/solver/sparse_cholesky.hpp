#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace limit::solver {

/// Cholesky factors of sparse symmetric positive definite matrices of one pattern, by the
/// sequential MUMPS that Ipopt brings along.
class SparseCholesky {
 public:
  /// Orders the unknowns of the pattern.
  /// @param rows, columns  of the entries of the lower triangle, from 0, each once
  /// @throws std::runtime_error if MUMPS cannot, with its error code.
  SparseCholesky(int size, const std::vector<int>& rows, const std::vector<int>& columns);
  ~SparseCholesky();
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// Factorises the matrix with these entries, in the order of the pattern; false if it is not
  /// positive definite or there is no memory for it.
  [[nodiscard]] bool factorise(std::vector<double>& entries);

  /// Overwrites the right side with the solution. After a `factorise` that held.
  void solve(Eigen::VectorXd& right_side);

 private:
  struct Mumps;
  std::unique_ptr<Mumps> mumps_;
};

}  // namespace limit::solver

#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace limit::solver {

/// Factors of sparse symmetric matrices of one pattern, by the sequential MUMPS that Ipopt brings
/// along: Cholesky's of positive definite ones, or those of indefinite ones, with pivoting.
class SparseFactors {
 public:
  enum class Kind { positive_definite, indefinite };

  /// Orders the unknowns of the pattern.
  /// @param rows, columns  of the entries of the lower triangle, from 0, each once
  /// @throws std::runtime_error if MUMPS cannot, with its error code.
  SparseFactors(Kind kind, int size, const std::vector<int>& rows, const std::vector<int>& columns);
  ~SparseFactors();
  SparseFactors(const SparseFactors&) = delete;
  SparseFactors& operator=(const SparseFactors&) = delete;

  /// Factorises the matrix with these entries, in the order of the pattern; false if it is not
  /// as its kind is, or singular, or there is no memory for it.
  [[nodiscard]] bool factorise(std::vector<double>& entries);

  /// Overwrites the right side with the solution. After a `factorise` that held.
  void solve(Eigen::VectorXd& right_side);

  /// Of all factorisations and solutions so far, in operations, roughly: what they cost, by a
  /// measure that is the same each time.
  [[nodiscard]] double work() const { return work_; }

 private:
  struct Mumps;
  [[nodiscard]] double entries_in_factors() const;

  std::unique_ptr<Mumps> mumps_;
  double work_ = 0.0;
};

}  // namespace limit::solver

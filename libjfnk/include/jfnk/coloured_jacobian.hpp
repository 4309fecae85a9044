#pragma once

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>
#include <concepts>
#include <utility>
#include <vector>

#include "jfnk/residual.hpp"

namespace jfnk {

/// Which unknowns each component of F depends on; values have no meaning.
using Sparsity = Eigen::SparseMatrix<double>;

/// Colours of columns such that no two columns of one colour share a row (Curtis, Powell & Reid
/// 1974): greedy, columns with many rows first (Coleman & Moré 1983).
/// @return colour of each column, 0 and up
[[nodiscard]] std::vector<int> colour_columns(const Sparsity& sparsity);

/// Entries with row - lower <= column <= row + upper: systems on a line.
[[nodiscard]] Sparsity banded_sparsity(Eigen::Index n, Eigen::Index lower, Eigen::Index upper);

/// The Jacobian by coloured differences, factorised by sparse LU, as a preconditioner.
///
/// `setup(u)` costs colours() + 1 evaluations of F, which are the caller's to count: set
/// `Options::setup_cost` to that. Where F has no value at a probe the step changes its sign; where
/// it has none on either side the columns keep their former values (ones on the diagonal at first).
class ColouredJacobian {
 public:
  /// @param residual  must outlive this object
  /// @param sparsity  square, of F; must hold every entry of J that is not zero, else J is wrong
  /// @param noise  root of the relative error of F
  /// @throws std::invalid_argument if the sparsity is not square
  template <Residual F>
  requires(!std::same_as<F, ResidualRef>)
      ColouredJacobian(F& residual, const Sparsity& sparsity, double noise = 1.5e-8)
      : ColouredJacobian(ResidualRef(residual), sparsity, noise) {}
  ColouredJacobian(const ResidualRef& residual, const Sparsity& sparsity, double noise = 1.5e-8);

  /// Differences F about u and factorises.
  void setup(const Vector& u);
  /// z = J^-1 r; z = r before `setup`, and where the factorisation failed.
  void apply(const Vector& r, Vector& z) const;

  /// Groups of columns that are differenced together.
  [[nodiscard]] int colours() const { return colours_; }
  /// Evaluations of F so far.
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// The Jacobian of the last `setup`.
  [[nodiscard]] const Eigen::SparseMatrix<double>& matrix() const { return matrix_; }
  /// Whether the last factorisation succeeded.
  [[nodiscard]] bool factorised() const { return factorised_; }

 private:
  bool evaluate(const Vector& u, Vector& r);

  ResidualRef residual_;
  Eigen::SparseMatrix<double> matrix_;
  std::vector<int> colour_of_;
  int colours_ = 0;
  double noise_;
  int evaluations_ = 0;
  bool factorised_ = false;
  Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace jfnk

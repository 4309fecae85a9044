#include "limit/algebra/least_change.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <stdexcept>

namespace limit::algebra {

namespace {

Eigen::VectorXd residual_of(const Eigen::SparseMatrix<double, Eigen::RowMajor>& equations,
                            const Eigen::VectorXd& right_side, const Eigen::VectorXd& x) {
  Eigen::VectorXd residual(right_side.size());
  for (Eigen::Index i = 0; i < equations.rows(); ++i) {
    long double sum = right_side[i];
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(equations, i); entry;
         ++entry) {
      sum -= static_cast<long double>(entry.value()) * static_cast<long double>(x[entry.col()]);
    }
    residual[i] = static_cast<double>(sum);
  }
  return residual;
}

}  // namespace

double satisfy(const Eigen::SparseMatrix<double, Eigen::RowMajor>& equations,
               const Eigen::VectorXd& right_side, Eigen::VectorXd& x) {
  if (equations.rows() == 0) return 0.0;
  Eigen::SparseMatrix<double> normal =
      equations * Eigen::SparseMatrix<double>(equations.transpose());
  // Small against all but the zero eigenvalues of dependent equations; the repetition below makes
  // up for it.
  constexpr double shift = 1e-9;
  for (Eigen::Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += shift;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  if (solver.info() != Eigen::Success) throw std::runtime_error("least change: no factorisation");
  double least = INFINITY;
  Eigen::VectorXd best = x;
  constexpr int most_repetitions = 30;
  for (int i = 0; i < most_repetitions; ++i) {
    const Eigen::VectorXd residual = residual_of(equations, right_side, x);
    const double largest = residual.lpNorm<Eigen::Infinity>();
    if (!(largest < 0.5 * least) && i > 2) break;
    if (largest < least) {
      least = largest;
      best = x;
    }
    x += equations.transpose() * solver.solve(residual);
  }
  x = best;
  return least;
}

}  // namespace limit::algebra

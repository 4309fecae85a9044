#include "learnt_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "jfnk/coloured_jacobian.hpp"

namespace jfnk::detail {
namespace {

/// Whether a row or a column is empty. Eigen's SparseLU (3.4) does not return if all but all are.
bool has_gap(const Eigen::SparseMatrix<double>& matrix) {
  std::vector<bool> occupied(static_cast<std::size_t>(matrix.rows()), false);
  for (int column = 0; column < matrix.outerSize(); ++column) {
    Eigen::SparseMatrix<double>::InnerIterator it(matrix, column);
    if (!it) return true;
    for (; it; ++it) occupied[static_cast<std::size_t>(it.row())] = true;
  }
  return std::find(occupied.begin(), occupied.end(), false) != occupied.end();
}

bool same_pattern(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
  const auto same = [](const int* one, const int* other, Eigen::Index count) {
    return std::equal(one, one + count, other);
  };
  return a.cols() == b.cols() && a.nonZeros() == b.nonZeros() && a.isCompressed() &&
         b.isCompressed() && same(a.outerIndexPtr(), b.outerIndexPtr(), a.outerSize() + 1) &&
         same(a.innerIndexPtr(), b.innerIndexPtr(), a.nonZeros());
}

int number_of(const std::vector<int>& groups) {
  return *std::max_element(groups.begin(), groups.end()) + 1;
}

}  // namespace

void LearntJacobian::reset(Eigen::Index n) {
  n_ = n;
  pattern_.reset(n);
  group_of_.clear();
  groups_ = 0;
  matrix_.resize(0, 0);
  occupied_.resize(0, 0);
  shift_ = 0.0;
}

void LearntJacobian::group_columns() {
  matrix_ = pattern_.matrix();
  group_of_ = colour_columns(matrix_);
  groups_ = number_of(group_of_);
}

int LearntJacobian::groups_to_come() const {
  return number_of(colour_columns(pattern_.matrix()));
}

void LearntJacobian::write_group(int group, Vector& v) const {
  for (Eigen::Index i = 0; i < n_; ++i) {
    v[i] = group_of_[static_cast<std::size_t>(i)] == group ? 1.0 : 0.0;
  }
}

void LearntJacobian::read_group(int group, const Vector& product) {
  for (int column = 0; column < matrix_.outerSize(); ++column) {
    if (group_of_[static_cast<std::size_t>(column)] != group) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it) {
      it.valueRef() = product[it.row()];
    }
  }
}

bool LearntJacobian::factorise(double shift) {
  shift_ = shift;
  Eigen::SparseMatrix<double> shifted = matrix_;
  for (int i = 0; i < n_; ++i) shifted.coeffRef(i, i) += shift;
  // Diagonals that are occupied here and there only would fill the factors.
  Eigen::SparseMatrix<double> occupied = shifted.pruned();
  if (has_gap(occupied)) return false;
  const bool same = same_pattern(occupied, occupied_);
  occupied_.swap(occupied);
  if (!same) order_ = order_of_elimination(occupied_);
  eliminated_ = occupied_.twistedBy(order_.inverse());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_rows = eliminated_;
  eliminated_ = by_rows;  // sorted by that
  if (!same) {
    plain_.analyse(eliminated_);
    analysed_ = false;
  }
  by_plain_ = factorise_plainly();
  if (by_plain_) return true;
  if (!std::exchange(analysed_, true)) {
    // The order suits a matrix that is symmetric in structure with its pivots on the diagonal.
    constexpr double least_pivot = 0.1;  // of the largest in its column
    factors_.setPivotThreshold(least_pivot);
    factors_.analyzePattern(eliminated_);
  }
  factors_.factorize(eliminated_);
  return factors_.info() == Eigen::Success;
}

/// Factors without pivoting, if they solve a system to many digits.
bool LearntJacobian::factorise_plainly() {
  constexpr double good = 1e-10;  // backward error of a solution; rounding, times what pivots grew
  constexpr double golden_ratio = 0.61803398874989485;
  if (plain_.operations() > SymmetricLu::most_operations) return false;
  if (!plain_.factorise(eliminated_)) return false;
  permuted_.resize(n_);
  for (Eigen::Index i = 0; i < n_; ++i) {
    const double place = golden_ratio * static_cast<double>(i + 1);
    permuted_[i] = 1.0 + place - std::floor(place);
  }
  const Vector expected = eliminated_ * permuted_;
  permuted_ = expected;
  plain_.solve(permuted_);
  const double size = eliminated_.norm() * permuted_.norm() + expected.norm();
  return (eliminated_ * permuted_ - expected).norm() <= good * size;
}

FactorCost LearntJacobian::cost_of_band() const {
  const auto n = static_cast<double>(n_);
  const auto width = static_cast<double>(pattern_.reach());
  return {n * (2.0 * width + 1.0), 2.0 * n * width * width};
}

void LearntJacobian::apply(const Vector& r, Vector& z) {
  permuted_.resize(n_);
  for (Eigen::Index i = 0; i < n_; ++i) permuted_[i] = r[order_.indices()[i]];
  if (by_plain_) {
    plain_.solve(permuted_);
  } else {
    permuted_ = factors_.solve(permuted_);
  }
  for (Eigen::Index i = 0; i < n_; ++i) z[order_.indices()[i]] = permuted_[i];
}

}  // namespace jfnk::detail

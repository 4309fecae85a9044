#include "learnt_jacobian.hpp"

#include <algorithm>

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
  const Eigen::SparseMatrix<double> occupied = shifted.pruned();
  if (has_gap(occupied)) return false;
  factors_.compute(occupied);
  return factors_.info() == Eigen::Success;
}

}  // namespace jfnk::detail

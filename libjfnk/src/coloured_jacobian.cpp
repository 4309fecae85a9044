#include "jfnk/coloured_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace jfnk {
std::vector<int> colour_columns(const Sparsity& sparsity) {
  using Iterator = Sparsity::InnerIterator;
  const auto columns = static_cast<std::size_t>(sparsity.cols());
  std::vector<std::vector<int>> columns_of_row(static_cast<std::size_t>(sparsity.rows()));
  for (int column = 0; column < sparsity.outerSize(); ++column) {
    for (Iterator it(sparsity, column); it; ++it) {
      columns_of_row[static_cast<std::size_t>(it.row())].push_back(column);
    }
  }
  const auto rows_in = [&](int column) {
    int count = 0;
    for (Iterator it(sparsity, column); it; ++it) ++count;
    return count;
  };
  std::vector<int> rows(columns);
  for (std::size_t c = 0; c < columns; ++c) rows[c] = rows_in(static_cast<int>(c));
  std::vector<int> order(columns);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return rows[static_cast<std::size_t>(a)] > rows[static_cast<std::size_t>(b)];
  });
  std::vector<int> colour(columns, -1);
  std::vector<int> taken_by(columns, -1);  // the last column that met a neighbour of this colour
  for (const int column : order) {
    for (Iterator it(sparsity, column); it; ++it) {
      for (const int other : columns_of_row[static_cast<std::size_t>(it.row())]) {
        const int c = colour[static_cast<std::size_t>(other)];
        if (c >= 0) taken_by[static_cast<std::size_t>(c)] = column;
      }
    }
    int free = 0;
    while (taken_by[static_cast<std::size_t>(free)] == column) ++free;
    colour[static_cast<std::size_t>(column)] = free;
  }
  return colour;
}

Sparsity banded_sparsity(Eigen::Index n, Eigen::Index lower, Eigen::Index upper) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < n; ++row) {
    const Eigen::Index end = std::min(n - 1, row + upper);
    for (Eigen::Index column = std::max<Eigen::Index>(0, row - lower); column <= end; ++column) {
      entries.emplace_back(row, column, 1.0);
    }
  }
  Sparsity sparsity(n, n);
  sparsity.setFromTriplets(entries.begin(), entries.end());
  return sparsity;
}

ColouredJacobian::ColouredJacobian(const ResidualRef& residual, const Sparsity& sparsity,
                                   double noise)
    : residual_(residual), matrix_(sparsity), noise_(noise) {
  if (matrix_.rows() != matrix_.cols()) {
    throw std::invalid_argument("jfnk::ColouredJacobian: the sparsity is " +
                                std::to_string(matrix_.rows()) + " x " +
                                std::to_string(matrix_.cols()) + ", not square");
  }
  matrix_.makeCompressed();
  colour_of_ = colour_columns(matrix_);
  for (const int colour : colour_of_) colours_ = std::max(colours_, colour + 1);
  for (int column = 0; column < matrix_.outerSize(); ++column) {
    for (Sparsity::InnerIterator it(matrix_, column); it; ++it) {
      it.valueRef() = it.row() == it.col() ? 1.0 : 0.0;
    }
  }
  factors_.analyzePattern(matrix_);
}

bool ColouredJacobian::evaluate(const Vector& u, Vector& r) {
  ++evaluations_;
  return residual_(u, r) == Evaluation::ok && r.allFinite();
}

void ColouredJacobian::setup(const Vector& u) {
  if (u.size() != matrix_.cols()) {
    throw std::invalid_argument("jfnk::ColouredJacobian: u has size " + std::to_string(u.size()) +
                                ", the sparsity " + std::to_string(matrix_.cols()));
  }
  Vector base = Vector::Zero(u.size());
  if (!evaluate(u, base)) return;
  // A step of each unknown's own size, and of the mean size where it is small.
  const double mean = std::max(u.norm() / std::sqrt(static_cast<double>(u.size())), 1e-3);
  Vector probe = u;
  Vector moved = Vector::Zero(u.size());
  for (int colour = 0; colour < colours_; ++colour) {
    bool valid = false;
    Vector step = Vector::Zero(u.size());
    for (const double sign : {1.0, -1.0}) {
      for (Eigen::Index i = 0; i < u.size(); ++i) {
        const bool mine = colour_of_[static_cast<std::size_t>(i)] == colour;
        probe[i] = u[i] + (mine ? sign * noise_ * std::max(std::abs(u[i]), mean) : 0.0);
        step[i] = probe[i] - u[i];
      }
      valid = evaluate(probe, moved);
      if (valid) break;
    }
    if (!valid) continue;
    for (int column = 0; column < matrix_.outerSize(); ++column) {
      if (colour_of_[static_cast<std::size_t>(column)] != colour) continue;
      for (Sparsity::InnerIterator it(matrix_, column); it; ++it) {
        it.valueRef() = (moved[it.row()] - base[it.row()]) / step[column];
      }
    }
  }
  factors_.factorize(matrix_);
  factorised_ = factors_.info() == Eigen::Success;
}

void ColouredJacobian::apply(const Vector& r, Vector& z) const {
  if (factorised_) {
    z = factors_.solve(r);
  } else {
    z = r;
  }
}

}  // namespace jfnk

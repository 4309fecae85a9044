#include "symmetric_lu.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk::detail {

// The columns i < row of L with an entry in a row, ascending along every path of the elimination
// tree, into the end of reach_; returns where they begin.
int SymmetricLu::reach_of(const Eigen::SparseMatrix<double>& pattern, int row) {
  int top = n_;
  met_[static_cast<std::size_t>(row)] = row;
  for (Eigen::SparseMatrix<double>::InnerIterator it(pattern, row); it; ++it) {
    auto i = static_cast<int>(it.row());
    if (i > row) continue;
    int length = 0;
    for (; met_[static_cast<std::size_t>(i)] != row; i = parent_[static_cast<std::size_t>(i)]) {
      path_[static_cast<std::size_t>(length++)] = i;
      met_[static_cast<std::size_t>(i)] = row;
      int& parent = parent_[static_cast<std::size_t>(i)];
      if (parent < 0) parent = row;
    }
    while (length > 0) {
      reach_[static_cast<std::size_t>(--top)] = path_[static_cast<std::size_t>(--length)];
    }
  }
  return top;
}

void SymmetricLu::analyse(const Eigen::SparseMatrix<double>& A) {
  n_ = static_cast<int>(A.cols());
  const auto n = static_cast<std::size_t>(n_);
  const Eigen::SparseMatrix<double> transposed = A.transpose();
  columns_ = A + 0.0 * transposed;
  parent_.assign(n, -1);
  met_.assign(n, -1);
  path_.assign(n, 0);
  reach_.assign(n, 0);
  std::vector<Index> count(n, 0);
  for (int row = 0; row < n_; ++row) {
    for (int k = reach_of(columns_, row); k < n_; ++k) {
      ++count[static_cast<std::size_t>(reach_[static_cast<std::size_t>(k)])];
    }
  }
  begin_.assign(n + 1, 0);
  operations_ = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    begin_[i + 1] = begin_[i] + count[i];
    operations_ += 2.0 * static_cast<double>(count[i]) * static_cast<double>(count[i]);
  }
}

bool SymmetricLu::factorise(const Eigen::SparseMatrix<double>& A) {
  rows_ = A.transpose();
  columns_ = A + 0.0 * rows_;
  rows_ = columns_.transpose();
  const auto n = static_cast<std::size_t>(n_);
  const auto entries = static_cast<std::size_t>(begin_[n]);
  row_.resize(entries);
  lower_.resize(entries);
  upper_.resize(entries);
  pivot_.assign(n, 0.0);
  x_.assign(n, 0.0);
  y_.assign(n, 0.0);
  end_.assign(begin_.begin(), begin_.end() - 1);
  std::fill(met_.begin(), met_.end(), -1);
  for (int k = 0; k < n_; ++k) {
    double pivot = 0.0;
    const int top = reach_of(columns_, k);
    Eigen::SparseMatrix<double>::InnerIterator in_row(rows_, k);
    for (Eigen::SparseMatrix<double>::InnerIterator it(columns_, k); it && it.row() <= k;
         ++it, ++in_row) {
      if (it.row() == k) {
        pivot = it.value();
      } else {
        x_[static_cast<std::size_t>(it.row())] = it.value();
        y_[static_cast<std::size_t>(it.row())] = in_row.value();
      }
    }
    for (int place = top; place < n_; ++place) {
      const auto i = static_cast<std::size_t>(reach_[static_cast<std::size_t>(place)]);
      const double u = x_[i];
      const double l = y_[i] / pivot_[i];
      x_[i] = 0.0;
      y_[i] = 0.0;
      for (Index p = begin_[i]; p < end_[i]; ++p) {
        const auto at = static_cast<std::size_t>(p);
        const auto j = static_cast<std::size_t>(row_[at]);
        x_[j] -= lower_[at] * u;
        y_[j] -= upper_[at] * l;
      }
      pivot -= l * u;
      const auto at = static_cast<std::size_t>(end_[i]++);
      row_[at] = k;
      lower_[at] = l;
      upper_[at] = u;
    }
    if (pivot == 0.0 || !std::isfinite(pivot)) return false;
    pivot_[static_cast<std::size_t>(k)] = pivot;
  }
  return true;
}

void SymmetricLu::solve(Vector& z) const {
  const auto n = static_cast<std::size_t>(n_);
  double* const v = z.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double value = v[i];
    for (Index p = begin_[i]; p < begin_[i + 1]; ++p) {
      const auto at = static_cast<std::size_t>(p);
      v[row_[at]] -= lower_[at] * value;
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    double value = v[i];
    for (Index p = begin_[i]; p < begin_[i + 1]; ++p) {
      const auto at = static_cast<std::size_t>(p);
      value -= upper_[at] * v[row_[at]];
    }
    v[i] = value / pivot_[i];
  }
}

}  // namespace jfnk::detail

#include "jfnk/vector_operations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "block_kernels.hpp"

namespace jfnk {
namespace {

// Kernels take so many columns at once: each block of w is then read from the cache that often.
constexpr std::size_t columns_at_once = 4;

struct Rows {
  Eigen::Index begin;
  Eigen::Index count;
};

Rows rows_of(Eigen::Index block, Eigen::Index n) {
  const Eigen::Index begin = block * rows_per_block;
  return {begin, std::min(rows_per_block, n - begin)};
}

template <class Columns>
void dots_of_rows(Eigen::Index block, Columns columns, const Vector& w, std::span<double> sums) {
  const Rows rows = rows_of(block, w.size());
  const double* const b = w.data() + rows.begin;
  std::size_t j = 0;
  for (; j + columns_at_once <= columns.size(); j += columns_at_once) {
    detail::dot_four(rows.count, columns[j]->data() + rows.begin,
                     columns[j + 1]->data() + rows.begin, columns[j + 2]->data() + rows.begin,
                     columns[j + 3]->data() + rows.begin, b, &sums[j]);
  }
  for (; j < columns.size(); ++j) {
    sums[j] = detail::dot_one(rows.count, columns[j]->data() + rows.begin, b);
  }
}

template <class Columns>
void combine_rows(Eigen::Index block, double own, Columns columns, std::span<const double> factors,
                  Vector& w) {
  const Rows rows = rows_of(block, w.size());
  double* const to = w.data() + rows.begin;
  if (own == 0.0) {
    std::fill_n(to, rows.count, 0.0);
  } else if (own != 1.0) {
    for (Eigen::Index i = 0; i < rows.count; ++i) to[i] *= own;
  }
  std::size_t j = 0;
  for (; j + columns_at_once <= columns.size(); j += columns_at_once) {
    detail::add_four(rows.count, columns[j]->data() + rows.begin,
                     columns[j + 1]->data() + rows.begin, columns[j + 2]->data() + rows.begin,
                     columns[j + 3]->data() + rows.begin, &factors[j], to);
  }
  for (; j < columns.size(); ++j) {
    detail::add_one(rows.count, columns[j]->data() + rows.begin, factors[j], to);
  }
}

// Sums over all blocks on this thread.
template <class Columns>
void dots_here(Columns columns, const Vector& w, std::span<double> sums) {
  std::fill_n(sums.begin(), columns.size(), 0.0);
  // So many columns that a block's sums fit where no allocation is needed.
  constexpr std::size_t strip = 32;
  std::array<double, strip> part{};
  for (std::size_t begin = 0; begin < columns.size(); begin += strip) {
    const std::size_t count = std::min(strip, columns.size() - begin);
    for (Eigen::Index block = 0; block < blocks_of(w.size()); ++block) {
      dots_of_rows(block, columns.subspan(begin, count), w, part);
      for (std::size_t j = 0; j < count; ++j) sums[begin + j] += part[j];
    }
  }
}

}  // namespace

void dots_of_block(Eigen::Index block, Vectors columns, const Vector& w, std::span<double> sums) {
  dots_of_rows(block, columns, w, sums);
}

void dots_of_block(Eigen::Index block, SingleVectors columns, const Vector& w,
                   std::span<double> sums) {
  dots_of_rows(block, columns, w, sums);
}

void combine_block(Eigen::Index block, double own, Vectors columns, std::span<const double> factors,
                   Vector& w) {
  combine_rows(block, own, columns, factors, w);
}

void combine_block(Eigen::Index block, double own, SingleVectors columns,
                   std::span<const double> factors, Vector& w) {
  combine_rows(block, own, columns, factors, w);
}

bool InnerProductRef::is_safe_square(double square) {
  // Squares of entries beyond these bounds overflow or lose digits to underflow.
  constexpr double smallest = std::numeric_limits<double>::min() * 1e16;
  return square > smallest && std::isfinite(square);
}

double InnerProductRef::dot(const Vector& a, const Vector& b) const {
  if (dot_ != nullptr) return dot_(object_, a, b);
  double sum = 0.0;
  const Vector* const one = &a;
  dots({&one, 1}, b, {&sum, 1});
  return sum;
}

double InnerProductRef::norm(const Vector& a) const {
  const double square = dot(a, a);
  // Eigen's stableNorm may step over a NaN.
  if (std::isnan(square)) return square;
  if (dot_ == nullptr && !is_safe_square(square)) return a.stableNorm();
  return std::sqrt(square);
}

void InnerProductRef::dots(Vectors columns, const Vector& w, std::span<double> sums) const {
  if (dots_ != nullptr) return dots_(object_, columns, w, sums);
  if (dot_ != nullptr) {
    for (std::size_t j = 0; j < columns.size(); ++j) sums[j] = dot_(object_, *columns[j], w);
    return;
  }
  dots_here(columns, w, sums);
}

void InnerProductRef::dots(SingleVectors columns, const Vector& w, std::span<double> sums) const {
  if (single_dots_ != nullptr) return single_dots_(object_, columns, w, sums);
  if (dot_ != nullptr) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      sums[j] = dot_(object_, columns[j]->cast<double>(), w);
    }
    return;
  }
  dots_here(columns, w, sums);
}

void InnerProductRef::combine(double own, Vectors columns, std::span<const double> factors,
                              Vector& w) const {
  if (combine_ != nullptr) return combine_(object_, own, columns, factors, w);
  for (Eigen::Index block = 0; block < blocks_of(w.size()); ++block) {
    combine_block(block, own, columns, factors, w);
  }
}

void InnerProductRef::combine(double own, SingleVectors columns, std::span<const double> factors,
                              Vector& w) const {
  if (single_combine_ != nullptr) return single_combine_(object_, own, columns, factors, w);
  for (Eigen::Index block = 0; block < blocks_of(w.size()); ++block) {
    combine_block(block, own, columns, factors, w);
  }
}

}  // namespace jfnk

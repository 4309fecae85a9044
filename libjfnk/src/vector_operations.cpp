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

// Sums are made for so many columns at a time, so that little memory holds those of blocks.
constexpr std::size_t strip = 32;

template <class Columns>
void dots_of_rows(Rows rows, Columns columns, const Vector& w, std::span<double> sums) {
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
void combine_some(Rows rows, double own, Columns columns, std::span<const double> factors,
                  Vector& w) {
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

// Sums of one thread, without memory.
template <class Columns>
void dots_here(Columns columns, const Products& products) {
  const Vector& w = *products.with;
  std::fill_n(products.sums.begin(), columns.size(), 0.0);
  std::array<double, strip> part{};
  for (std::size_t begin = 0; begin < columns.size(); begin += strip) {
    const std::size_t count = std::min(strip, columns.size() - begin);
    for (Eigen::Index block = 0; block < blocks_of(w.size()); ++block) {
      dots_of_rows(rows_of(block, w.size()), columns.subspan(begin, count), w, part);
      for (std::size_t j = 0; j < count; ++j) products.sums[begin + j] += part[j];
    }
  }
}

double square_of_rows(Rows rows, const Vector& v) {
  return detail::dot_one(rows.count, v.data() + rows.begin, v.data() + rows.begin);
}

}  // namespace

void combine_rows(Rows rows, double own, Vectors columns, std::span<const double> factors,
                  Vector& w) {
  combine_some(rows, own, columns, factors, w);
}

void combine_rows(Rows rows, double own, SingleVectors columns, std::span<const double> factors,
                  Vector& w) {
  combine_some(rows, own, columns, factors, w);
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

double InnerProductRef::norm_of(const Vector& a, double square) const {
  // Eigen's stableNorm may step over a NaN.
  if (std::isnan(square)) return square;
  if (dot_ == nullptr && !is_safe_square(square)) return a.stableNorm();
  return std::sqrt(square);
}

double InnerProductRef::norm(const Vector& a) const {
  return norm_of(a, dot(a, a));
}

void InnerProductRef::work_and_norms(Eigen::Index n, Eigen::Index numbers_per_row, BlockWork work,
                                     Vectors vectors, std::span<double> norms) const {
  if (dot_ != nullptr) {
    share_out(n, numbers_per_row * n, work);
    for (std::size_t j = 0; j < vectors.size(); ++j) norms[j] = norm(*vectors[j]);
    return;
  }
  if (share_out_ == nullptr) {
    std::fill_n(norms.begin(), vectors.size(), 0.0);
    for (Eigen::Index block = 0; block < blocks_of(n); ++block) {
      work(block);
      for (std::size_t j = 0; j < vectors.size(); ++j) {
        norms[j] += square_of_rows(rows_of(block, n), *vectors[j]);
      }
    }
    for (std::size_t j = 0; j < vectors.size(); ++j) norms[j] = norm_of(*vectors[j], norms[j]);
    return;
  }
  const auto blocks = static_cast<std::size_t>(blocks_of(n));
  const std::span<double> squares = sums_of_blocks(blocks * vectors.size());
  const auto work_and_squares = [&](Eigen::Index block) {
    work(block);
    for (std::size_t j = 0; j < vectors.size(); ++j) {
      squares[j * blocks + static_cast<std::size_t>(block)] =
          square_of_rows(rows_of(block, n), *vectors[j]);
    }
  };
  share_out(n, numbers_per_row * n, BlockWork(work_and_squares));
  for (std::size_t j = 0; j < vectors.size(); ++j) {
    double square = 0.0;
    for (const double part : squares.subspan(j * blocks, blocks)) square += part;
    norms[j] = norm_of(*vectors[j], square);
  }
}

void InnerProductRef::share_out(Eigen::Index n, Eigen::Index numbers, BlockWork work) const {
  if (share_out_ != nullptr) return share_out_(object_, n, numbers, work);
  for (Eigen::Index block = 0; block < blocks_of(n); ++block) work(block);
}

std::span<double> InnerProductRef::sums_of_blocks(std::size_t count) const {
  if (block_sums_.size() < count) block_sums_.resize(count);
  return {block_sums_.data(), count};
}

// Sums of the blocks, whoever made them, are added up in the blocks' order.
template <class Columns>
void InnerProductRef::dots_by_blocks(Columns columns, std::span<const Products> products) const {
  if (share_out_ == nullptr) {
    for (const Products& each : products) dots_here(columns, each);
    return;
  }
  const Eigen::Index n = products.front().with->size();
  const auto blocks = static_cast<std::size_t>(blocks_of(n));
  const std::size_t of_block = strip * products.size();
  const std::span<double> all = sums_of_blocks(blocks * of_block);
  for (std::size_t begin = 0; begin < columns.size(); begin += strip) {
    const std::size_t count = std::min(strip, columns.size() - begin);
    const Columns some = columns.subspan(begin, count);
    const auto part = [&](std::size_t block, std::size_t k) {
      return all.subspan(block * of_block + k * strip, count);
    };
    const auto work = [&](Eigen::Index block) {
      for (std::size_t k = 0; k < products.size(); ++k) {
        dots_of_rows(rows_of(block, n), some, *products[k].with,
                     part(static_cast<std::size_t>(block), k));
      }
    };
    const auto vectors = static_cast<Eigen::Index>(count + products.size());
    share_out(n, vectors * n, BlockWork(work));
    for (std::size_t k = 0; k < products.size(); ++k) {
      const std::span<double> total = products[k].sums.subspan(begin, count);
      std::fill(total.begin(), total.end(), 0.0);
      for (std::size_t block = 0; block < blocks; ++block) {
        for (std::size_t j = 0; j < count; ++j) total[j] += part(block, k)[j];
      }
    }
  }
}

template <class Columns>
void InnerProductRef::combine_by_blocks(double own, Columns columns,
                                        std::span<const double> factors, Vector& w) const {
  pass(w.size(), static_cast<Eigen::Index>(columns.size()) + 1,
       [&](Rows rows) { combine_some(rows, own, columns, factors, w); });
}

void InnerProductRef::dots(Vectors columns, const Vector& w, std::span<double> sums) const {
  const Products one{&w, sums};
  dots(columns, {&one, 1});
}

void InnerProductRef::dots(SingleVectors columns, const Vector& w, std::span<double> sums) const {
  const Products one{&w, sums};
  dots(columns, {&one, 1});
}

void InnerProductRef::dots(Vectors columns, std::span<const Products> products) const {
  if (dot_ == nullptr) return dots_by_blocks(columns, products);
  for (const auto& [w, sums] : products) {
    if (dots_ != nullptr) {
      dots_(object_, columns, *w, sums);
      continue;
    }
    for (std::size_t j = 0; j < columns.size(); ++j) sums[j] = dot_(object_, *columns[j], *w);
  }
}

void InnerProductRef::dots(SingleVectors columns, std::span<const Products> products) const {
  if (dot_ == nullptr) return dots_by_blocks(columns, products);
  for (const auto& [w, sums] : products) {
    if (single_dots_ != nullptr) {
      single_dots_(object_, columns, *w, sums);
      continue;
    }
    for (std::size_t j = 0; j < columns.size(); ++j) {
      sums[j] = dot_(object_, columns[j]->cast<double>(), *w);
    }
  }
}

void InnerProductRef::combine(double own, Vectors columns, std::span<const double> factors,
                              Vector& w) const {
  combine_by_blocks(own, columns, factors, w);
}

void InnerProductRef::combine(double own, SingleVectors columns, std::span<const double> factors,
                              Vector& w) const {
  combine_by_blocks(own, columns, factors, w);
}

}  // namespace jfnk

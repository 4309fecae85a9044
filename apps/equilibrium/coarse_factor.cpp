#include "equilibrium/coarse_factor.hpp"

#include <omp.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

#include "equilibrium/instruction_sets.hpp"

namespace equilibrium {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr int width = 16;  // a register of floats, or some: rows begin at multiples of it

// Numbers of the rows over those of a sparse factor up to which rows are faster: such a number of a
// row takes a third of one in a sparse factor (measured), if not much memory has to be read.
constexpr double most_fill = 2.5;

int rounded_down(int k, int width) {
  return k / width * width;
}

// Numbers that the rows from their first entry to the diagonal hold; none of a factor is outside.
double envelope(const Sparse& matrix) {
  double numbers = 0.0;
  for (int row = 0; row < matrix.outerSize(); ++row) {
    const Sparse::InnerIterator first(matrix, row);
    numbers +=
        row + 1.0 - static_cast<double>(first ? std::min<Eigen::Index>(row, first.row()) : row);
  }
  return numbers;
}

// Ordered for little fill; says how much that is before it is made.
class SparseFactorisation : public Eigen::SimplicialLLT<Sparse> {
 public:
  explicit SparseFactorisation(const Sparse& matrix) { analyzePattern(matrix); }
  double numbers() const { return static_cast<double>(m_matrix.nonZeros()); }
};

template <class Factorisation>
Eigen::SparseMatrix<float> lower(const Factorisation& factorisation) {
  if (factorisation.info() != Eigen::Success) {
    throw std::runtime_error(
        "the elastic stiffness of the background grid is not positive definite: "
        "is the body supported against every rigid motion?");
  }
  return factorisation.matrixL().nestedExpression().template cast<float>();
}

}  // namespace

CoarseFactor::Ends CoarseFactor::ends_of(const Sparse& swept) {
  const auto n = static_cast<int>(swept.rows());
  Ends best;
  best.front = best.back = n;
  int lowest = n;  // rows that are worked on one after the other
  int reached = 0;
  for (int front = 1; front < n; ++front) {
    for (Sparse::InnerIterator entry(swept, front - 1); entry; ++entry) {
      reached = std::max(reached, static_cast<int>(entry.row()) + 1);
    }
    // Those between are coupled to both ends and to each other: three rows in one.
    const int rows = std::max(front, n - reached) + 3 * (reached - front);
    if (front % width == 0 && rows < lowest) {
      lowest = rows;
      best.front = front;
      best.back = front + n - reached;
    }
  }
  return best;
}

CoarseFactor::CoarseFactor(const Sparse& matrix, const std::vector<int>& sorted) {
  const auto n = static_cast<int>(matrix.rows());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> sweep(n);
  for (int k = 0; k < n; ++k) sweep.indices()[sorted[static_cast<std::size_t>(k)]] = k;
  Sparse swept(n, n);
  swept = matrix.twistedBy(sweep);
  SparseFactorisation sparse(matrix);
  if (envelope(swept) <= most_fill * sparse.numbers()) {
    const Ends ends = ends_of(swept);
    const int between = n - ends.back;
    for (int& at : sweep.indices()) {
      if (at >= ends.front + between) {
        at = ends.front + n - 1 - at;
      } else if (at >= ends.front) {
        at += ends.back - ends.front;
      }
    }
    swept = matrix.twistedBy(sweep);
    order_ = sweep;
    rows_ = rows_of(
        lower(Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>(swept)),
        ends);
  } else {
    sparse.factorize(matrix);
    sparse_ = lower(sparse);
    order_ = sparse.permutationP();
  }
  work_.setZero(rounded_down(n + width - 1, width));
}

CoarseFactor::Rows CoarseFactor::rows_of(const Eigen::SparseMatrix<float>& factor,
                                         const Ends& ends) {
  const Eigen::SparseMatrix<float, Eigen::RowMajor> by_rows = factor;
  using Entry = Eigen::SparseMatrix<float, Eigen::RowMajor>::InnerIterator;
  const auto n = static_cast<int>(by_rows.rows());
  Rows rows;
  rows.ends = ends;
  Ends& apart = rows.ends;
  rows.begin.push_back(0);
  apart.begin.push_back(0);
  for (int row = 0; row < n; ++row) {
    const bool between = row >= ends.back;
    int first = row;
    int first_apart = ends.front;
    for (Entry entry(by_rows, row); entry; ++entry) {
      const auto column = static_cast<int>(entry.col());
      int& least = between && column < ends.front ? first_apart : first;
      least = std::min(least, column);
    }
    rows.first.push_back(rounded_down(first, width));
    rows.begin.push_back(rows.begin.back() + static_cast<std::size_t>(rounded_down(row, width) +
                                                                      width - rows.first.back()));
    if (!between) continue;
    apart.first.push_back(rounded_down(first_apart, width));
    apart.begin.push_back(apart.begin.back() +
                          static_cast<std::size_t>(ends.front - apart.first.back()));
  }
  rows.entries.resize(rows.begin.back());
  apart.entries.resize(apart.begin.back());
  rows.inverse_diagonal.resize(rows.first.size());
  for (int row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    for (Entry entry(by_rows, row); entry; ++entry) {
      const auto column = static_cast<int>(entry.col());
      if (column == row) {
        rows.inverse_diagonal[i] = 1.0F / entry.value();
      } else if (row >= ends.back && column < ends.front) {
        const auto k = static_cast<std::size_t>(row - ends.back);
        apart.entries[apart.begin[k] + static_cast<std::size_t>(column - apart.first[k])] =
            entry.value();
      } else {
        rows.entries[rows.begin[i] + static_cast<std::size_t>(column - rows.first[i])] =
            entry.value();
      }
    }
  }
  return rows;
}

namespace {

float product(const float* entry, const float* x, std::size_t count) {
  float sum[width] = {};
  for (std::size_t k = 0; k < count; k += width) {
    for (int lane = 0; lane < width; ++lane) {
      const auto at = k + static_cast<std::size_t>(lane);
      sum[lane] += entry[at] * x[at];
    }
  }
  for (int half = width / 2; half > 0; half /= 2) {
    for (int lane = 0; lane < half; ++lane) sum[lane] += sum[lane + half];
  }
  return sum[0];
}

void subtract(float own, const float* entry, float* x, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) x[k] -= own * entry[k];
}

// x_i = (x_i - sum_{j < i} L_ij x_j) / L_ii for rows [from, to).
template <class Rows>
void down(const Rows& rows, int from, int to, float* x) {
  for (auto i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i) {
    const float sum = product(rows.entries.data() + rows.begin[i], x + rows.first[i],
                              rows.begin[i + 1] - rows.begin[i]);
    x[i] = (x[i] - sum) * rows.inverse_diagonal[i];
  }
}

// x_i /= L_ii and x_j -= L_ij x_i for rows [from, to), the last one first.
template <class Rows>
void up(const Rows& rows, int from, int to, float* x) {
  for (auto i = static_cast<std::size_t>(to); i-- > static_cast<std::size_t>(from);) {
    const float own = x[i] * rows.inverse_diagonal[i];
    subtract(own, rows.entries.data() + rows.begin[i], x + rows.first[i],
             rows.begin[i + 1] - rows.begin[i]);
    x[i] = own;
  }
}

// What is between, with what it has of the front.
template <class Rows>
void down_and_up(const Rows& rows, float* x) {
  const auto& apart = rows.ends;
  const auto n = static_cast<int>(rows.first.size());
  float* const between = x + apart.back;
  for (std::size_t k = 0; k < apart.first.size(); ++k) {
    between[k] -= product(apart.entries.data() + apart.begin[k], x + apart.first[k],
                          apart.begin[k + 1] - apart.begin[k]);
  }
  down(rows, apart.back, n, x);
  up(rows, apart.back, n, x);
  for (std::size_t k = 0; k < apart.first.size(); ++k) {
    subtract(between[k], apart.entries.data() + apart.begin[k], x + apart.first[k],
             apart.begin[k + 1] - apart.begin[k]);
  }
}

template <class Rows, class Part>
void sweep_part(const Rows& rows, Part part, float* x) {
  const int front = rows.ends.front;
  const int back = rows.ends.back;
  switch (part) {
    case Part::front_down:
      return down(rows, 0, front, x);
    case Part::back_down:
      return down(rows, front, back, x);
    case Part::middle:
      return down_and_up(rows, x);
    case Part::back_up:
      return up(rows, front, back, x);
    case Part::front_up:
      return up(rows, 0, front, x);
  }
}

#ifdef EQUILIBRIUM_WIDE_LOOPS
template <class Rows, class Part>
EQUILIBRIUM_AVX512 __attribute__((flatten)) void sweep_avx512(const Rows& rows, Part part,
                                                              float* x) {
  sweep_part(rows, part, x);
}
template <class Rows, class Part>
EQUILIBRIUM_AVX2 __attribute__((flatten)) void sweep_avx2(const Rows& rows, Part part, float* x) {
  sweep_part(rows, part, x);
}
#endif

}  // namespace

void CoarseFactor::sweep(const Rows& rows, Part part, float* x) {
#ifdef EQUILIBRIUM_WIDE_LOOPS
  if (__builtin_cpu_supports("x86-64-v4")) return sweep_avx512(rows, part, x);
  if (__builtin_cpu_supports("x86-64-v3")) return sweep_avx2(rows, part, x);
#endif
  sweep_part(rows, part, x);
}

void CoarseFactor::sweep_all() {
  // Two threads meet three times, some 10 us, in which one alone reads so many entries twice.
  constexpr std::size_t least_entries = 100000;
  float* const x = work_.data();
  const bool alone = rows_.entries.size() < least_entries || rows_.ends.front == rows_.ends.back;
#pragma omp parallel if (!alone)
  {
    const bool first = omp_get_thread_num() == 0;
    const bool last = omp_get_thread_num() == omp_get_num_threads() - 1;
    if (first) sweep(rows_, Part::front_down, x);
    if (last) sweep(rows_, Part::back_down, x);
#pragma omp barrier
    if (first) sweep(rows_, Part::middle, x);
#pragma omp barrier
    if (first) sweep(rows_, Part::front_up, x);
    if (last) sweep(rows_, Part::back_up, x);
  }
}

void CoarseFactor::solve(Eigen::VectorXf& x) {
  const Eigen::Index n = x.size();
  work_.head(n).noalias() = order_ * x;
  if (by_rows()) {
    sweep_all();
  } else {
    auto unknowns = work_.head(n);
    sparse_.triangularView<Eigen::Lower>().solveInPlace(unknowns);
    sparse_.transpose().triangularView<Eigen::Upper>().solveInPlace(unknowns);
  }
  x.noalias() = order_.transpose() * work_.head(n);
}

std::size_t CoarseFactor::bytes() const {
  const auto of = [](const auto& array) {
    return static_cast<std::size_t>(array.size()) * sizeof(*array.data());
  };
  return of(order_.indices()) + of(work_) + of(rows_.begin) + of(rows_.first) + of(rows_.entries) +
         of(rows_.inverse_diagonal) + of(rows_.ends.begin) + of(rows_.ends.first) +
         of(rows_.ends.entries) +
         static_cast<std::size_t>(sparse_.nonZeros()) * (sizeof(float) + sizeof(int)) +
         static_cast<std::size_t>(sparse_.outerSize()) * sizeof(int);
}

}  // namespace equilibrium

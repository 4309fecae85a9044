#include "equilibrium/coarse_factor.hpp"

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

CoarseFactor::CoarseFactor(const Sparse& matrix, const std::vector<int>& sorted) {
  const auto n = static_cast<int>(matrix.rows());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> sweep(n);
  for (int k = 0; k < n; ++k) sweep.indices()[sorted[static_cast<std::size_t>(k)]] = k;
  Sparse swept(n, n);
  swept = matrix.twistedBy(sweep);
  SparseFactorisation sparse(matrix);
  if (envelope(swept) <= most_fill * sparse.numbers()) {
    order_ = sweep;
    rows_ = rows_of(
        lower(Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>(swept)));
  } else {
    sparse.factorize(matrix);
    sparse_ = lower(sparse);
    order_ = sparse.permutationP();
  }
  work_.setZero(rounded_down(n + width - 1, width));
}

CoarseFactor::Rows CoarseFactor::rows_of(const Eigen::SparseMatrix<float>& factor) {
  const Eigen::SparseMatrix<float, Eigen::RowMajor> by_rows = factor;
  using Entry = Eigen::SparseMatrix<float, Eigen::RowMajor>::InnerIterator;
  const auto n = static_cast<int>(by_rows.rows());
  Rows rows;
  rows.begin.push_back(0);
  for (int row = 0; row < n; ++row) {
    rows.first.push_back(rounded_down(static_cast<int>(Entry(by_rows, row).col()), width));
    rows.begin.push_back(rows.begin.back() + static_cast<std::size_t>(rounded_down(row, width) +
                                                                      width - rows.first.back()));
  }
  rows.entries.resize(rows.begin.back());
  rows.inverse_diagonal.resize(rows.first.size());
  for (int row = 0; row < n; ++row) {
    const auto i = static_cast<std::size_t>(row);
    for (Entry entry(by_rows, row); entry; ++entry) {
      if (entry.col() == row) {
        rows.inverse_diagonal[i] = 1.0F / entry.value();
      } else {
        rows.entries[rows.begin[i] + static_cast<std::size_t>(entry.col() - rows.first[i])] =
            entry.value();
      }
    }
  }
  return rows;
}

namespace {

// Forward, x_i = (x_i - sum_{j < i} L_ij x_j) / L_ii; back, x_i /= L_ii and x_j -= L_ij x_i.
template <class Rows>
void sweep_rows(const Rows& rows, float* x) {
  const std::size_t n = rows.first.size();
  for (std::size_t i = 0; i < n; ++i) {
    const float* const entry = rows.entries.data() + rows.begin[i];
    const float* const before = x + rows.first[i];
    const auto count = static_cast<int>(rows.begin[i + 1] - rows.begin[i]);
    float sum[width] = {};
    for (int k = 0; k < count; k += width) {
      for (int lane = 0; lane < width; ++lane) sum[lane] += entry[k + lane] * before[k + lane];
    }
    for (int half = width / 2; half > 0; half /= 2) {
      for (int lane = 0; lane < half; ++lane) sum[lane] += sum[lane + half];
    }
    x[i] = (x[i] - sum[0]) * rows.inverse_diagonal[i];
  }
  for (std::size_t i = n; i-- > 0;) {
    const float* const entry = rows.entries.data() + rows.begin[i];
    float* const before = x + rows.first[i];
    const auto count = static_cast<int>(rows.begin[i + 1] - rows.begin[i]);
    const float own = x[i] * rows.inverse_diagonal[i];
    for (int k = 0; k < count; k += width) {
      for (int lane = 0; lane < width; ++lane) before[k + lane] -= own * entry[k + lane];
    }
    x[i] = own;
  }
}

#ifdef EQUILIBRIUM_WIDE_LOOPS
template <class Rows>
EQUILIBRIUM_AVX512 __attribute__((flatten)) void sweep_avx512(const Rows& rows, float* x) {
  sweep_rows(rows, x);
}
template <class Rows>
EQUILIBRIUM_AVX2 __attribute__((flatten)) void sweep_avx2(const Rows& rows, float* x) {
  sweep_rows(rows, x);
}
#endif

}  // namespace

void CoarseFactor::sweep(const Rows& rows, float* x) {
#ifdef EQUILIBRIUM_WIDE_LOOPS
  if (__builtin_cpu_supports("x86-64-v4")) return sweep_avx512(rows, x);
  if (__builtin_cpu_supports("x86-64-v3")) return sweep_avx2(rows, x);
#endif
  sweep_rows(rows, x);
}

void CoarseFactor::solve(Eigen::VectorXf& x) {
  const Eigen::Index n = x.size();
  work_.head(n).noalias() = order_ * x;
  if (by_rows()) {
    sweep(rows_, work_.data());
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
         of(rows_.inverse_diagonal) +
         static_cast<std::size_t>(sparse_.nonZeros()) * (sizeof(float) + sizeof(int)) +
         static_cast<std::size_t>(sparse_.outerSize()) * sizeof(int);
}

}  // namespace equilibrium

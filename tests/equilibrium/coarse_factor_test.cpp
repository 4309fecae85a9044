// The factor of the coarse grid against a direct solution in double precision, kept either way.
#include "equilibrium/coarse_factor.hpp"

#include <gtest/gtest.h>

#include <omp.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <numeric>

namespace {

using equilibrium::CoarseFactor;
using Sparse = Eigen::SparseMatrix<double>;

// Springs between the neighbours of a lattice of `sizes` points, each held by a weak one.
Sparse lattice_of_springs(const std::vector<int>& sizes) {
  const int n = std::accumulate(sizes.begin(), sizes.end(), 1, std::multiplies<>());
  std::vector<Eigen::Triplet<double>> entries;
  for (int k = 0; k < n; ++k) entries.emplace_back(k, k, 0.05);
  int stride = 1;
  for (const int size : sizes) {
    for (int k = 0; k < n; ++k) {
      if (k / stride % size == size - 1) continue;
      const int other = k + stride;
      entries.emplace_back(k, k, 1.0);
      entries.emplace_back(other, other, 1.0);
      entries.emplace_back(k, other, -1.0);
      entries.emplace_back(other, k, -1.0);
    }
    stride *= size;
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

std::vector<int> as_numbered(Eigen::Index n) {
  std::vector<int> order(static_cast<std::size_t>(n));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

void expect_solves(const Sparse& matrix, const std::vector<int>& sorted, bool by_rows) {
  const Eigen::Index n = matrix.rows();
  CoarseFactor factor(matrix, sorted);
  EXPECT_EQ(factor.by_rows(), by_rows) << n;
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0).array().cos();
  const Eigen::VectorXd expected = Eigen::MatrixXd(matrix).llt().solve(b);
  Eigen::VectorXf x = b.cast<float>();
  factor.solve(x);
  // The condition of these is below (4 dim + 0.05) / 0.05 = 241 and single precision has 6e-8;
  // rounding n times over is a bound that is never met.
  EXPECT_LE((x.cast<double>() - expected).norm(), 241 * 6e-8 * expected.norm()) << n;
}

TEST(CoarseFactor, SolvesByRowsWhereTheyAreShort) {
  for (const int length : {1, 2, 15, 16, 17, 33, 100}) {
    for (const int height : {1, 3, 8, 16}) {
      if (length < height) continue;
      const Sparse matrix = lattice_of_springs({height, length});
      expect_solves(matrix, as_numbered(matrix.rows()), true);
    }
  }
}

TEST(CoarseFactor, SolvesByRowsInSpace) {
  const Sparse matrix = lattice_of_springs({5, 6, 9});
  expect_solves(matrix, as_numbered(matrix.rows()), true);
}

TEST(CoarseFactor, MeetsInTheMiddleWithTheBitsOfOneThread) {
  // Long enough for two threads, of a length that no register divides.
  const int before = omp_get_max_threads();
  for (const std::vector<int>& sizes : {std::vector<int>{16, 407}, {3, 5, 600}}) {
    const Sparse matrix = lattice_of_springs(sizes);
    const Eigen::Index n = matrix.rows();
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(n, -1.0, 200.0).array().cos();
    const Eigen::VectorXd expected = Eigen::SimplicialLLT<Sparse>(matrix).solve(b);
    Eigen::VectorXf alone;
    for (const int threads : {1, 2, 3, 7}) {
      omp_set_num_threads(threads);
      CoarseFactor factor(matrix, as_numbered(n));
      ASSERT_TRUE(factor.from_both_ends());
      Eigen::VectorXf x = b.cast<float>();
      factor.solve(x);
      EXPECT_LE((x.cast<double>() - expected).norm(), 241 * 6e-8 * expected.norm()) << n;
      if (threads == 1) alone = x;
      EXPECT_EQ(x, alone) << threads;
    }
  }
  omp_set_num_threads(before);
}

TEST(CoarseFactor, SolvesByASparseFactorInAnOrderAtRandom) {
  const Sparse matrix = lattice_of_springs({40, 40});
  std::vector<int> scattered = as_numbered(matrix.rows());
  for (std::size_t k = 0; k < scattered.size(); ++k)
    std::swap(scattered[k], scattered[k * 7919 % scattered.size()]);
  expect_solves(matrix, scattered, false);
}

TEST(CoarseFactor, RefusesWhatIsNotPositiveDefinite) {
  Sparse matrix = lattice_of_springs({5, 9});
  matrix.coeffRef(7, 7) = -1.0;
  EXPECT_THROW(CoarseFactor(matrix, as_numbered(matrix.rows())), std::runtime_error);
}

}  // namespace

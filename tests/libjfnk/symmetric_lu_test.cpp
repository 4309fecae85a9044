#include "symmetric_lu.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "jfnk/coloured_jacobian.hpp"
#include "problems.hpp"

namespace {

using jfnk::Vector;
using jfnk::detail::SymmetricLu;
using jfnk_test::Sparse;

/// Entries of one triangle only here and there, larger on the diagonal than all others of their
/// column together, so that no pivot is small.
Sparse dominant(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 5.0 + 0.1 * i);
    if (i > 0) entries.emplace_back(i, i - 1, -1.0);
    if (i % 3 == 0 && i + 7 < n) entries.emplace_back(i, i + 7, 0.7);
    if (i % 4 == 0 && i >= 11) entries.emplace_back(i, i - 11, -0.4);
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(SymmetricLu, SolvesWhateverTheTwoTrianglesAre) {
  // Rounding of n sums of n terms, elimination of such a matrix not growing (Higham 2002, section
  // 9.5).
  constexpr double unit = std::numeric_limits<double>::epsilon();
  for (const int n : {1, 2, 13, 100}) {
    SymmetricLu factors;
    const Sparse first = dominant(n);
    factors.analyse(first);
    for (const double scale : {1.0, -3.0}) {
      const Sparse matrix = scale * first;
      ASSERT_TRUE(factors.factorise(matrix)) << n;
      const Vector x = Vector::LinSpaced(n, 1.0, -2.0);
      Vector z = matrix * x;
      factors.solve(z);
      EXPECT_LE((z - x).norm(), n * n * unit * x.norm()) << n;
    }
  }
}

TEST(SymmetricLu, CountsTheOperationsOfItsFactors) {
  SymmetricLu factors;
  factors.analyse(jfnk::banded_sparsity(100, 1, 1));  // one entry under each pivot but the last
  EXPECT_EQ(factors.operations(), 2.0 * 99);
  factors.analyse(jfnk::banded_sparsity(4, 3, 3));
  EXPECT_EQ(factors.operations(), 2.0 * (9 + 4 + 1));
}

TEST(SymmetricLu, RefusesAPivotThatIsZeroOrNoNumber) {
  Sparse matrix = dominant(10);
  SymmetricLu factors;
  factors.analyse(matrix);
  for (const double bad : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    matrix.coeffRef(0, 0) = bad;
    EXPECT_FALSE(factors.factorise(matrix));
  }
  matrix.coeffRef(0, 0) = 5.0;
  EXPECT_TRUE(factors.factorise(matrix));
}

}  // namespace

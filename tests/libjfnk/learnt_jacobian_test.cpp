#include "learnt_jacobian.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "jfnk/coloured_jacobian.hpp"
#include "problems.hpp"

// The Jacobian of a lattice, its diagonals and its factors.
namespace {

using jfnk::Vector;
using jfnk::detail::factor_cost;
using jfnk::detail::LearntJacobian;
using jfnk::detail::order_of_elimination;
using jfnk_test::Sparse;

/// Learns `matrix` from the given columns and by its groups.
void learn(LearntJacobian& learnt, const Sparse& matrix,
           std::initializer_list<Eigen::Index> columns) {
  learnt.reset(matrix.cols());
  jfnk::detail::LatticePattern& pattern = learnt.pattern();
  for (const Eigen::Index j : columns) pattern.learn(pattern.read(j, matrix.col(j), matrix.cols()));
  learnt.group_columns();
  Vector v(matrix.cols());
  for (int group = 0; group < learnt.groups(); ++group) {
    learnt.write_group(group, v);
    learnt.read_group(group, matrix * v);
  }
}

/// Two fields on a line of m nodes, coupled: u after v if `by_field`, else in turns.
Sparse two_fields(int m, bool by_field) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto at = [&](int field, int i) { return by_field ? field * m + i : 2 * i + field; };
  for (int i = 0; i < m; ++i) {
    for (int field = 0; field < 2; ++field) {
      entries.emplace_back(at(field, i), at(field, i), 4.0 + 0.1 * i);
      entries.emplace_back(at(field, i), at(1 - field, i), 1.0 + field);
      if (i > 0) entries.emplace_back(at(field, i), at(field, i - 1), -1.0 - field);
      if (i + 1 < m) entries.emplace_back(at(0, i), at(field, i + 1), 0.5 + field);
    }
  }
  Sparse matrix(2 * m, 2 * m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(LearntJacobian, IsTheMatrixWhoseDiagonalsItHasSeen) {
  const Sparse lattice = jfnk_test::laplacian(9);
  const Vector x = Vector::LinSpaced(81, -1.0, 2.0);
  LearntJacobian learnt;
  learn(learnt, lattice, {40});
  EXPECT_LE(learnt.groups(), 9);  // five columns share a row; greedy colouring needs a few more
  EXPECT_LT((learnt.multiply(x) - lattice * x).norm(), 1e-14 * (lattice * x).norm());
  Vector z(81);
  ASSERT_TRUE(learnt.factorise(0.0));
  learnt.apply(lattice * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
  ASSERT_TRUE(learnt.factorise(2.5));
  learnt.apply(lattice * x + 2.5 * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
}

TEST(LearntJacobian, KnowsFieldsNumberedNodeByNodeOrOneAfterTheOther) {
  for (const bool by_field : {false, true}) {
    const Sparse matrix = two_fields(30, by_field);
    const Vector x = Vector::LinSpaced(60, 1.0, 3.0);
    LearntJacobian learnt;
    learn(learnt, matrix, {20, 41});
    EXPECT_LT((learnt.multiply(x) - matrix * x).norm(), 1e-13 * (matrix * x).norm());
  }
}

TEST(LearntJacobian, TellsColumnsOfOneProductApart) {
  // The first differences of a ring and of the line that it is cut into.
  const int n = 40;
  for (const bool ring : {true, false}) {
    Sparse matrix(n, n);
    for (int i = 0; i < n; ++i) {
      matrix.insert(i, i) = 3.0;
      if (ring || i > 0) matrix.insert(i, (i + n - 1) % n) = -1.0;
      if (ring || i + 1 < n) matrix.insert(i, (i + 1) % n) = -2.0;
    }
    Vector v = Vector::Zero(n);
    for (const int j : {0, 10, 20, 30}) v[j] = 1.0;
    const Vector product = matrix * v;
    jfnk::detail::LatticePattern pattern;
    pattern.reset(n);
    for (const int j : {0, 10, 20, 30}) {
      const auto column = pattern.read(j, product, 4);
      EXPECT_EQ(pattern.width(column), 1);
      EXPECT_EQ(column.offsets.size(), Vector(matrix.col(j)).cwiseAbs().count());
      pattern.learn(column);
    }
    EXPECT_EQ(pattern.matrix().nonZeros(), matrix.nonZeros());
  }
}

TEST(LearntJacobian, ForetellsItsFactors) {
  // A band of half width one: L has one entry under each pivot, whatever the ordering.
  const auto line = jfnk::banded_sparsity(100, 1, 1);
  const auto cost = factor_cost(line, order_of_elimination(line), 1e9);
  EXPECT_EQ(cost.entries, 2.0 * 99 + 100);
  EXPECT_EQ(cost.operations, 2.0 * 99);
  // A full matrix: n - 1 under the first pivot, n - 2 under the next, ...
  const auto full = jfnk::banded_sparsity(20, 19, 19);
  EXPECT_EQ(factor_cost(full, order_of_elimination(full), 1e9).entries, 400.0);
  // Counting ends soon after the limit.
  EXPECT_LT(factor_cost(full, order_of_elimination(full), 50.0).entries, 400.0);
  // Nested dissection of m x m nodes needs at least of the order of m^3 operations (George 1973).
  const Sparse nodes = jfnk_test::laplacian(40);
  const auto lattice = factor_cost(nodes, order_of_elimination(nodes), 1e9);
  EXPECT_GT(lattice.operations, 40.0 * 40 * 40);
  EXPECT_LT(lattice.operations, 2.0 * 40 * 40 * 40 * 40);  // that of the band
}

TEST(LearntJacobian, KnowsWithoutLookingWhatItsBandCosts) {
  LearntJacobian learnt;
  learn(learnt, jfnk_test::laplacian(9), {40});
  const auto band = learnt.cost_of_band();
  EXPECT_EQ(band.entries, 81.0 * (2 * 9 + 1));
  EXPECT_EQ(band.operations, 2.0 * 81 * 9 * 9);
  const auto factors = learnt.cost(1e9);
  EXPECT_GE(band.entries, factors.entries);
  EXPECT_GE(band.operations, factors.operations);
}

TEST(LearntJacobian, FindsASingularMatrixUnusable) {
  Sparse matrix = jfnk_test::laplacian(6);
  for (Sparse::InnerIterator it(matrix, 7); it; ++it) it.valueRef() = 0.0;
  LearntJacobian learnt;
  learn(learnt, matrix, {14});
  EXPECT_FALSE(learnt.factorise(0.0));
}

TEST(LearntJacobian, FindsAnAllButEmptyMatrixUnusable) {
  Sparse matrix(100, 100);
  EXPECT_FALSE([&] {
    LearntJacobian learnt;
    learn(learnt, matrix, {50});
    return learnt.factorise(0.0);
  }());
  matrix.insert(3, 3) = 1.0;
  LearntJacobian learnt;
  learn(learnt, matrix, {3});
  EXPECT_FALSE(learnt.factorise(0.0));
  EXPECT_TRUE(learnt.factorise(1.0));
}

TEST(LearntJacobian, ChoosesPivotsWhereThereAreNoneOnTheDiagonal) {
  // Pairs that depend on each other alone, along a line: a zero under every second pivot in any
  // order of elimination.
  constexpr int n = 60;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i % 2 == 0 ? i + 1 : i - 1, 1.0 + 0.01 * i);
    if (i + 2 < n) entries.emplace_back(i, i + 2, 0.5);
    entries.emplace_back(i, i, 0.0);
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  LearntJacobian learnt;
  learn(learnt, matrix, {20, 21, 22, 23});
  const Vector x = Vector::LinSpaced(n, 1.0, 2.0);
  Vector z(n);
  ASSERT_TRUE(learnt.factorise(0.0));
  learnt.apply(matrix * x, z);
  EXPECT_LT((z - x).norm(), 1e-10 * x.norm());
  // And on it again, where a shift has made it large.
  ASSERT_TRUE(learnt.factorise(100.0));
  learnt.apply(matrix * x + 100.0 * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
}

TEST(LearntJacobian, ChoosesPivotsWhereThoseOnTheDiagonalSpoilTheDigits) {
  // Pivots of 1e-14 in a matrix of condition one or so: without others no digit would be left.
  constexpr int n = 60;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i % 2 == 0 ? i + 1 : i - 1, 1.0);
    entries.emplace_back(i, i, 1e-14);
  }
  Sparse matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  LearntJacobian learnt;
  learn(learnt, matrix, {20, 21});
  const Vector x = Vector::LinSpaced(n, 1.0, 2.0);
  Vector z(n);
  ASSERT_TRUE(learnt.factorise(0.0));
  learnt.apply(matrix * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
}

}  // namespace

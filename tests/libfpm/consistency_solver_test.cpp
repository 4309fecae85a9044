// The matrix of the consistency correction by its factors against its definition, and its solvers.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

#include "consistency_solver.hpp"
#include "consistency_system.hpp"

namespace {

using fpm::Index;
using fpm::detail::ConsistencySolver;
using fpm::detail::ConsistencySystem;
using fpm::detail::SolutionMethod;

// A row amid neighbours anywhere, some of which are images: of other particles, of one that is a
// neighbour itself, of the row.
template <int Dim>
struct SomeRow {
  std::vector<Index> unknown;
  std::vector<double> sign;
  fpm::RowGeometry<Dim> geometry;
  fpm::RowWeights<Dim> weights;
  double factor = 0.0;

  SomeRow(Index own, Index unknowns, std::mt19937& generator) {
    constexpr Index count = 9;
    std::uniform_real_distribution<double> place(-1.0, 1.0);
    std::uniform_real_distribution<double> weight(0.1, 1.0);
    std::uniform_int_distribution<Index> any(0, unknowns - 1);
    unknown = {own};
    sign = {1.0};
    for (Index k = 0; k < count; ++k) {
      unknown.push_back(k == 0 ? own : any(generator));
      sign.push_back(k < 3 ? -1.0 : 1.0);
    }
    unknown.back() = unknown[2];
    geometry.offset.resize(Dim, count);
    weights.kappa.resize(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      for (int i = 0; i < Dim; ++i) geometry.offset(i, k) = place(generator);
      weights.kappa[k] = weight(generator);
    }
    factor = weight(generator);
  }

  // factor * D^T T^T diag(kappa) T D, D of the differences that the neighbours have to the row.
  Eigen::MatrixXd part(Index unknowns) const {
    const Eigen::Index count = geometry.size();
    Eigen::MatrixXd difference = Eigen::MatrixXd::Zero(count, unknowns);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k) + 1;
      difference(k, unknown[i]) += sign[i];
      difference(k, unknown[0]) -= 1.0;
    }
    const Eigen::MatrixXd kappa = weights.kappa.asDiagonal();
    const Eigen::MatrixXd x = geometry.offset;
    const Eigen::MatrixXd linear =
        x.transpose() * (x * kappa * x.transpose()).inverse() * x * kappa;
    const Eigen::MatrixXd remainder =
        (Eigen::MatrixXd::Identity(count, count) - linear) * difference;
    return factor * remainder.transpose() * kappa * remainder;
  }
};

template <int Dim>
void expect_the_definition() {
  constexpr Index unknowns = 20;
  std::mt19937 generator(11);
  ConsistencySystem<Dim> system(unknowns);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const Index own : {3, 4, 4, 7, 19}) {
    const SomeRow<Dim> row(own, unknowns, generator);
    system.add(row.unknown, row.sign, row.geometry, row.weights, row.factor);
    expected += row.part(unknowns);
  }
  const Eigen::SparseMatrix<double> lower = system.lower();
  const Eigen::MatrixXd whole =
      lower.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd::Identity(unknowns, unknowns);
  EXPECT_LE((whole - expected).norm(), 1e-13 * expected.norm());
  for (Index k = 0; k < unknowns; ++k) {
    ASSERT_GT(lower.outerIndexPtr()[k + 1], lower.outerIndexPtr()[k]);
    EXPECT_EQ(lower.innerIndexPtr()[lower.outerIndexPtr()[k]], k);  // the diagonal comes first
  }
}

TEST(ConsistencySystem, IsTheSumOfItsRows) {
  expect_the_definition<2>();
  expect_the_definition<3>();
}

// Second differences along a line, squared: as S, it leaves what is linear alone.
Eigen::SparseMatrix<double> squared_second_differences(Index n) {
  Eigen::SparseMatrix<double> differences(n - 2, n);
  for (Index k = 0; k < n - 2; ++k) {
    differences.insert(k, k) = 1.0;
    differences.insert(k, k + 1) = -2.0;
    differences.insert(k, k + 2) = 1.0;
  }
  const Eigen::SparseMatrix<double> square = differences.transpose() * differences;
  return square.triangularView<Eigen::Lower>();
}

constexpr double tolerance = 1e-10;

class ConsistencySolvers : public testing::TestWithParam<SolutionMethod> {};

TEST_P(ConsistencySolvers, ReachTheToleranceInTheRange) {
  constexpr Index n = 60;
  const Eigen::SparseMatrix<double> lower = squared_second_differences(n);
  const Eigen::VectorXd wanted = Eigen::VectorXd::LinSpaced(n, 0.0, 3.0).array().sin();
  const Eigen::VectorXd b = lower.selfadjointView<Eigen::Lower>() * wanted;
  const auto solution = ConsistencySolver(lower, GetParam()).solve(b, 0.0);
  EXPECT_TRUE(solution.reached);
  EXPECT_EQ(solution.method, GetParam());
  const Eigen::VectorXd left = b - lower.selfadjointView<Eigen::Lower>() * solution.x;
  EXPECT_LE(left.norm(), tolerance * b.norm());
  EXPECT_DOUBLE_EQ(left.norm(), solution.residual);
}

TEST_P(ConsistencySolvers, LeaveWhatIsRoundOffAlone) {
  constexpr Index n = 60;
  ConsistencySolver solver(squared_second_differences(n), GetParam());
  for (const double size : {0.0, 1e-3}) {
    const auto solution = solver.solve(Eigen::VectorXd::Unit(n, 7) * size, 1e-2);
    EXPECT_TRUE(solution.reached);
    EXPECT_EQ(solution.method, GetParam());
    EXPECT_EQ(solution.residual, size);
  }
}

TEST_P(ConsistencySolvers, SayWhatIsNotInTheRange) {
  constexpr Index n = 60;
  const auto solution = ConsistencySolver(squared_second_differences(n), GetParam())
                            .solve(Eigen::VectorXd::Ones(n), 0.0);
  EXPECT_FALSE(solution.reached);
  // A constant is orthogonal to the range: nothing of it can be removed.
  EXPECT_NEAR(solution.residual, std::sqrt(n), 1e-6 * std::sqrt(n));
}

INSTANTIATE_TEST_SUITE_P(Both, ConsistencySolvers,
                         testing::Values(SolutionMethod::factors,
                                         SolutionMethod::conjugate_gradients));

}  // namespace

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <set>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::BlockJacobi;
using jfnk::ColouredJacobian;
using jfnk::Options;
using jfnk::Vector;
using jfnk_test::Sparse;

TEST(Coloured, NoTwoColumnsOfAColourShareARow) {
  const Sparse matrix = jfnk_test::laplacian(9);
  const std::vector<int> colour = jfnk::colour_columns(matrix);
  const Eigen::MatrixXd dense(matrix);
  for (Eigen::Index row = 0; row < dense.rows(); ++row) {
    std::set<int> met;
    for (Eigen::Index column = 0; column < dense.cols(); ++column) {
      if (dense(row, column) == 0.0) continue;
      EXPECT_TRUE(met.insert(colour[static_cast<std::size_t>(column)]).second);
    }
  }
}

TEST(Coloured, ABandNeedsNoMoreColoursThanItsWidth) {
  const auto colour = jfnk::colour_columns(jfnk::banded_sparsity(50, 2, 3));
  EXPECT_EQ(std::set<int>(colour.begin(), colour.end()).size(), 6u);
}

TEST(Coloured, JacobianIsThatOfTheoryAtThePriceStated) {
  jfnk_test::BratuWithJacobian bratu(7, 5.0);
  ColouredJacobian P(bratu, jfnk_test::laplacian(7));
  const Vector u = Vector::LinSpaced(49, 0.1, 1.0);
  P.setup(u);
  EXPECT_TRUE(P.factorised());
  EXPECT_EQ(P.evaluations(), P.colours() + 1);
  bratu.linearise(u);
  Vector Jv(49);
  for (Eigen::Index j = 0; j < 49; ++j) {
    const Vector e = Vector::Unit(49, j);
    bratu.apply_jacobian(e, Jv);
    // A forward difference of a step b |u|: the rounding of F, below 10 rounding units here, over
    // the step, 1.5e-8 * 0.4.
    EXPECT_LE((P.matrix() * e - Jv).cwiseAbs().maxCoeff(), 1e-6);
  }
  Vector z(49);
  P.apply(Jv, z);
  EXPECT_LE((P.matrix() * z - Jv).norm(), 1e-12 * Jv.norm());
}

TEST(Coloured, ServesTheSolverAndIsRefreshedOnlyIfThatPays) {
  const jfnk_test::Bratu bratu(16, 6.7);
  ColouredJacobian P(bratu, jfnk_test::laplacian(16));
  Options options;
  options.setup_cost = P.colours() + 1;
  Vector u = Vector::Zero(256);
  const jfnk::Report report = jfnk::solve(bratu, u, options, P);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_LE(report.counts.preconditioner_setups, 2);
}

TEST(Coloured, TurnsTheStepWhereTheDomainEndsAndRefusesWrongSizes) {
  const auto F = [](const Vector& u, Vector& r) {
    if (u[0] > 1.0) return false;
    r = 3.0 * u;
    return true;
  };
  ColouredJacobian P(F, jfnk::banded_sparsity(3, 0, 0));
  P.setup(Vector::Ones(3));
  EXPECT_NEAR(P.matrix().coeff(0, 0), 3.0, 1e-6);
  EXPECT_THROW(P.setup(Vector::Ones(4)), std::invalid_argument);
  EXPECT_THROW(ColouredJacobian(F, Sparse(3, 4)), std::invalid_argument);
}

TEST(BlockJacobi, InvertsItsBlocksAndSkipsSingularOnes) {
  Sparse matrix(6, 6);
  std::vector<Eigen::Triplet<double>> entries = {{0, 0, 2.0}, {0, 1, 1.0}, {1, 0, 1.0},
                                                 {1, 1, 3.0}, {2, 2, 4.0}, {3, 3, 5.0},
                                                 {0, 5, 9.0}, {4, 4, 1.0}, {4, 5, 1.0}};
  matrix.setFromTriplets(entries.begin(), entries.end());
  const BlockJacobi P(matrix, 2);
  EXPECT_EQ(P.singular_blocks(), 1);
  Vector r(6);
  r << 3, 4, 4, 5, 7, 8;
  Vector z;
  P.apply(r, z);
  Vector expected(6);
  expected << 1, 1, 1, 1, 7, 8;
  EXPECT_LE((z - expected).norm(), 1e-14);
  EXPECT_THROW(BlockJacobi(matrix, 4), std::invalid_argument);
  EXPECT_THROW(BlockJacobi(Sparse(4, 6), 2), std::invalid_argument);
}

TEST(BiCGStab, AgreesWithGmresAndCountsItsApplications) {
  const Sparse A = jfnk_test::laplacian(12);
  const Vector b = Vector::LinSpaced(144, 1.0, -2.0);
  int applications = 0;
  const auto op = [&](const Vector& v, Vector& Av) {
    ++applications;
    Av = A * v;
  };
  jfnk::GmresOptions options;
  options.max_iterations = 400;
  options.relative_tolerance = 1e-10;
  Vector x(144);
  const jfnk::GmresResult result = jfnk::bicgstab(op, b, x, options);
  EXPECT_EQ(result.status, jfnk::KrylovStatus::converged);
  EXPECT_EQ(result.iterations, applications);
  // The recurrence may drift from the true residual by the rounding of its largest member.
  EXPECT_LE((b - A * x).norm(), 1e-9 * b.norm());

  const jfnk_test::CholeskyPreconditioner P(A);
  const jfnk::GmresResult preconditioned = jfnk::bicgstab(op, b, x, options, P);
  EXPECT_LE(preconditioned.iterations, 2);
  EXPECT_LE((b - A * x).norm(), 1e-9 * b.norm());
}

TEST(BiCGStab, EndsHonestlyAtItsLimitAndAtASingularMatrix) {
  const auto op = [](const Vector& v, Vector& Av) { Av = Vector::Unit(3, 0) * v.sum(); };
  const Vector b = Vector::Ones(3);
  Vector x(3);
  jfnk::GmresOptions options;
  options.max_iterations = 50;
  const auto singular = jfnk::bicgstab(op, b, x, options);
  EXPECT_NE(singular.status, jfnk::KrylovStatus::converged);
  EXPECT_TRUE(x.allFinite());
  Vector Ax(3);
  op(x, Ax);
  EXPECT_LE((b - Ax).norm(), b.norm() * (1.0 + 1e-14));
}

TEST(BiCGStab, ServesNewton) {
  const jfnk_test::Bratu bratu(16, 6.0);
  Options options = jfnk::newton_krylov();
  options.krylov.solver = jfnk::Krylov::Solver::bicgstab;
  Vector u = Vector::Zero(256);
  const jfnk::Report report = jfnk::solve(bratu, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_EQ(report.counts.difference_actions, report.krylov_iterations);
}

}  // namespace

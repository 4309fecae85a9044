#include "jfnk/conjugate_gradients.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <string>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::Evaluation;
using jfnk::GmresOptions;
using jfnk::KrylovStatus;
using jfnk::Vector;
using Matrix = Eigen::MatrixXd;

/// Orthogonal, the same each time.
Matrix rotation(int n) {
  std::srand(11);
  return Eigen::HouseholderQR<Matrix>(Matrix::Random(n, n)).householderQ();
}

Matrix with_eigenvalues(const Vector& values) {
  const Matrix q = rotation(static_cast<int>(values.size()));
  return q * values.asDiagonal() * q.transpose();
}

GmresOptions tight() {
  GmresOptions options;
  options.max_iterations = 500;
  options.relative_tolerance = 1e-10;
  return options;
}

// In exact arithmetic they end after as many iterations as A has eigenvalues that differ.
TEST(ConjugateGradients, TakeAnIterationForEachEigenvalue) {
  constexpr int n = 60;
  Vector values(n);
  for (int i = 0; i < n; ++i) values[i] = 1.0 + 3.0 * (i % 4);
  const Matrix A = with_eigenvalues(values);
  const Vector b = Vector::LinSpaced(n, 1.0, -2.0);
  int applications = 0;
  const auto op = [&](const Vector& v, Vector& Av) {
    ++applications;
    Av = A * v;
  };
  Vector x = Vector::Constant(n, 7.0);  // no first guess
  const jfnk::GmresResult result = jfnk::conjugate_gradients(op, b, x, tight());
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 4);
  EXPECT_EQ(applications, 4);
  EXPECT_LE((b - A * x).norm(), 1e-10 * b.norm());
}

// The classical bound on the error in the norm of A: 2 ((sqrt c - 1) / (sqrt c + 1))^k.
TEST(ConjugateGradients, ConvergeAsTheConditionSays) {
  constexpr int m = 16;
  const jfnk_test::Sparse A = jfnk_test::laplacian(m);
  const Matrix dense(A);
  const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(dense).eigenvalues();
  const double root = std::sqrt(eigenvalues.maxCoeff() / eigenvalues.minCoeff());
  const Vector exact = Vector::LinSpaced(m * m, 1.0, -2.0);
  const Vector b = A * exact;
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  const auto norm_of_a = [&](const Vector& v) { return std::sqrt(v.dot(A * v)); };
  for (const int k : {5, 10, 20, 30}) {
    GmresOptions options = tight();
    options.relative_tolerance = 0.0;
    options.max_iterations = k;
    Vector x(m * m);
    const jfnk::GmresResult result = jfnk::conjugate_gradients(op, b, x, options);
    EXPECT_EQ(result.iterations, k);
    EXPECT_LE(norm_of_a(exact - x),
              2.0 * std::pow((root - 1.0) / (root + 1.0), k) * norm_of_a(exact))
        << k;
    EXPECT_NEAR(result.residual_norm, (b - A * x).norm(), 1e-12 * b.norm()) << k;
  }
}

TEST(ConjugateGradients, AreDoneAtOnceWithTheInverse) {
  const jfnk_test::Sparse A = jfnk_test::laplacian(12);
  const Vector b = Vector::LinSpaced(144, 1.0, -2.0);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  const jfnk_test::CholeskyPreconditioner P(A);
  Vector x(144);
  const auto result = jfnk::conjugate_gradients(op, b, x, tight(), P);
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LE((b - A * x).norm(), 1e-10 * b.norm());
}

TEST(ConjugateGradients, SayThatAMatrixIsIndefinite) {
  Vector values = Vector::LinSpaced(20, 1.0, 5.0);
  values[3] = -1.0;
  const Matrix A = with_eigenvalues(values);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  const Vector b = rotation(20).col(3) + 0.1 * rotation(20).col(7);
  Vector x(20);
  EXPECT_EQ(jfnk::conjugate_gradients(op, b, x, tight()).status, KrylovStatus::indefinite);
  EXPECT_TRUE(x.allFinite());
  const auto identity = [](const Vector& v, Vector& Av) { Av = v; };
  const auto negative = [](const Vector& r, Vector& z) { z = -r; };
  EXPECT_EQ(jfnk::conjugate_gradients(identity, b, x, tight(), negative).status,
            KrylovStatus::indefinite);
}

TEST(ConjugateGradients, SolveASingularSystemWhoseRightSideIsInItsRange) {
  Vector values = Vector::LinSpaced(20, 1.0, 5.0);
  values[3] = 0.0;
  const Matrix A = with_eigenvalues(values);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  const Vector b = A * Vector::LinSpaced(20, -1.0, 2.0);
  Vector x(20);
  const auto result = jfnk::conjugate_gradients(op, b, x, tight());
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_LE((b - A * x).norm(), 1e-9 * b.norm());
}

TEST(ConjugateGradients, EndWhereTheOperatorDoes) {
  const Vector b = Vector::LinSpaced(10, 1.0, 2.0);
  for (const Evaluation answer : {Evaluation::stop, Evaluation::out_of_domain}) {
    int calls = 0;
    const auto op = [&](const Vector& v, Vector& Av) {
      Av = Vector::LinSpaced(10, 1.0, 5.0).cwiseProduct(v);
      return ++calls == 3 ? answer : Evaluation::ok;
    };
    Vector x(10);
    const auto result = jfnk::conjugate_gradients(op, b, x, tight());
    EXPECT_EQ(result.status,
              answer == Evaluation::stop ? KrylovStatus::stopped : KrylovStatus::operator_failed);
    EXPECT_EQ(result.iterations, 3);
    EXPECT_LT(result.residual_norm, b.norm());  // of two iterations
  }
  const auto nan = [](const Vector& v, Vector& Av) {
    Av = v * std::numeric_limits<double>::quiet_NaN();
  };
  Vector x(10);
  EXPECT_EQ(jfnk::conjugate_gradients(nan, b, x, tight()).status, KrylovStatus::operator_failed);
  EXPECT_EQ(x, Vector::Zero(10));
}

TEST(ConjugateGradients, AreDoneWithNothing) {
  const auto op = [](const Vector& v, Vector& Av) { Av = v; };
  Vector x = Vector::Ones(4);
  const auto result = jfnk::conjugate_gradients(op, Vector::Zero(4), x, tight());
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(x, Vector::Zero(4));
  Vector other(3);
  EXPECT_THROW(jfnk::conjugate_gradients(op, Vector::Zero(4), other, tight()),
               std::invalid_argument);
}

TEST(ConjugateGradients, DoNotKnowTheUnitOfTheRightSide) {
  const jfnk_test::Sparse A = jfnk_test::laplacian(8);
  const auto op = [&](const Vector& v, Vector& Av) { Av = A * v; };
  for (const double unit : {1e-165, 1e160}) {
    const Vector b = unit * Vector::LinSpaced(64, 1.0, -2.0);
    Vector x(64);
    EXPECT_EQ(jfnk::conjugate_gradients(op, b, x, tight()).status, KrylovStatus::converged) << unit;
    EXPECT_LE((b - A * x).stableNorm(), 1e-10 * b.stableNorm()) << unit;
  }
}

// Regular, but of the other sign: what is said is not that it is singular.
TEST(ConjugateGradients, TellNewtonThatAJacobianIsNegative) {
  const auto F = [](const Vector& u, Vector& r) {
    r = -3.0 * u - u.cwiseProduct(u).cwiseProduct(u) + Vector::LinSpaced(u.size(), 1.0, 2.0);
  };
  jfnk::Options options = jfnk::newton_krylov();
  options.learning.enabled = false;
  options.krylov.solver = jfnk::Krylov::Solver::conjugate_gradients;
  Vector u = Vector::Zero(20);
  const jfnk::Report report = jfnk::solve(F, u, options);
  EXPECT_FALSE(report.converged());
  EXPECT_EQ(report.trouble, jfnk::Trouble::indefinite) << report.reason;
  EXPECT_NE(report.reason.find("not positive definite"), std::string::npos) << report.reason;
}

TEST(ConjugateGradients, HoldFourVectors) {
  jfnk::ConjugateGradients solver;
  solver.resize(1000, true);
  EXPECT_EQ(solver.bytes(), 4 * 1000 * sizeof(double));
  solver.resize(1000, false);
  EXPECT_EQ(solver.bytes(), 3 * 1000 * sizeof(double));
}

// Below its fold the Jacobian of Bratu's problem is that of an energy with a minimum.
TEST(ConjugateGradients, ServeNewton) {
  const jfnk_test::Bratu bratu(16, 6.0);
  jfnk::Options options = jfnk::newton_krylov();
  options.krylov.solver = jfnk::Krylov::Solver::conjugate_gradients;
  Vector u = Vector::Zero(256);
  const jfnk::Report report = jfnk::solve(bratu, u, options);
  EXPECT_TRUE(report.converged()) << report.reason;
  options.krylov.solver = jfnk::Krylov::Solver::gmres;
  Vector v = Vector::Zero(256);
  ASSERT_TRUE(jfnk::solve(bratu, v, options).converged());
  EXPECT_LE((u - v).norm(), 1e-5 * v.norm());
}

}  // namespace

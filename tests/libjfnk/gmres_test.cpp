#include "jfnk/gmres.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

namespace {

using jfnk::Evaluation;
using jfnk::gmres;
using jfnk::GmresOptions;
using jfnk::GmresResult;
using jfnk::KrylovStatus;
using jfnk::Vector;
using Matrix = Eigen::MatrixXd;

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

Matrix random_matrix(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  return Matrix::NullaryExpr(n, n, [&](Eigen::Index, Eigen::Index) { return normal(generator); });
}

Vector random_vector(int n, unsigned seed) {
  return random_matrix(n, seed).col(0);
}

/// Nonsymmetric, eigenvalues around 1 within a disc of radius about 1/2.
Matrix clustered_matrix(int n, unsigned seed) {
  return Matrix::Identity(n, n) + 0.5 / std::sqrt(n) * random_matrix(n, seed);
}

struct Product {
  const Matrix& A;
  int applications = 0;
  void operator()(const Vector& v, Vector& Av) {
    ++applications;
    Av.noalias() = A * v;
  }
};

struct Inverse {
  explicit Inverse(const Matrix& A) : lu(A) {}
  void apply(const Vector& r, Vector& z) const { z = lu.solve(r); }
  Eigen::PartialPivLU<Matrix> lu;
};

/// Rounding bound of a computed residual: a few units per operation of a row.
double rounding_bound(const Matrix& A, const Vector& x, const Vector& b) {
  return 10.0 * rounding_unit * static_cast<double>(A.rows()) * (A.norm() * x.norm() + b.norm());
}

TEST(Gmres, ColumnsInSinglePrecisionCostNoIterationAtATolerableTolerance) {
  constexpr int n = 400;
  constexpr double rounding = 0x1p-24;  // of a number to single precision
  const Matrix A = clustered_matrix(n, 3);
  const Vector b = random_vector(n, 4);
  const auto half = [](const Vector& r, Vector& z) { z = 0.5 * r; };
  for (const bool flexible : {false, true}) {
    for (const int restart : {60, 5}) {
      int iterations[2];
      std::size_t bytes[2];
      for (const bool single_precision : {false, true}) {
        GmresOptions options;
        options.restart = restart;
        options.relative_tolerance = 1e-5;
        options.flexible = flexible;
        options.single_precision = single_precision;
        jfnk::Gmres solver;
        Product product{A};
        Vector x = Vector::Zero(n);
        const GmresResult result =
            solver.solve(jfnk::OperatorRef(product), b, x, options, jfnk::PreconditionerRef(half));
        ASSERT_EQ(result.status, KrylovStatus::converged);
        iterations[single_precision ? 1 : 0] = result.iterations;
        bytes[single_precision ? 1 : 0] = solver.bytes();
        // The recurrence knows nothing of the rounding of the columns, each of a part of b.
        const double unknown = result.iterations * (single_precision ? rounding : rounding_unit);
        EXPECT_NEAR((b - A * x).norm(), result.residual_norm, 10 * unknown * b.norm());
      }
      EXPECT_EQ(iterations[1], iterations[0]);
      EXPECT_LT(bytes[1], bytes[0]);
    }
  }
}

TEST(Gmres, SolvesNonsymmetricSystemInAtMostNIterations) {
  constexpr int n = 40;
  const Matrix A = random_matrix(n, 1);
  const Vector b = random_vector(n, 2);
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.restart = n;
  options.max_iterations = n;
  options.relative_tolerance = 1e-10;
  const GmresResult result = gmres(product, b, x, options);
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_LE(result.iterations, n);
  EXPECT_EQ(product.applications, result.iterations);
  EXPECT_LE((b - A * x).norm(), 1e-10 * b.norm() + rounding_bound(A, x, b));
}

TEST(Gmres, ResidualFallsWithEachColumnToTheLeastOfTheKrylovSpace) {
  constexpr int n = 12;
  const Matrix A = random_matrix(n, 3);
  const Vector b = random_vector(n, 4);
  Matrix krylov(n, n);
  krylov.col(0) = b;
  double last = b.norm();
  for (int k = 1; k <= n; ++k) {
    Product product{A};
    Vector x = Vector::Zero(n);
    GmresOptions options;
    options.max_iterations = k;
    options.relative_tolerance = 0.0;
    const GmresResult result = gmres(product, b, x, options);
    EXPECT_LE(result.residual_norm, last * (1.0 + 10.0 * rounding_unit));
    last = result.residual_norm;
    const Matrix image = A * krylov.leftCols(k);
    const Vector y = image.colPivHouseholderQr().solve(b);
    // The power basis loses digits as it grows; 1e-6 ||b|| is far above that at k <= 12.
    EXPECT_NEAR(result.residual_norm, (b - image * y).norm(), 1e-6 * b.norm()) << k;
    if (k < n) krylov.col(k) = (A * krylov.col(k - 1)).normalized();
  }
  EXPECT_LE(last, 1e-10 * b.norm());
}

TEST(Gmres, NeedsOneIterationPerDistinctEigenvalue) {
  constexpr int n = 30;
  Vector eigenvalues(n);
  for (int i = 0; i < n; ++i) eigenvalues[i] = 1.0 + i % 3;
  const Matrix A = eigenvalues.asDiagonal();
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.relative_tolerance = 1e-12;
  const GmresResult result = gmres(product, random_vector(n, 5), x, options);
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 3);
}

TEST(Gmres, ExactInverseAsPreconditionerNeedsOneIteration) {
  constexpr int n = 25;
  const Matrix A = random_matrix(n, 6);
  const Vector b = random_vector(n, 7);
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.relative_tolerance = 1e-9;
  const GmresResult result = gmres(product, b, x, options, Inverse(A));
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LE((b - A * x).norm(), 1e-8 * b.norm());
}

TEST(Gmres, RestartsWithoutHiddenApplications) {
  constexpr int n = 60;
  const Matrix A = clustered_matrix(n, 8);
  const Vector b = random_vector(n, 9);
  for (const bool flexible : {false, true}) {
    Product product{A};
    Vector x = Vector::Zero(n);
    GmresOptions options;
    options.restart = 5;
    options.max_iterations = 200;
    options.relative_tolerance = 1e-10;
    options.flexible = flexible;
    const Matrix near = A + 0.05 * random_matrix(n, 10) / std::sqrt(n);
    const GmresResult result = gmres(product, b, x, options, Inverse(near));
    EXPECT_EQ(result.status, KrylovStatus::converged);
    EXPECT_GT(result.iterations, 5);
    EXPECT_EQ(product.applications, result.iterations);
    EXPECT_NEAR((b - A * x).norm(), result.residual_norm, 1e2 * rounding_bound(A, x, b));
  }
}

TEST(Gmres, NonzeroGuessCostsOneApplication) {
  constexpr int n = 20;
  const Matrix A = clustered_matrix(n, 11);
  const Vector solution = random_vector(n, 12);
  const Vector b = A * solution;
  Product product{A};
  Vector x = solution;
  EXPECT_EQ(gmres(product, b, x).iterations, 0);
  EXPECT_EQ(product.applications, 1);
  x = 0.5 * solution;
  const GmresResult result = gmres(product, b, x);
  EXPECT_EQ(product.applications, 2 + result.iterations);
  EXPECT_LE((x - solution).norm(), 1e-6 * solution.norm());
}

TEST(Gmres, ZeroRightHandSideNeedsNothing) {
  const Matrix A = clustered_matrix(4, 13);
  Product product{A};
  Vector x = Vector::Zero(4);
  const GmresResult result = gmres(product, Vector::Zero(4), x);
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(product.applications, 0);
  EXPECT_EQ(x.norm(), 0.0);
}

TEST(Gmres, EndsExactlyWhenTheKrylovSpaceIsInvariant) {
  Matrix A = Matrix::Zero(6, 6);
  A.diagonal() << 3, 1, 2, 4, 5, 6;
  Product product{A};
  Vector x = Vector::Zero(6);
  GmresOptions options;
  options.relative_tolerance = 0.0;
  const GmresResult result = gmres(product, 2.0 * Vector::Unit(6, 0), x, options);
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_NEAR(x[0], 2.0 / 3.0, 4.0 * rounding_unit);
}

TEST(Gmres, SolvesConsistentSingularSystem) {
  Matrix A = Matrix::Zero(3, 3);
  A.diagonal() << 1, 2, 0;
  Product product{A};
  Vector b(3);
  b << 1, 1, 0;
  Vector x = Vector::Zero(3);
  GmresOptions options;
  options.relative_tolerance = 1e-12;
  EXPECT_EQ(gmres(product, b, x, options).status, KrylovStatus::converged);
  EXPECT_NEAR(x[0], 1.0, 1e-12);
  EXPECT_NEAR(x[1], 0.5, 1e-12);
}

TEST(Gmres, InconsistentSystemEndsInBreakdownAtTheLeastResidual) {
  Matrix A = Matrix::Zero(3, 3);
  A.diagonal() << 1, 2, 0;
  Product product{A};
  Vector x = Vector::Zero(3);
  const GmresResult result = gmres(product, Vector::Ones(3), x);
  EXPECT_EQ(result.status, KrylovStatus::breakdown);
  EXPECT_NEAR(result.residual_norm, 1.0, 1e-12);
  EXPECT_NEAR((Vector::Ones(3) - A * x).norm(), 1.0, 1e-12);
}

TEST(Gmres, NilpotentMatrixGivesAFiniteAnswerAndBreakdown) {
  Matrix A = Matrix::Zero(3, 3);
  A(1, 0) = 1.0;
  A(2, 1) = 1.0;
  Product product{A};
  Vector x = Vector::Zero(3);
  const GmresResult result = gmres(product, Vector::Unit(3, 0), x);
  EXPECT_EQ(result.status, KrylovStatus::breakdown);
  EXPECT_TRUE(x.allFinite());
  EXPECT_NEAR(result.residual_norm, 1.0, 1e-14);
}

TEST(Gmres, ZeroMatrixEndsInBreakdownWithoutDirection) {
  const Matrix A = Matrix::Zero(3, 3);
  Product product{A};
  Vector x = Vector::Zero(3);
  EXPECT_EQ(gmres(product, Vector::Ones(3), x).status, KrylovStatus::breakdown);
  EXPECT_EQ(x.norm(), 0.0);
  EXPECT_EQ(product.applications, 1);
}

// The cyclic shift keeps ||r|| = ||b|| for n - 1 iterations (Nachtigal, Reddy & Trefethen 1992).
TEST(Gmres, CyclicShiftStagnatesUnlessTheBasisIsFull) {
  constexpr int n = 8;
  Matrix A = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) A((i + 1) % n, i) = 1.0;
  for (const int restart : {n - 1, n}) {
    Product product{A};
    Vector x = Vector::Zero(n);
    GmresOptions options;
    options.restart = restart;
    options.max_iterations = 100;
    const GmresResult result = gmres(product, Vector::Unit(n, 0), x, options);
    EXPECT_EQ(result.status, restart == n ? KrylovStatus::converged : KrylovStatus::stagnated);
    EXPECT_EQ(result.iterations, restart);
  }
}

TEST(Gmres, IterationCapStillGivesADirection) {
  constexpr int n = 40;
  const Matrix A = clustered_matrix(n, 14);
  const Vector b = random_vector(n, 15);
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.max_iterations = 3;
  options.relative_tolerance = 1e-14;
  const GmresResult result = gmres(product, b, x, options);
  EXPECT_EQ(result.status, KrylovStatus::max_iterations);
  EXPECT_EQ(result.iterations, 3);
  EXPECT_NEAR((b - A * x).norm(), result.residual_norm, rounding_bound(A, x, b));
  EXPECT_LT(result.relative_residual, 1.0);
}

TEST(Gmres, FlexibleFormAllowsThePreconditionerToVary) {
  struct Varying {
    const Inverse& inverse;
    int calls = 0;
    void apply(const Vector& r, Vector& z) {
      z = inverse.lu.solve(r);
      z *= ++calls % 2 == 0 ? 1.0 : -3.0;
      z += 0.1 * r;
    }
  };
  constexpr int n = 30;
  const Matrix A = clustered_matrix(n, 16);
  const Inverse inverse(A);
  const Vector b = random_vector(n, 17);
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.flexible = true;
  options.relative_tolerance = 1e-10;
  const GmresResult result = gmres(product, b, x, options, Varying{inverse});
  EXPECT_EQ(result.status, KrylovStatus::converged);
  EXPECT_LE((b - A * x).norm(), 1e-10 * b.norm() + rounding_bound(A, x, b));
}

TEST(Gmres, FailingOperatorLeavesTheIterateOfTheColumnsBefore) {
  constexpr int n = 20;
  const Matrix A = clustered_matrix(n, 18);
  const Vector b = random_vector(n, 19);
  Vector expected = Vector::Zero(n);
  GmresOptions options;
  options.max_iterations = 4;
  (void)gmres(Product{A}, b, expected, options);

  options.max_iterations = 20;
  for (const Evaluation answer : {Evaluation::out_of_domain, Evaluation::stop, Evaluation::ok}) {
    int calls = 0;
    auto failing = [&](const Vector& v, Vector& Av) {
      Av.noalias() = A * v;
      if (++calls < 5) return Evaluation::ok;
      Av[3] = std::numeric_limits<double>::quiet_NaN();
      return answer;
    };
    Vector x = Vector::Zero(n);
    const GmresResult result = gmres(failing, b, x, options);
    EXPECT_EQ(result.status,
              answer == Evaluation::stop ? KrylovStatus::stopped : KrylovStatus::operator_failed);
    EXPECT_EQ(result.iterations, 4);
    EXPECT_TRUE((x.array() == expected.array()).all());
  }
}

TEST(Gmres, DoesNotDependOnTheUnits) {
  constexpr int n = 15;
  const Matrix A = clustered_matrix(n, 20);
  const Vector b = random_vector(n, 21);
  Vector reference = Vector::Zero(n);
  const GmresResult plain = gmres(Product{A}, b, reference);
  for (const double unit : {1e-200, 1e200}) {
    const Matrix scaled = unit * A;
    Vector x = Vector::Zero(n);
    const GmresResult result = gmres(Product{scaled}, unit * b, x);
    EXPECT_EQ(result.status, KrylovStatus::converged);
    EXPECT_EQ(result.iterations, plain.iterations);
    EXPECT_LE((x - reference).norm(), 1e-12 * reference.norm());
  }
}

TEST(Gmres, MinimisesInTheGivenInnerProduct) {
  struct Weighted {
    Vector weights;
    double dot(const Vector& a, const Vector& b) const {
      return (a.array() * weights.array() * b.array()).sum();
    }
  };
  constexpr int n = 10;
  const Matrix A = random_matrix(n, 22);
  const Vector b = random_vector(n, 23);
  const Weighted weighted{Vector::LinSpaced(n, 1.0, 50.0)};
  Product product{A};
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.max_iterations = 1;
  jfnk::Gmres solver;
  const GmresResult result =
      solver.solve(jfnk::OperatorRef(product), b, x, options, {}, jfnk::InnerProductRef(weighted));
  const Vector image = A * b;
  const double best = weighted.dot(image, b) / weighted.dot(image, image);
  const Vector rest = b - best * image;
  EXPECT_NEAR(result.residual_norm, std::sqrt(weighted.dot(rest, rest)), 1e-12 * b.norm());
  EXPECT_LE((x - best * b).norm(), 1e-12 * b.norm());
}

// The Hilbert matrix exhausts double precision: without a second sweep the basis would lose
// orthogonality and the recurrence would report a residual that is not there.
TEST(Gmres, RecurrenceStaysHonestOnAnIllConditionedMatrix) {
  constexpr int n = 14;
  const Matrix A = Matrix::NullaryExpr(
      n, n, [](Eigen::Index i, Eigen::Index j) { return 1.0 / static_cast<double>(i + j + 1); });
  const Vector b = A * Vector::Ones(n);
  Vector x = Vector::Zero(n);
  GmresOptions options;
  options.relative_tolerance = 1e-12;
  const GmresResult result = gmres(Product{A}, b, x, options);
  EXPECT_NEAR((b - A * x).norm(), result.residual_norm, rounding_bound(A, x, b));
}

TEST(Gmres, RefusesMisuseWithBothNumbers) {
  Vector x = Vector::Zero(3);
  const Matrix A = Matrix::Identity(4, 4);
  try {
    (void)gmres(Product{A}, Vector::Ones(4), x);
    FAIL() << "sizes 4 and 3 were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "jfnk::Gmres: b has size 4, x has size 3");
  }
  GmresOptions options;
  options.restart = 0;
  options.max_iterations = 0;
  options.relative_tolerance = 1.0;
  options.absolute_tolerance = -1.0;
  EXPECT_EQ(jfnk::validate(options).size(), 4u);
  x = Vector::Zero(4);
  EXPECT_THROW((void)gmres(Product{A}, Vector::Ones(4), x, options), std::invalid_argument);
}

}  // namespace

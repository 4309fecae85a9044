#include "secant_memory.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using jfnk::InnerProductRef;
using jfnk::Vector;
using jfnk::detail::SecantMemory;

constexpr double loose_condition = 1e6;
constexpr double rounding_unit = std::numeric_limits<double>::epsilon();
const InnerProductRef euclidean;

class Randoms {
 public:
  Vector vector(int n) {
    return Vector::NullaryExpr(n, [this](Eigen::Index) { return normal_(generator_); });
  }

 private:
  std::mt19937 generator_{7};
  std::normal_distribution<double> normal_;
};

void add(SecantMemory& memory, const Vector& du, const Vector& dr, const Vector* image = nullptr) {
  memory.add({du, dr, euclidean.norm(dr), image}, loose_condition, euclidean);
}

/// The columns that a memory holds.
Eigen::MatrixXd columns_of(const SecantMemory& memory, int n) {
  Eigen::MatrixXd Y(n, memory.size());
  Vector y;
  for (int j = 0; j < memory.size(); ++j) {
    memory.copy_column(j, y);
    Y.col(j) = y;
  }
  return Y;
}

TEST(SecantMemory, ProjectionIsTheLeastSquaresSolutionOfTheLastPairs) {
  constexpr int n = 30;
  constexpr int capacity = 6;
  Randoms random;
  SecantMemory memory;
  memory.resize(n, capacity);
  std::vector<Vector> dus;
  std::vector<Vector> drs;
  for (int k = 0; k < 25; ++k) {
    dus.push_back(random.vector(n));
    drs.push_back(std::pow(10.0, -k) * random.vector(n));
    add(memory, dus.back(), drs.back());
    const int kept = std::min(k + 1, capacity);
    ASSERT_EQ(memory.size(), kept);
    Eigen::MatrixXd dU(n, kept);
    Eigen::MatrixXd dR(n, kept);
    for (int j = 0; j < kept; ++j) {
      const auto at = static_cast<std::size_t>(k + 1 - kept + j);
      dU.col(j) = dus[at] / drs[at].norm();
      dR.col(j) = drs[at] / drs[at].norm();
    }
    const Vector r = random.vector(n);
    const Vector gamma = dR.householderQr().solve(r);
    Vector step(n);
    Vector remainder(n);
    memory.project(r, step, remainder, euclidean);
    // Random columns have a condition number of a few; 1e4 units cover its square and 30 rows.
    EXPECT_LE((step + dU * gamma).norm(), 1e4 * rounding_unit * dU.norm() * gamma.norm()) << k;
    EXPECT_LE((remainder - (r - dR * gamma)).norm(), 1e4 * rounding_unit * r.norm()) << k;
  }
}

TEST(SecantMemory, KnowsHowManyOfThoseGivenAreLeft) {
  constexpr int n = 30, capacity = 6, given = 4;
  Randoms random;
  SecantMemory memory;
  memory.resize(n, capacity);
  Eigen::MatrixXf du(n, given), dr(n, given);
  for (int j = 0; j < given; ++j) {
    du.col(j) = random.vector(n).cast<float>();
    dr.col(j) = random.vector(n).cast<float>();
  }
  memory.begin_with(du, dr, loose_condition, euclidean);
  for (int added = 1; added <= 7; ++added) {
    add(memory, random.vector(n), random.vector(n));
    EXPECT_EQ(memory.given(), std::clamp(capacity - added, 0, given)) << added;
  }
}

TEST(SecantMemory, IsAsGoodAfterAThousandUpdatesAsItsConditionAllows) {
  constexpr int n = 1500;  // more than a block of rows
  constexpr int updates = 1000;
  for (const bool single_precision : {false, true}) {
    Randoms random;
    SecantMemory memory;
    memory.resize(n, 10, single_precision);
    Vector drift = random.vector(n);
    for (int k = 0; k < updates; ++k) {
      drift += 0.05 * random.vector(n);  // successive columns nearly parallel
      add(memory, drift, drift);
    }
    ASSERT_EQ(memory.size(), 10);
    const Eigen::MatrixXd Y = columns_of(memory, n);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> gram(Y.transpose() * Y);
    const double condition = std::sqrt(gram.eigenvalues()[9] / gram.eigenvalues()[0]);
    ASSERT_GT(condition, 50.0);
    const Vector r = random.vector(n);
    Vector step(n);
    Vector remainder(n);
    memory.project(r, step, remainder, euclidean);
    const Vector gamma = Y.householderQr().solve(r);
    // Of the normal equations; a hundred sums of 1500 terms each.
    const double allowed = 100 * rounding_unit * condition * condition * r.norm();
    EXPECT_LE((remainder - (r - Y * gamma)).norm(), allowed) << single_precision;
    EXPECT_LE((Y.transpose() * remainder).cwiseAbs().maxCoeff(), allowed) << single_precision;
  }
}

TEST(SecantMemory, RoundsPairsToSinglePrecisionAndNothingElse) {
  constexpr int n = 50;
  constexpr double rounding = 0x1p-24;  // of a number to single precision
  Randoms random;
  SecantMemory exact;
  SecantMemory rounded;
  exact.resize(n, 8, false);
  rounded.resize(n, 8, true);
  for (int k = 0; k < 20; ++k) {
    const Vector du = random.vector(n);
    const Vector dr = random.vector(n);
    add(exact, du, dr);
    add(rounded, du, dr);
  }
  const Eigen::MatrixXd Y = columns_of(exact, n);
  const Eigen::MatrixXd rounded_Y = columns_of(rounded, n);
  EXPECT_EQ(rounded_Y, Y.cast<float>().cast<double>());
  const Vector r = random.vector(n);
  Vector step(n);
  Vector remainder(n);
  Vector of_rounded(n);
  rounded.project(r, step, remainder, euclidean);
  // Least squares of the columns as they are: to round-off in double precision.
  const Vector gamma = rounded_Y.householderQr().solve(r);
  EXPECT_LE((remainder - (r - rounded_Y * gamma)).norm(), 1e4 * rounding_unit * r.norm());
  const Vector by_rounded = step;
  exact.project(r, step, remainder, euclidean);
  // Columns of a condition below ten, eight of them, each rounded once with each du.
  EXPECT_GT((by_rounded - step).norm(), 0.0);
  EXPECT_LE((by_rounded - step).norm(), 8 * 2 * 10 * rounding * step.norm());
  EXPECT_LT(rounded.bytes(), 0.6 * static_cast<double>(exact.bytes()));
}

TEST(SecantMemory, PairsWhoseFactorsAreKnownAreAsGoodAsOthers) {
  constexpr int n = 40;
  constexpr int count = 6;
  Randoms random;
  Eigen::MatrixXd columns(n, count);
  for (int j = 0; j < count; ++j) columns.col(j) = random.vector(n) + 3.0 * Vector::Ones(n);
  const Eigen::HouseholderQR<Eigen::MatrixXd> factored(columns);
  const Eigen::MatrixXd Q = factored.householderQ() * Eigen::MatrixXd::Identity(n, count);
  const Eigen::MatrixXd R = factored.matrixQR().topRows(count).triangularView<Eigen::Upper>();
  std::vector<Vector> qs;
  for (int j = 0; j < count; ++j) qs.push_back(Q.col(j));
  for (const bool single_precision : {false, true}) {
    SecantMemory memory;
    memory.resize(n, count, single_precision);
    jfnk::detail::ColumnList list;
    for (int j = 0; j < count; ++j) {
      list.add(qs[static_cast<std::size_t>(j)]);
      ASSERT_TRUE(
          memory.append(random.vector(n), list, R.col(j).head(j + 1), loose_condition, euclidean));
    }
    const Eigen::MatrixXd Y = columns_of(memory, n);
    EXPECT_LE((Y - columns * columns.colwise().norm().cwiseInverse().asDiagonal()).norm(),
              single_precision ? 1e-6 : 1e-13);
    const Vector r = random.vector(n);
    Vector step(n);
    Vector remainder(n);
    memory.project(r, step, remainder, euclidean);
    // Of the columns as they are kept, rounded or not.
    const Vector expected = r - Y * Y.householderQr().solve(r);
    EXPECT_LE((remainder - expected).norm(), 1e4 * rounding_unit * r.norm()) << single_precision;
  }
}

TEST(SecantMemory, EmptyMemoryLeavesTheResidual) {
  SecantMemory memory;
  memory.resize(3, 2);
  const Vector r = Vector::Ones(3);
  Vector step(3);
  Vector remainder(3);
  memory.project(r, step, remainder, euclidean);
  EXPECT_EQ(step.norm(), 0.0);
  EXPECT_TRUE((remainder.array() == r.array()).all());
}

TEST(SecantMemory, DropsOldPairsThatMakeTheColumnsDependent) {
  Randoms random;
  SecantMemory memory;
  memory.resize(20, 5);
  const Vector first = random.vector(20);
  const Vector second = random.vector(20);
  add(memory, first, first);
  add(memory, second, second);
  const Vector repeated = second + 1e-12 * first;
  add(memory, repeated, 2.0 * repeated);
  EXPECT_EQ(memory.size(), 1);
  Vector step(20);
  Vector remainder(20);
  memory.project(repeated, step, remainder, euclidean);
  EXPECT_LE((step + 0.5 * repeated).norm(), 1e-12 * repeated.norm());
}

TEST(SecantMemory, IgnoresPairsWithoutADifference) {
  SecantMemory memory;
  memory.resize(4, 3);
  add(memory, Vector::Ones(4), Vector::Zero(4));
  add(memory, Vector::Ones(4), Vector::Constant(4, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(memory.size(), 0);
}

TEST(SecantMemory, HoldsNoMorePairsThanUnknowns) {
  Randoms random;
  SecantMemory memory;
  memory.resize(3, 20);
  for (int k = 0; k < 10; ++k) {
    add(memory, random.vector(3), random.vector(3));
  }
  EXPECT_LE(memory.size(), 3);
  const Vector r = random.vector(3);
  Vector step(3);
  Vector remainder(3);
  memory.project(r, step, remainder, euclidean);
  EXPECT_TRUE(step.allFinite());
}

TEST(SecantMemory, ImagesAreThoseOfTheColumnsThroughAHundredPairs) {
  constexpr int n = 40;
  constexpr double mixing = 0.7;
  // The pairs come and go at a condition of a few; as above.
  constexpr double tolerance = 1e4 * rounding_unit;
  Randoms random;
  Eigen::MatrixXd P = Eigen::MatrixXd::Random(n, n);
  SecantMemory memory;
  memory.resize(n, 6);
  memory.clear(true);
  const auto expect_projection = [&](int k) {
    const Vector r = random.vector(n);
    Vector z(n);
    Vector step(n);
    Vector remainder(n);
    memory.invert(r, P * r, mixing, 1.0, z, euclidean);
    memory.project(r, step, remainder, euclidean);
    const Vector expected = mixing * (P * remainder) - step;
    EXPECT_LE((z - expected).norm(), tolerance * (P.norm() * r.norm() + step.norm())) << k;
  };
  for (int k = 0; k < 100; ++k) {
    const Vector dr = random.vector(n);
    const Vector image = P * dr;
    add(memory, random.vector(n), dr, &image);
    expect_projection(k);
  }
  P = Eigen::MatrixXd::Random(n, n);
  memory.forget_images();
  ASSERT_TRUE(memory.images_are_old());
  add(memory, random.vector(n), random.vector(n));
  memory.renew_images([&](const Vector& y, Vector& z) { z = P * y; });
  expect_projection(100);
}

/// Of two memories given the same pairs, one is told beforehand what it will be asked for.
TEST(SecantMemory, ProductsFoundOnTheWayAreThoseFoundWhenAsked) {
  constexpr int n = 40;
  Randoms random;
  SecantMemory told;
  SecantMemory asked;
  for (SecantMemory* memory : {&told, &asked}) memory->resize(n, 6, true);
  const auto project = [](SecantMemory& memory, const Vector& r) {
    Vector step;
    Vector remainder;
    memory.project(r, step, remainder, euclidean);
    return step;
  };
  const auto add_to_both = [&](const Vector& dr, const Vector& next) {
    const Vector du = random.vector(n);
    told.add({.du = du, .dr = dr, .length = dr.norm(), .next = &next}, loose_condition, euclidean);
    asked.add({.du = du, .dr = dr, .length = dr.norm()}, loose_condition, euclidean);
  };
  const Vector drift = random.vector(n);
  for (int k = 0; k < 30; ++k) {
    // Some that hardly differ from the one before, which makes older ones go.
    const Vector dr = k % 4 == 3 ? Vector(drift + 1e-7 * random.vector(n)) : random.vector(n);
    const Vector next = random.vector(n);
    add_to_both(dr, next);
    ASSERT_EQ(told.size(), asked.size());
    EXPECT_EQ(project(told, next), project(asked, next)) << k;
  }
  const Vector another = random.vector(n);
  add_to_both(random.vector(n), random.vector(n));
  told.forget_next();
  EXPECT_EQ(project(told, another), project(asked, another));
  add_to_both(random.vector(n), random.vector(n));
  add_to_both(Vector::Zero(n), another);  // no pair
  EXPECT_EQ(project(told, another), project(asked, another));
}

TEST(SecantMemory, WithoutImagesInvertsByTheIdentity) {
  constexpr int n = 12;
  Randoms random;
  SecantMemory memory;
  memory.resize(n, 5);
  for (int k = 0; k < 5; ++k) {
    add(memory, random.vector(n), random.vector(n));
  }
  const Vector r = random.vector(n);
  Vector z(n);
  Vector step(n);
  Vector remainder(n);
  memory.invert(r, r, 0.5, 1.0, z, euclidean);
  Vector negative(n);
  memory.invert(r, r, 0.5, -1.0, negative, euclidean);
  EXPECT_EQ(negative, -z);
  memory.project(r, step, remainder, euclidean);
  EXPECT_LE((z - (0.5 * remainder - step)).norm(), 1e4 * rounding_unit * (r.norm() + step.norm()));
}

}  // namespace

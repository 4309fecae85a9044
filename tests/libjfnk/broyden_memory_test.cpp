#include "broyden_memory.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

namespace {

using jfnk::InnerProductRef;
using jfnk::Vector;
using jfnk::detail::BroydenMemory;

constexpr int n = 6;
// A few rounding units of numbers of order one, through some hundred operations.
constexpr double round_off = 1e-12;

Eigen::MatrixXd well_conditioned() {
  Eigen::MatrixXd A = 3.0 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) A(i, j) += std::sin(1.0 + 3.0 * i + 7.0 * j);
  }
  return A;
}

Vector wave(int k) {
  Vector v(n);
  for (int i = 0; i < n; ++i) v[i] = std::cos(0.3 + (k + 1.0) * i);
  return v;
}

struct Broyden {
  Eigen::MatrixXd P;
  BroydenMemory memory;
  InnerProductRef product;

  explicit Broyden(const Eigen::MatrixXd& preconditioner, int capacity = 20) : P(preconditioner) {
    memory.resize(n, capacity);
  }
  [[nodiscard]] Vector apply(const Vector& r) {
    Vector z = P * r;
    memory.improve(z, product);
    return z;
  }
  bool add(const Vector& s, const Vector& y) { return memory.add(s, apply(y), product); }
};

// The textbook update of B = H^-1: B += (y - B s) s^T / s^T s.
TEST(BroydenMemory, IsTheInverseOfBroydensFirstUpdate) {
  const Eigen::MatrixXd J = well_conditioned();
  Eigen::MatrixXd B = 4.0 * Eigen::MatrixXd::Identity(n, n);
  Broyden broyden(B.inverse());
  for (int k = 0; k < 4; ++k) {
    const Vector s = wave(k);
    const Vector y = J * s;
    ASSERT_TRUE(broyden.add(s, y));
    B += (y - B * s) * s.transpose() / s.squaredNorm();
    for (int i = 0; i < n; ++i) {
      const Vector e = Vector::Unit(n, i);
      EXPECT_LE((B * broyden.apply(e) - e).norm(), round_off);
    }
  }
}

TEST(BroydenMemory, LastFactorAloneBringsAnImageUpToDate) {
  Broyden broyden(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd J = well_conditioned();
  ASSERT_TRUE(broyden.add(wave(0), J * wave(0)));
  Vector z = broyden.apply(wave(5));
  ASSERT_TRUE(broyden.add(wave(1), J * wave(1)));
  broyden.memory.improve_by_last(z, broyden.product);
  EXPECT_LE((z - broyden.apply(wave(5))).norm(), round_off);
}

// Gay (1979): on a linear system no more than 2 n steps.
TEST(BroydenMemory, EndsALinearProblemWithinTwoNSteps) {
  const Eigen::MatrixXd J = well_conditioned();
  Broyden broyden(Eigen::MatrixXd::Identity(n, n) / 4.0);
  const Vector b = wave(3);
  Vector u = Vector::Zero(n);
  int steps = 0;
  while ((J * u - b).norm() > 1e-9 * b.norm() && steps <= 2 * n) {
    const Vector s = -broyden.apply(J * u - b);
    ASSERT_TRUE(broyden.add(s, J * s));
    u += s;
    ++steps;
  }
  EXPECT_LE(steps, 2 * n);
}

// dr = 0 would make H singular; damped, |det H| grows tenfold.
TEST(BroydenMemory, DampsAPairThatWouldMakeItSingular) {
  Broyden broyden(Eigen::MatrixXd::Identity(n, n));
  ASSERT_TRUE(broyden.add(wave(0), Vector::Zero(n)));
  Eigen::MatrixXd H(n, n);
  for (int i = 0; i < n; ++i) H.col(i) = broyden.apply(Vector::Unit(n, i));
  EXPECT_NEAR(H.determinant(), 10.0, 10.0 * round_off);
}

TEST(BroydenMemory, RefusesWhatItCannotUseAndForgets) {
  Broyden broyden(Eigen::MatrixXd::Identity(n, n), 1);
  EXPECT_FALSE(broyden.add(Vector::Zero(n), wave(0)));
  const Vector nan = Vector::Constant(n, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(broyden.add(wave(0), nan));
  EXPECT_EQ(broyden.memory.size(), 0);
  EXPECT_TRUE(broyden.add(wave(0), 2.0 * wave(0)));
  EXPECT_TRUE(broyden.memory.full());
  EXPECT_FALSE(broyden.add(wave(1), wave(1)));
  broyden.memory.clear();
  EXPECT_EQ(broyden.apply(wave(2)), wave(2));
}

}  // namespace

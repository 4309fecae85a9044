#include "jfnk/vector_operations.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>
#include <thread>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

namespace {

using jfnk::InnerProductRef;
using jfnk::Options;
using jfnk::Report;
using jfnk::Vector;
using jfnk::Vectors;

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

struct Set {
  std::vector<Vector> vectors;
  std::vector<const Vector*> columns;
  Vector w;

  Set(int n, int count) {
    std::mt19937 generator(5);
    std::normal_distribution<double> normal;
    const auto random = [&] {
      return Vector(Vector::NullaryExpr(n, [&](Eigen::Index) { return normal(generator); }));
    };
    for (int j = 0; j < count; ++j) vectors.push_back(random());
    for (Vector& v : vectors) columns.push_back(&v);
    w = random();
  }
};

// Sizes on either side of a block's, columns on either side of four at once and of a strip.
constexpr int sizes[] = {0, 1, 7, 8, 100, 1023, 1024, 1025, 3000};
constexpr int counts[] = {1, 3, 4, 9, 70};

TEST(VectorOperations, SumsAreInnerProductsHoweverManyAtOnce) {
  for (const int n : sizes) {
    for (const int count : counts) {
      const Set set(n, count);
      Vector sums(count);
      const InnerProductRef product;
      product.dots(set.columns, set.w, {sums.data(), set.columns.size()});
      for (int j = 0; j < count; ++j) {
        const Vector& column = set.vectors[static_cast<std::size_t>(j)];
        // Either sum is off by n rounding units of the sum of magnitudes at most.
        const double size = column.cwiseAbs().dot(set.w.cwiseAbs());
        EXPECT_LE(std::abs(sums[j] - column.dot(set.w)), 2 * n * rounding_unit * size) << n;
        EXPECT_EQ(sums[j], product.dot(column, set.w)) << n << " rows, column " << j;
      }
    }
  }
}

TEST(VectorOperations, SeveralVectorsHaveTheProductsOfEach) {
  constexpr int n = 2500;
  const Set set(n, 35);
  const Vector other = 2.0 * set.w + set.vectors.front();
  Vector first(35), second(35), expected(35);
  const std::array<jfnk::Products, 2> both{
      {{&set.w, {first.data(), 35}}, {&other, {second.data(), 35}}}};
  InnerProductRef().dots(set.columns, both);
  InnerProductRef().dots(set.columns, set.w, {expected.data(), 35});
  EXPECT_EQ(first, expected);
  InnerProductRef().dots(set.columns, other, {expected.data(), 35});
  EXPECT_EQ(second, expected);
}

TEST(VectorOperations, NormsAfterAPassAreThoseOfWhatItLeft) {
  constexpr int n = 2500;
  const Set set(n, 1);
  const InnerProductRef operations;
  // The squares of the last two overflow or vanish.
  std::array<Vector, 3> to{Vector(n), Vector(n), Vector(n)};
  const std::array<double, 3> factor{1.0, 1e200, 1e-200};
  std::array<double, 3> norms{};
  const std::array<const Vector*, 3> measured{&to[0], &to[1], &to[2]};
  operations.pass(
      n, 4,
      [&](jfnk::Rows rows) {
        for (std::size_t k = 0; k < to.size(); ++k) rows.of(to[k]) = factor[k] * rows.of(set.w);
      },
      measured, norms);
  for (std::size_t k = 0; k < to.size(); ++k) {
    EXPECT_EQ(norms[k], operations.norm(to[k])) << k;
    EXPECT_NEAR(norms[k] / factor[k], set.w.norm(), 1e-13 * set.w.norm()) << k;
  }
}

TEST(VectorOperations, CombinationsAddUpInOrder) {
  for (const int n : sizes) {
    for (const int count : counts) {
      const Set set(n, count);
      const Vector factors = Vector::LinSpaced(count, -1.0, 2.0);
      for (const double own : {0.0, 1.0, -0.3}) {
        Vector combined = set.w;
        if (own == 0.0) combined.setConstant(std::numeric_limits<double>::quiet_NaN());
        Vector expected = own == 0.0 ? Vector(Vector::Zero(n)) : Vector(own * set.w);
        InnerProductRef().combine(own, set.columns, {factors.data(), set.columns.size()}, combined);
        for (int j = 0; j < count; ++j) {
          expected += factors[j] * set.vectors[static_cast<std::size_t>(j)];
        }
        EXPECT_EQ(combined, expected) << n << " rows, " << count << " columns";
      }
    }
  }
}

TEST(VectorOperations, OfColumnsInSinglePrecisionAreThoseOfTheirCopies) {
  for (const int n : sizes) {
    for (const int count : counts) {
      Set set(n, count);
      std::vector<jfnk::SingleVector> singles;
      for (Vector& v : set.vectors) {
        singles.push_back(v.cast<float>());
        v = singles.back().cast<double>();
      }
      std::vector<const jfnk::SingleVector*> columns;
      for (const jfnk::SingleVector& v : singles) columns.push_back(&v);
      const std::size_t size = columns.size();
      const InnerProductRef product;
      Vector sums(count);
      Vector expected_sums(count);
      product.dots(columns, set.w, {sums.data(), size});
      product.dots(set.columns, set.w, {expected_sums.data(), size});
      EXPECT_EQ(sums, expected_sums) << n << " rows, " << count << " columns";
      const Vector factors = Vector::LinSpaced(count, -1.0, 2.0);
      Vector combined = set.w;
      Vector expected = set.w;
      product.combine(-0.3, columns, {factors.data(), size}, combined);
      product.combine(-0.3, set.columns, {factors.data(), size}, expected);
      EXPECT_EQ(combined, expected) << n << " rows, " << count << " columns";
    }
  }
}

/// A residual whose vectors are worked on by several threads, as the header says.
struct Threaded : jfnk_test::Bratu {
  Threaded(int m, int threads) : Bratu(m, 6.0), threads_(threads) {}
  void share_out(Eigen::Index n, Eigen::Index numbers, jfnk::BlockWork work) const {
    ++shared;
    EXPECT_GE(numbers, n);
    std::vector<std::thread> team;
    for (int thread = 0; thread < threads_; ++thread) {
      team.emplace_back([&, thread] {
        for (Eigen::Index b = thread; b < jfnk::blocks_of(n); b += threads_) work(b);
      });
    }
    for (std::thread& member : team) member.join();
  }
  mutable int shared = 0;

 private:
  int threads_;
};

TEST(VectorOperations, ThreadsGiveTheBitsOfNone) {
  constexpr int m = 46;  // three blocks, the last not full
  for (const jfnk::Method method : jfnk_test::all_methods) {
    Options options;
    options.method = method;
    options.learning.enabled = false;
    options.multisecant.memory = 10;  // so that pairs are dropped
    Vector expected = Vector::Zero(m * m);
    const Report plain = solve(jfnk_test::Bratu(m, 6.0), expected, options);
    for (const int threads : {2, 3}) {
      Threaded F(m, threads);
      Vector u = Vector::Zero(m * m);
      const Report report = solve(F, u, options);
      EXPECT_EQ(u, expected) << threads;
      EXPECT_EQ(report.counts.total(), plain.counts.total()) << threads;
      EXPECT_GT(F.shared, report.counts.total());
    }
  }
}

/// The same residual with nothing but `dot`.
struct WithDotOnly : jfnk_test::Bratu {
  using Bratu::Bratu;
  double dot(const Vector& a, const Vector& b) const {
    ++sums;
    return InnerProductRef().dot(a, b);
  }
  mutable int sums = 0;
};

/// With `dots` besides, as processes want it.
struct WithDots : WithDotOnly {
  using WithDotOnly::WithDotOnly;
  void dots(Vectors columns, const Vector& w, std::span<double> of_all) const {
    ++sums;
    InnerProductRef().dots(columns, w, of_all);
  }
};

TEST(VectorOperations, TheInnerProductsOfAnIterationAreFewSums) {
  constexpr int m = 20;
  // Sums per Krylov vector: its difference's three norms, one of all the products, and perhaps
  // another if it lies close to the others.
  constexpr int most_sums = 6;
  Options options;
  options.method = jfnk::Method::newton_krylov;
  options.learning.enabled = false;
  const WithDots F(m, 6.0);
  Vector u = Vector::Zero(m * m);
  const Report report = solve(F, u, options);
  const WithDotOnly G(m, 6.0);
  Vector v = Vector::Zero(m * m);
  EXPECT_EQ(solve(G, v, options).counts.total(), report.counts.total());
  EXPECT_EQ(u, v);
  EXPECT_GE(report.krylov_iterations, 30);
  EXPECT_LE(F.sums, most_sums * report.counts.total());
  EXPECT_GT(G.sums, 2 * F.sums);
}

}  // namespace

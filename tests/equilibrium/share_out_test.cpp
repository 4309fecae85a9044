// Vector operations on threads: the bits of libjfnk's own, for any number of threads.
#include "equilibrium/share_out.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <random>

#include "equilibrium/equilibrium.hpp"
#include "jfnk/residual.hpp"

namespace {

using jfnk::InnerProductRef;
using jfnk::Vector;

/// Vectors of which each sum cancels, so that another order shows in its last bits.
struct Vectors {
  std::vector<Vector> all;
  std::vector<const Vector*> columns;
  std::vector<jfnk::SingleVector> singles;
  std::vector<const jfnk::SingleVector*> single_columns;
  Vector w;
  Vector factors;

  Vectors(Eigen::Index n, std::size_t count) {
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    const auto random = [&](Eigen::Index size) {
      return Vector(Vector::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); }));
    };
    for (std::size_t j = 0; j < count; ++j) all.push_back(random(n));
    for (const Vector& v : all) columns.push_back(&v);
    for (const Vector& v : all) singles.push_back(v.cast<float>());
    for (const jfnk::SingleVector& v : singles) single_columns.push_back(&v);
    w = random(n);
    factors = random(static_cast<Eigen::Index>(count));
  }
  std::span<const double> weights() const { return {factors.data(), columns.size()}; }
};

/// A residual of which libjfnk needs no more here.
struct Shared {
  Eigen::Index particles;
  void share_out(Eigen::Index n, Eigen::Index numbers, jfnk::BlockWork work) const {
    equilibrium::share_out(n, numbers, particles, work);
  }
};

/// All that the operations make of the same vectors.
std::vector<Vector> everything(const InnerProductRef& operations, Eigen::Index n,
                               std::size_t count) {
  const Vectors set(n, count);
  Vector sums(static_cast<Eigen::Index>(count));
  operations.dots(set.columns, set.w, {sums.data(), count});
  Vector product(1);
  product[0] = operations.dot(set.w, set.all.front());
  std::vector<Vector> results = {sums, product};
  Vector w = set.w;
  operations.combine(0.7, set.columns, set.weights(), w);
  results.push_back(w);
  operations.combine(0.0, set.columns, set.weights(), w);
  results.push_back(w);
  operations.dots(set.single_columns, set.w, {sums.data(), count});
  results.push_back(sums);
  operations.combine(-0.7, set.single_columns, set.weights(), w);
  results.push_back(w);
  Vector others(static_cast<Eigen::Index>(count));
  const std::array<jfnk::Products, 2> both{
      {{&set.w, {sums.data(), count}}, {&w, {others.data(), count}}}};
  operations.dots(set.columns, both);
  results.push_back(sums);
  results.push_back(others);
  Vector norms(2);
  const std::array<const Vector*, 2> measured{&w, &set.w};
  operations.pass(n, 2, [&](jfnk::Rows rows) { rows.of(w) *= 3.0; }, measured, {norms.data(), 2});
  results.push_back(w);
  results.push_back(norms);
  return results;
}

TEST(ShareOut, GivesTheBitsOfOneThreadForAnyNumber) {
  const int before = omp_get_max_threads();
  // On either side of a block of rows and of a strip of columns; fewer blocks than threads, more.
  for (const Eigen::Index n : {5, 1024, 1025, 9000}) {
    for (const std::size_t count : {1U, 4U, 33U}) {
      const std::vector<Vector> expected = everything(InnerProductRef(), n, count);
      const Shared shared{(n + 1) / 2};
      for (const int threads : {1, 2, 3, 7}) {
        omp_set_num_threads(threads);
        const std::vector<Vector> found = everything(InnerProductRef(shared), n, count);
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t k = 0; k < found.size(); ++k) {
          EXPECT_TRUE((found[k].array() == expected[k].array()).all())
              << n << " rows, " << count << " columns, " << threads << " threads: " << k;
        }
      }
    }
  }
  omp_set_num_threads(before);
}

TEST(ShareOut, IsWhatTheSolverFindsInTheEquilibrium) {
  using Plane = equilibrium::Equilibrium<2>;
  EXPECT_TRUE(jfnk::HasShareOut<Plane>);
}

}  // namespace

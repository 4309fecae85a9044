// The kernels give the same bits by every instruction set, each compiled on its own here, and by
// the one that the loader has picked.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "block_kernels.hpp"

#define DECLARE_KERNELS(set)                                                              \
  namespace jfnk::set {                                                                   \
  double dot_one(Eigen::Index, const double*, const double*);                             \
  void dot_four(Eigen::Index, const double*, const double*, const double*, const double*, \
                const double*, double*);                                                  \
  void add_one(Eigen::Index, const double*, double, double*);                             \
  void add_four(Eigen::Index, const double*, const double*, const double*, const double*, \
                const double*, double*);                                                  \
  double dot_one(Eigen::Index, const float*, const double*);                              \
  void dot_four(Eigen::Index, const float*, const float*, const float*, const float*,     \
                const double*, double*);                                                  \
  void add_one(Eigen::Index, const float*, double, double*);                              \
  void add_four(Eigen::Index, const float*, const float*, const float*, const float*,     \
                const double*, double*);                                                  \
  }
DECLARE_KERNELS(x86_64)
DECLARE_KERNELS(x86_64_v3)
DECLARE_KERNELS(x86_64_v4)

namespace {

/// The kernels for columns of one precision.
template <class Real>
struct Kernels {
  const char* name;
  double (*dot_one)(Eigen::Index, const Real*, const double*);
  void (*dot_four)(Eigen::Index, const Real*, const Real*, const Real*, const Real*, const double*,
                   double*);
  void (*add_one)(Eigen::Index, const Real*, double, double*);
  void (*add_four)(Eigen::Index, const Real*, const Real*, const Real*, const Real*, const double*,
                   double*);
};

#define KERNELS(Real, set)                                                                     \
  Kernels<Real> {                                                                              \
#set, &jfnk::set::dot_one, &jfnk::set::dot_four, &jfnk::set::add_one, &jfnk::set::add_four \
  }

/// All that the kernels make of some rows of random numbers that span many decades.
template <class Real>
std::vector<double> everything(const Kernels<Real>& kernels, Eigen::Index n) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-8.0, 8.0);
  const auto random = [&]<class T>(T) {
    std::vector<T> v(static_cast<std::size_t>(n));
    for (T& x : v) x = static_cast<T>(normal(generator) * std::pow(10.0, decades(generator)));
    return v;
  };
  std::vector<Real> a[4] = {random(Real{}), random(Real{}), random(Real{}), random(Real{})};
  const std::vector<double> b = random(1.0);
  std::vector<double> w = random(1.0);
  const double factors[4] = {0.3, -1.7, 1e5, 1.0 / 3.0};
  std::vector<double> results(5);
  results[4] = kernels.dot_one(n, a[0].data(), b.data());
  kernels.dot_four(n, a[0].data(), a[1].data(), a[2].data(), a[3].data(), b.data(), results.data());
  kernels.add_one(n, a[0].data(), 0.7, w.data());
  kernels.add_four(n, a[0].data(), a[1].data(), a[2].data(), a[3].data(), factors, w.data());
  results.insert(results.end(), w.begin(), w.end());
  return results;
}

template <class Real>
void expect_the_same_bits() {
  std::vector<Kernels<Real>> sets = {KERNELS(Real, detail)};
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(KERNELS(Real, x86_64_v3));
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
    sets.push_back(KERNELS(Real, x86_64_v4));
  }
  // On either side of the eight lanes of a sum, and a whole block.
  for (const Eigen::Index n : {1, 7, 8, 9, 100, 1021, 1024}) {
    const std::vector<double> expected = everything<Real>(KERNELS(Real, x86_64), n);
    for (const Kernels<Real>& set : sets) {
      const std::vector<double> found = everything(set, n);
      ASSERT_EQ(found.size(), expected.size());
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(double)), 0)
          << set.name << ", " << n << " rows";
    }
  }
}

TEST(InstructionSets, GiveTheSameBits) {
  expect_the_same_bits<double>();
}

TEST(InstructionSets, GiveTheSameBitsForColumnsInSinglePrecision) {
  expect_the_same_bits<float>();
}

}  // namespace

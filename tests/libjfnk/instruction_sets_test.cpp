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
  void rotate_two(Eigen::Index, double, double, double*, double*);                        \
  }
DECLARE_KERNELS(x86_64)
DECLARE_KERNELS(x86_64_v3)
DECLARE_KERNELS(x86_64_v4)

namespace {

struct Kernels {
  const char* name;
  decltype(&jfnk::detail::dot_one) dot_one;
  decltype(&jfnk::detail::dot_four) dot_four;
  decltype(&jfnk::detail::add_one) add_one;
  decltype(&jfnk::detail::add_four) add_four;
  decltype(&jfnk::detail::rotate_two) rotate_two;
};

#define KERNELS(set)                                                                            \
  Kernels {                                                                                     \
#set, &jfnk::set::dot_one, &jfnk::set::dot_four, &jfnk::set::add_one, &jfnk::set::add_four, \
        &jfnk::set::rotate_two                                                                  \
  }

/// All that the kernels make of some rows of random numbers that span many decades.
std::vector<double> everything(const Kernels& kernels, Eigen::Index n) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-8.0, 8.0);
  const auto random = [&] {
    std::vector<double> v(static_cast<std::size_t>(n));
    for (double& x : v) x = normal(generator) * std::pow(10.0, decades(generator));
    return v;
  };
  std::vector<double> a[4] = {random(), random(), random(), random()};
  const std::vector<double> b = random();
  std::vector<double> w = random();
  const double factors[4] = {0.3, -1.7, 1e5, 1.0 / 3.0};
  std::vector<double> results(5);
  results[4] = kernels.dot_one(n, a[0].data(), b.data());
  kernels.dot_four(n, a[0].data(), a[1].data(), a[2].data(), a[3].data(), b.data(), results.data());
  kernels.add_one(n, a[0].data(), 0.7, w.data());
  kernels.add_four(n, a[0].data(), a[1].data(), a[2].data(), a[3].data(), factors, w.data());
  kernels.rotate_two(n, std::cos(0.4), std::sin(0.4), a[0].data(), a[1].data());
  for (const auto* v : {&w, &a[0], &a[1]}) results.insert(results.end(), v->begin(), v->end());
  return results;
}

TEST(InstructionSets, GiveTheSameBits) {
  std::vector<Kernels> sets = {KERNELS(detail)};
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    sets.push_back(KERNELS(x86_64_v3));
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
    sets.push_back(KERNELS(x86_64_v4));
  }
  // On either side of the eight lanes of a sum, and a whole block.
  for (const Eigen::Index n : {1, 7, 8, 9, 100, 1021, 1024}) {
    const std::vector<double> expected = everything(KERNELS(x86_64), n);
    for (const Kernels& set : sets) {
      const std::vector<double> found = everything(set, n);
      ASSERT_EQ(found.size(), expected.size());
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(double)), 0)
          << set.name << ", " << n << " rows";
    }
  }
}

}  // namespace

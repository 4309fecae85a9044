#include "block_kernels.hpp"

// One binary serves every x86-64: the loader picks the variant with registers as wide as the
// processor has. Sums are made in eight lanes in any case, and multiplication and addition are not
// fused (see CMakeLists.txt), so that all variants give the same bits. Sanitizer builds keep to one
// (their runtime is not up when the loader resolves the variants).
#if defined(JFNK_TARGET_CLONES)
// Chosen by whoever compiles this for one set alone.
#elif defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define JFNK_TARGET_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define JFNK_TARGET_CLONES
#endif

// Vectors never cross a call: everything that takes one is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"
#define JFNK_INLINE inline __attribute__((always_inline))

namespace jfnk::detail {
namespace {

constexpr int width = 4;
constexpr int lanes = 2 * width;
using Lanes = double __attribute__((vector_size(width * sizeof(double))));
// One move from any address, where std::memcpy would make two.
using UnalignedLanes __attribute__((aligned(sizeof(double)), may_alias)) = Lanes;

JFNK_INLINE Lanes load(const double* p) {
  return *reinterpret_cast<const UnalignedLanes*>(p);
}

using SingleLanes = float __attribute__((vector_size(width * sizeof(float))));
using UnalignedSingleLanes __attribute__((aligned(sizeof(float)), may_alias)) = SingleLanes;

JFNK_INLINE Lanes load(const float* p) {
  return __builtin_convertvector(*reinterpret_cast<const UnalignedSingleLanes*>(p), Lanes);
}

/// A sum in eight lanes: the terms that many apart are added up in order.
struct Sum {
  Lanes low{};
  Lanes high{};

  template <class Real>
  JFNK_INLINE void add(const Real* a, const Lanes& b_low, const Lanes& b_high) {
    low += load(a) * b_low;
    high += load(a + width) * b_high;
  }
  /// All of it, with fewer terms than lanes that are left over.
  template <class Real>
  JFNK_INLINE double total(Eigen::Index count, const Real* a, const double* b) const {
    double lane[width];
    for (int k = 0; k < width; ++k) lane[k] = low[k] + high[k];
    double rest = 0.0;
    for (Eigen::Index i = 0; i < count; ++i) rest += static_cast<double>(a[i]) * b[i];
    return ((lane[0] + lane[2]) + (lane[1] + lane[3])) + rest;
  }
};

template <class Real>
JFNK_INLINE double dot(Eigen::Index n, const Real* a, const double* b) {
  Sum sum;
  Eigen::Index i = 0;
  for (; i + lanes <= n; i += lanes) sum.add(a + i, load(b + i), load(b + i + width));
  return sum.total(n - i, a + i, b + i);
}

template <class Real>
JFNK_INLINE void dots(Eigen::Index n, const Real* a0, const Real* a1, const Real* a2,
                      const Real* a3, const double* b, double* sums) {
  Sum sum0;
  Sum sum1;
  Sum sum2;
  Sum sum3;
  Eigen::Index i = 0;
  for (; i + lanes <= n; i += lanes) {
    const Lanes low = load(b + i);
    const Lanes high = load(b + i + width);
    sum0.add(a0 + i, low, high);
    sum1.add(a1 + i, low, high);
    sum2.add(a2 + i, low, high);
    sum3.add(a3 + i, low, high);
  }
  sums[0] = sum0.total(n - i, a0 + i, b + i);
  sums[1] = sum1.total(n - i, a1 + i, b + i);
  sums[2] = sum2.total(n - i, a2 + i, b + i);
  sums[3] = sum3.total(n - i, a3 + i, b + i);
}

template <class Real>
JFNK_INLINE void add(Eigen::Index n, const Real* a, double factor, double* __restrict w) {
  for (Eigen::Index i = 0; i < n; ++i) w[i] += factor * static_cast<double>(a[i]);
}

template <class Real>
JFNK_INLINE void add(Eigen::Index n, const Real* a0, const Real* a1, const Real* a2, const Real* a3,
                     const double* factors, double* __restrict w) {
  const double f0 = factors[0];
  const double f1 = factors[1];
  const double f2 = factors[2];
  const double f3 = factors[3];
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto b0 = static_cast<double>(a0[i]), b1 = static_cast<double>(a1[i]);
    const auto b2 = static_cast<double>(a2[i]), b3 = static_cast<double>(a3[i]);
    w[i] = (((w[i] + f0 * b0) + f1 * b1) + f2 * b2) + f3 * b3;
  }
}

}  // namespace

JFNK_TARGET_CLONES double dot_one(Eigen::Index n, const double* a, const double* b) {
  return dot(n, a, b);
}

JFNK_TARGET_CLONES double dot_one(Eigen::Index n, const float* a, const double* b) {
  return dot(n, a, b);
}

JFNK_TARGET_CLONES void dot_four(Eigen::Index n, const double* a0, const double* a1,
                                 const double* a2, const double* a3, const double* b,
                                 double* sums) {
  dots(n, a0, a1, a2, a3, b, sums);
}

JFNK_TARGET_CLONES void dot_four(Eigen::Index n, const float* a0, const float* a1, const float* a2,
                                 const float* a3, const double* b, double* sums) {
  dots(n, a0, a1, a2, a3, b, sums);
}

JFNK_TARGET_CLONES void add_one(Eigen::Index n, const double* a, double factor, double* w) {
  add(n, a, factor, w);
}

JFNK_TARGET_CLONES void add_one(Eigen::Index n, const float* a, double factor, double* w) {
  add(n, a, factor, w);
}

JFNK_TARGET_CLONES void add_four(Eigen::Index n, const double* a0, const double* a1,
                                 const double* a2, const double* a3, const double* factors,
                                 double* w) {
  add(n, a0, a1, a2, a3, factors, w);
}

JFNK_TARGET_CLONES void add_four(Eigen::Index n, const float* a0, const float* a1, const float* a2,
                                 const float* a3, const double* factors, double* w) {
  add(n, a0, a1, a2, a3, factors, w);
}

}  // namespace jfnk::detail

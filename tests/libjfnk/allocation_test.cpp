#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "jfnk/jfnk.hpp"
#include "problems.hpp"

// The linker wraps malloc (--wrap=malloc), by which Eigen allocates; operator new, replaced here,
// comes to the same place.
namespace {
// Atomic, for the compiler takes malloc for a function that changes no variable of ours.
std::atomic<std::size_t> allocations = 0;
}  // namespace

extern "C" {
void* __real_malloc(std::size_t size);
void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
}

// Not inlined: the compiler would see free() meet memory of operator new.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

using jfnk::Method;
using jfnk::Options;
using jfnk::Solver;
using jfnk::Vector;

/// Bratu without allocations, noting the count at its first and its latest evaluation.
struct Watching {
  int m;
  double weight = 1e-3;  // below the turning point, 3.5 / 41^2 = 2.1e-3
  std::size_t first = 0;
  std::size_t last = 0;
  bool started = false;
  void operator()(const Vector& u, Vector& r) {
    if (!started) first = allocations;
    started = true;
    for (int i = 0; i < m; ++i) {
      r[i] = 2.0 * u[i] - (i > 0 ? u[i - 1] : 0.0) - (i + 1 < m ? u[i + 1] : 0.0) -
             weight * std::exp(u[i]);
    }
    last = allocations;
  }
};

struct Halving {
  void apply(const Vector& r, Vector& z) const { z = 0.5 * r; }
};

TEST(Allocation, CounterSeesEigenAndNew) {
  const std::size_t before = allocations;
  const Vector v = Vector::Ones(100);
  EXPECT_GT(allocations, before);
  const std::size_t between = allocations;
  ::operator delete(::operator new(static_cast<std::size_t>(v[0])));
  EXPECT_GT(allocations, between);
}

TEST(Allocation, NoneBetweenTheFirstAndTheLastEvaluationOfASolverUsedBefore) {
  for (const Method method : {Method::newton_krylov, Method::multisecant, Method::hybrid}) {
    for (const bool flexible : {false, true}) {
      Options options;
      options.method = method;
      options.krylov.flexible = flexible;
      options.krylov.restart = 10;
      options.multisecant.memory = 4;
      options.hybrid.rounds = 2;
      options.max_evaluations = 400;
      options.learning.enabled = false;  // factors are allocated when they are learnt
      Watching F{40};
      Vector u = Vector::Zero(40);
      Solver solver(options);
      (void)solver.solve(F, u, Halving{});
      u.setZero();
      F.started = false;
      const auto& report = solver.solve(F, u, Halving{});
      EXPECT_GT(report.counts.total(), 20);
      EXPECT_EQ(F.last - F.first, 0u) << jfnk::to_string(report.status);
    }
  }
}

TEST(Allocation, SecondSolveOfASolverNeedsOnlyItsReason) {
  Options options;
  options.learning.enabled = false;
  Solver solver(options);
  Watching F{40};
  Vector u = Vector::Zero(40);
  ASSERT_TRUE(solver.solve(F, u, Halving{}).converged());
  u.setZero();
  F.started = false;
  const std::size_t before = allocations;
  ASSERT_TRUE(solver.solve(F, u, Halving{}).converged());
  EXPECT_EQ(F.last - before, 0u);
}

/// Bytes in use, those of large blocks included.
std::size_t live() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

TEST(Allocation, AShortSolveHoldsFewVectorsOfManyAllowed) {
  constexpr int n = 200000;
  // Seventeen vectors of n that are always there, and two for each of some seven pairs.
  constexpr double most_bytes_per_unknown = 250.0;
  const auto F = [](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) r[i] = u[i] - 1.0 + 0.1 * (i > 0 ? u[i - 1] * u[i - 1] : 0.0);
  };
  const std::size_t before = live();
  Options options;
  options.tolerances.relative = 1e-4;
  Solver solver(options);
  ASSERT_TRUE(solver.start(F, Vector::Zero(n)));
  while (solver.step(F)) {
  }
  EXPECT_TRUE(solver.report().converged()) << solver.report().reason;
  EXPECT_GE(solver.report().multisecant_iterations, 3);
  EXPECT_LE(static_cast<double>(live() - before) / n, most_bytes_per_unknown);
}

}  // namespace

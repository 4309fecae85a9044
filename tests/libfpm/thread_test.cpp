// Results do not depend on the number of threads, to the last bit.
#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include <fpm/threads.hpp>
#include <fpm/viscosity.hpp>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::MomentOperator;

/// Calls `compute` with 1, 2, 3 and 7 threads and compares what it returns.
template <class Compute>
void expect_the_same_for_any_number_of_threads(Compute&& compute) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto alone = compute();
  for (const int threads : {2, 3, 7}) {
    omp_set_num_threads(threads);
    EXPECT_EQ(compute(), alone) << threads << " threads";
  }
  omp_set_num_threads(before);
}

template <int Dim>
Field<Dim> force_of(const Model<Dim>& m) {
  const MomentOperator<Dim> op(m.rows, m.ghosts, {true, true});
  const Index n = op.size();
  return scattered(op, random_vector(n * op.stress_count(), 81).reshaped(n, op.stress_count()),
                   random_field<Dim>(n, 82), m.set.position);
}

TEST(Threads, DoEachBlockOnceHoweverManyThereAre) {
  const int before = omp_get_max_threads();
  for (const int threads : {1, 2, 3, 7, 200}) {
    omp_set_num_threads(threads);
    for (const Index count : {0, 1, 2, 5, 400}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      fpm::for_each_block(count, [&](Index block) { ++done[static_cast<std::size_t>(block)]; });
      for (const std::atomic<int>& times : done) EXPECT_EQ(times, 1) << threads << ", " << count;
    }
  }
  omp_set_num_threads(before);
}

TEST(Threads, DoAllBlocksWhereThereAreFewerThreadsThanAskedFor) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(5);
  std::atomic<int> done = 0;
#pragma omp parallel num_threads(2)
  {
    // Teams within teams have one thread, unless they are asked for.
#pragma omp single
    fpm::for_each_block(100, [&](int /*block*/) { ++done; });
  }
  EXPECT_EQ(done, 100);
  omp_set_num_threads(before);
}

TEST(Threads, DoEachRowOnce) {
  for (const Index count : {0, 1, 31, 32, 33, 1000}) {
    Eigen::VectorXi done = Eigen::VectorXi::Zero(count);
    fpm::for_each_row(count, Index{32}, [&](Index row) { ++done[row]; });
    EXPECT_EQ(done, Eigen::VectorXi::Ones(count)) << count;
  }
}

// One of two neighbours that is held up is left behind: the other does all the rest.
TEST(Threads, DoNotWaitForOneThatIsHeldUp) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(2);
  constexpr int count = 64;
  std::array<std::atomic<int>, 2> by{};
  fpm::for_each_block(count, [&](int /*block*/) {
    const auto own = static_cast<std::size_t>(omp_get_thread_num());
    // The first of its own waits until the others are done.
    if (own == 0 && by[0] == 0) {
      while (by[1] < count - 1 && omp_get_num_threads() == 2) std::this_thread::yield();
    }
    ++by[own];
  });
  EXPECT_EQ(by[0] + by[1], count);
  omp_set_num_threads(before);
}

TEST(Threads, DoNotChangeTheScatteredForces) {
  for (const double jitter : {0.0, 0.2}) {
    const Model<2> plane(lattice<2>({31, 23}, 0.1, LatticeLayout::cell, jitter), true, {{0, 0.0}});
    expect_the_same_for_any_number_of_threads([&] { return force_of<2>(plane); });
  }
  const Model<3> space(lattice<3>({7, 6, 9}), true, {{2, 0.0}});
  expect_the_same_for_any_number_of_threads([&] { return force_of<3>(space); });
}

TEST(Threads, DoNotChangeTheViscousForces) {
  const Model<2> m(lattice<2>({31, 23}, 0.1, LatticeLayout::cell, 0.2), false, {{0, 0.0}});
  const MomentOperator<2> op(m.rows, m.ghosts, {});
  const Index n = op.size();
  fpm::PairViscosity<2> viscosity(op, Eigen::VectorXd::Ones(n), smoothing_lengths(m.rows));
  const Field<2> du = 0.01 * random_field<2>(n, 83);
  expect_the_same_for_any_number_of_threads([&] {
    Field<2> force = Field<2>::Zero(n, 2);
    viscosity.add_force(0.1, m.set.position, du, Field<4>(0, 4), m.set.volume, force);
    return force;
  });
}

}  // namespace

// Results do not depend on the number of threads, to the last bit.
#include <gtest/gtest.h>
#include <omp.h>
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

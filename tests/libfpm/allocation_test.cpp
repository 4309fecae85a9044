// What runs inside a residual evaluation does not allocate.
#include <gtest/gtest.h>
#include <fpm/boundary_loads.hpp>
#include <fpm/viscosity.hpp>

#include <memory>

#include "allocation_count.hpp"
#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::MomentOperator;

/// Allocations of the second of two calls: the first may start the threads.
template <class Call>
long allocations(Call&& call) {
  call();
  const long before = allocation_count();
  call();
  return allocation_count() - before;
}

TEST(AllocationCount, SeesNewAndEigen) {
  EXPECT_GE(allocations([] { return std::make_unique<Field<2>>(10, 2)->size(); }), 2);
}

template <int Dim>
void expect_no_allocation_in_the_operator(const Model<Dim>& m) {
  const MomentOperator<Dim> op(m.rows, m.ghosts, {true, true});
  const Field<Dim> u = random_field<Dim>(op.size(), 1);
  Eigen::VectorXd nodal(op.stride() * Dim);
  Eigen::MatrixXd moments(MomentOperator<Dim>::block_stride, op.channel_count() * Dim);
  const Eigen::MatrixXd stress = Eigen::MatrixXd::Ones(op.stride(), op.stress_count());
  Eigen::MatrixXd force(op.stride(), Dim);
  EXPECT_EQ(allocations([&] {
              op.extend(u.data(), nodal.data());
              op.extend_positions(u.data(), nodal.data());
              for (Index block = 0; block < op.block_count(); ++block) {
                op.gather(block, nodal.data(), moments.data());
              }
              op.scatter(stress.data(), nodal.data(), nodal.data(), force.data());
            }),
            0);
}

TEST(MomentOperator, DoesNotAllocateInGatherAndScatter) {
  expect_no_allocation_in_the_operator(Model<2>(lattice<2>({20, 15}), true, {{0, 0.0}}));
  expect_no_allocation_in_the_operator(
      Model<3>(lattice<3>({6, 5, 5}, 0.1, LatticeLayout::cell, 0.2), true, {{0, 0.0}}));
}

TEST(PairViscosity, DoesNotAllocateInACall) {
  const Model<2> m(lattice<2>({20, 15}), false, {{0, 0.0}});
  const MomentOperator<2> op(m.rows, m.ghosts, {});
  const Index n = op.size();
  fpm::PairViscosity<2> viscosity(op, Eigen::VectorXd::Ones(n), smoothing_lengths(m.rows));
  const Field<2> du = random_field<2>(n, 1);
  Field<4> inverse(n, 4);
  inverse.rowwise() = Eigen::RowVector4d(1.0, 0.0, 0.0, 1.0);
  Field<2> force = Field<2>::Zero(n, 2);
  // A solver's vector, seen as a field.
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(2 * n);
  Eigen::Map<Field<2>> mapped(vector.data(), n, 2);
  EXPECT_EQ(allocations([&] {
              viscosity.add_force(0.1, m.set.position, du, inverse, m.set.volume, force);
              viscosity.add_action(0.1, m.set.position, du, du, Field<4>(0, 4), m.set.volume,
                                   mapped);
            }),
            0);
}

TEST(BoundaryLoads, DoNotAllocateInACall) {
  const auto options = lattice<3>({5, 5, 5});
  const Model<3> m(options);
  const auto points = boundary_quadrature(fpm::BoundaryQuadratureOptions<3>{
      .min = options.min, .max = options.max, .spacing = 0.1, .face = {1, true}});
  const fpm::PointOperator<3> op(m.set, m.ghosts, points.position, row_options<3>());
  const Field<3> u = 0.01 * random_field<3>(125, 1);
  const Field<3> target = Field<3>::Zero(points.size(), 3);
  const fpm::PenaltyOptions<3> penalty{.penalty = 10.0};
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(3 * 125);
  Eigen::Map<Field<3>> force(vector.data(), 125, 3);
  bool inverted = false;
  EXPECT_EQ(allocations([&] {
              add_traction(op, points, target, force);
              add_uniform_traction(op, points, {1.0, 2.0, 3.0}, force);
              inverted |= add_following_pressure(op, points, 1.0, u, force).has_value();
              add_following_pressure_action(op, points, 1.0, u, u, force);
              add_penalty_force(op, points, penalty, target, u, force);
              add_penalty_action(op, points, penalty, u, force);
            }),
            0);
  EXPECT_FALSE(inverted);
}

}  // namespace

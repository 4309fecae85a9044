// Values and gradients at arbitrary points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/points.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::PointOperator;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Corners, faces and the inside of the box the lattice fills, and particles themselves.
template <int Dim>
Field<Dim> probes(const ParticleSet<Dim>& set, const LatticeOptions<Dim>& box) {
  const Vector<Dim> extent = box.max - box.min;
  Field<Dim> points =
      0.5 * (random_field<Dim>(60, 91).array() + 1.0).matrix() * extent.asDiagonal();
  points.rowwise() += box.min.transpose();
  points.row(0) = box.min.transpose();
  points.row(1) = box.max.transpose();
  for (int k = 2; k < 20; ++k)
    points(k, k % Dim) = k % 2 == 0 ? box.min[k % Dim] : box.max[k % Dim];
  points.row(20) = set.position.row(0);
  points.row(21) = set.position.row(set.size() / 2);
  return points;
}

// Points on the boundary of cells lie half a spacing outside the hull: condition numbers stay below
// this (and rows with R = 2.4 spacings have at most 90 terms of size 1).
constexpr double condition = 500.0;
constexpr double round_off_of_weights = (4.0 * condition + 90.0) * epsilon;

template <int Dim>
void expect_linear_exactness(LatticeLayout layout, double jitter) {
  const Counts<Dim> cells = Counts<Dim>::Constant(Dim == 2 ? 10 : 5);
  const auto box = lattice<Dim>(cells, 0.1, layout, jitter);
  const Model<Dim> m(box);
  const Field<Dim> points = probes(m.set, box);
  auto options = row_options<Dim>();
  options.max_condition = condition;
  const PointOperator<Dim> op(m.set, m.ghosts, points, options);
  const Tensor<Dim> a = some_tensor<Dim>();
  const Vector<Dim> shift = Vector<Dim>::Constant(1.5);
  const Field<Dim> field = affine<Dim>(m.set.position, a, shift);
  const double largest = field.cwiseAbs().maxCoeff();

  Field<Dim> values(op.size(), Dim);
  op.values(field, values);
  EXPECT_LE((values - affine<Dim>(points, a, shift)).cwiseAbs().maxCoeff(),
            round_off_of_weights * largest * 10.0);  // sum |N| < 10 outside the hull
  Eigen::Matrix<double, Eigen::Dynamic, Dim * Dim> gradients(op.size(), Dim * Dim);
  op.gradients(field, gradients);
  const Eigen::RowVectorXd expected = a.reshaped().transpose();
  EXPECT_LE((gradients.rowwise() - expected).cwiseAbs().maxCoeff(),
            round_off_of_weights * largest * 10.0 / 0.1);
}

TEST(PointOperator, ReproducesLinearFieldsInsideOnFacesAndInCorners) {
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    for (const double jitter : {0.0, 0.2}) {
      expect_linear_exactness<2>(layout, jitter);
      expect_linear_exactness<3>(layout, jitter);
    }
  }
}

TEST(PointOperator, TransposedValuesAreTheExactTransposeAndKeepTheResultant) {
  const auto box = lattice<2>({10, 8});
  const Model<2> m(box, false, {{0, 0.0}});
  const PointOperator<2> op(m.set, m.ghosts, probes(m.set, box), row_options<2>());
  const Field<2> u = random_field<2>(80, 92);
  const Field<2> f = random_field<2>(op.size(), 93);
  Field<2> values(op.size(), 2);
  op.values(u, values);
  Field<2> force = Field<2>::Ones(80, 2);
  op.add_transposed_values(f, force);
  force.array() -= 1.0;
  const double absolute = values.cwiseProduct(f).cwiseAbs().sum();
  EXPECT_NEAR(values.cwiseProduct(f).sum(), force.cwiseProduct(u).sum(), round_off(90.0, absolute));
  // Along the plane of symmetry images push like their particles.
  EXPECT_NEAR(force.col(1).sum(), f.col(1).sum(), round_off_of_weights * f.cwiseAbs().sum() * 10.0);
}

TEST(PointOperator, SeesTheSymmetricFieldOfTheFullSet) {
  auto half = lattice<2>({10, 8});
  auto full = half;
  full.min[0] = -full.max[0];
  const Model<2> m(half, false, {{0, 0.0}});
  const Model<2> whole(full);
  Field<2> points(3, 2);
  points << 0.0, 0.4, 0.02, 0.0, 0.13, 0.8;
  const PointOperator<2> folded(m.set, m.ghosts, points, row_options<2>());
  const PointOperator<2> plain(whole.set, whole.ghosts, points, row_options<2>());
  // u_x odd and u_y even in x, both non-linear.
  const auto field = [](const Field<2>& x) {
    Field<2> u(x.rows(), 2);
    u.col(0) = x.col(0).array() * (1.0 + x.col(1).array());
    u.col(1) = x.col(0).array().square() + x.col(1).array();
    return u;
  };
  for (Index c = 0; c < 3; ++c) {
    const Field<2> u = field(m.set.position);
    const Field<2> v = field(whole.set.position);
    EXPECT_LE((folded.value(c, u) - plain.value(c, v)).norm(), 10.0 * round_off_of_weights);
    EXPECT_LE((folded.gradient(c, u) - plain.gradient(c, v)).norm(),
              10.0 * round_off_of_weights / 0.1);
    EXPECT_NEAR(folded.scalar_value(c, u.col(1)), plain.value(c, v)[1],
                10.0 * round_off_of_weights);
  }
  // On the plane of symmetry the normal displacement vanishes.
  EXPECT_NEAR(folded.value(0, field(m.set.position))[0], 0.0, 10.0 * round_off_of_weights);
}

TEST(PointOperator, WidensTheSupportOfAPointFarOut) {
  const Model<2> m(lattice<2>({8, 8}));
  Field<2> points(2, 2);
  points << 0.4, 0.4, 0.4, 1.0;  // the second is 2.5 spacings above the last row
  const PointOperator<2> op(m.set, m.ghosts, points, row_options<2>());
  EXPECT_EQ(op.support_radius(0), support * 0.1);
  EXPECT_GT(op.support_radius(1), 0.35);
  Field<2> values(2, 2);
  op.values(m.set.position, values);
  EXPECT_NEAR(values(1, 1), 1.0, 100.0 * round_off_of_weights);  // sum |N| < 100 this far out
}

TEST(PointOperator, AtParticlesTakesTheirValuesAndTheirRowsGradients) {
  const Model<2> m(lattice<2>({8, 8}, 0.1, LatticeLayout::vertex), false, {{1, -0.05}});
  const std::vector<Index> particles{0, 8, 40, 80};
  const auto op = PointOperator<2>::at_particles(m.set, m.ghosts, particles, row_options<2>());
  const fpm::MomentOperator<2> rows(m.rows, m.ghosts, {});
  const Field<2> u = random_field<2>(81, 94);
  for (Index c = 0; c < op.size(); ++c) {
    const Index a = particles[static_cast<std::size_t>(c)];
    EXPECT_EQ(op.value(c, u), Vector<2>(u.row(a).transpose()));
    Tensor<2> gradient = Tensor<2>::Zero();
    rows.for_each_entry(a, [&](Index b, const double* g) {
      const Vector<2> other = b < 81 ? Vector<2>(u.row(b).transpose()) : m.ghosts.image(u, b - 81);
      gradient += (other - u.row(a).transpose()) * Eigen::Map<const Vector<2>>(g).transpose();
    });
    EXPECT_LE((op.gradient(c, u) - gradient).norm(), 10.0 * round_off_of_weights / 0.1);
  }
}

TEST(PointOperator, GivesAConstantNoGradientAtAll) {
  const auto box = lattice<3>({5, 5, 5}, 0.1, LatticeLayout::cell, 0.2);
  const Model<3> m(box);
  const PointOperator<3> op(m.set, m.ghosts, probes(m.set, box), row_options<3>());
  const Field<3> constant = Field<3>::Constant(125, 3, 1e9);
  for (Index c = 0; c < op.size(); ++c) EXPECT_EQ(op.gradient(c, constant).norm(), 0.0);
}

TEST(PointOperator, RefusesPointsAndSizesThatCannotBe) {
  const Model<2> m(lattice<2>({8, 8}));
  Field<2> points(2, 2);
  points << 0.4, 0.4, 5.0, 0.4;
  const auto options = row_options<2>();
  EXPECT_THAT(
      [&] { PointOperator<2>(m.set, m.ghosts, points, options); },
      ThrowsMessage<fpm::PoorNeighbourhood>(HasSubstr("point 1 at (5, 0.4) m has no well-")));
  const Field<2> inside = points.topRows(1);
  const PointOperator<2> op(m.set, m.ghosts, inside, options);
  Field<2> one(1, 2);
  EXPECT_THROW(op.values(points, one), fpm::ShapeError);
  EXPECT_THROW(op.values(m.set.position, points), fpm::ShapeError);
  EXPECT_THROW(op.add_transposed_values(points, points), fpm::ShapeError);
  EXPECT_THROW(op.add_transposed_values(inside, points), fpm::ShapeError);

  auto wrong = options;
  wrong.support_radius = -1.0;
  EXPECT_THAT([&] { PointOperator<2>(m.set, m.ghosts, inside, wrong); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("support radius must be positive")));
  wrong = options;
  wrong.max_enlargement = 0.5;
  EXPECT_THAT([&] { PointOperator<2>(m.set, m.ghosts, inside, wrong); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("must be at least 1")));
  EXPECT_THAT(
      [&] {
        PointOperator<2>::at_particles(m.set, m.ghosts, {0, 64}, options);
      },
      ThrowsMessage<fpm::ShapeError>(HasSubstr("particle 64 of 64")));
}

}  // namespace

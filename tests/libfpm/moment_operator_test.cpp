// Gather and scatter against the loops they stand for, and the layout they run on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <fpm/moment_operator.hpp>

#include <algorithm>
#include <numeric>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::Channels;
using fpm::MomentOperator;

constexpr Channels every_channels[] = {{false, false}, {true, false}, {false, true}, {true, true}};

// Widest row of all sets here, images included.
constexpr double widest = 90.0;

template <int Dim>
void expect_as_written(const Model<Dim>& m, Channels channels) {
  const MomentOperator<Dim> op(m.rows, m.ghosts, channels);
  const Field<Dim> u = random_field<Dim>(op.size(), 11);
  const Field<Dim> x = random_field<Dim>(op.size(), 12);
  const Eigen::MatrixXd moments = gathered(op, u);
  const Eigen::MatrixXd expected = reference_moments(op, m.rows, u);
  for (Eigen::Index c = 0; c < expected.cols(); ++c) {
    const double largest = expected.col(c).cwiseAbs().maxCoeff();
    EXPECT_LE((moments.col(c) - expected.col(c)).cwiseAbs().maxCoeff(), round_off(widest, largest))
        << "moment " << c;
  }

  const Eigen::MatrixXd stress =
      random_vector(op.size() * op.stress_count(), 13).reshaped(op.size(), op.stress_count());
  const Field<Dim> force = scattered(op, stress, u, x);
  const Field<Dim> expected_force = reference_force(op, m.rows, stress, u, x);
  EXPECT_LE((force - expected_force).cwiseAbs().maxCoeff(),
            round_off(widest, expected_force.cwiseAbs().maxCoeff()));
}

template <int Dim>
void expect_as_written(const LatticeOptions<Dim>& options,
                       const std::vector<SymmetryPlane>& planes = {}) {
  for (const Channels channels : every_channels) {
    SCOPED_TRACE(testing::Message() << "pair " << channels.pair << ", second " << channels.second
                                    << ", cells " << options.max.transpose() / options.spacing);
    expect_as_written(Model<Dim>(options, channels.second, planes), channels);
  }
}

TEST(MomentOperator, IsTheLoopOverRowsOnLattices) {
  // Sizes around the widths of lanes (4), blocks (64) and their remainders.
  for (const auto& cells : {Counts<2>{3, 3}, Counts<2>{4, 4}, Counts<2>{5, 3}, Counts<2>{9, 7},
                            Counts<2>{8, 8}, Counts<2>{13, 5}, Counts<2>{43, 3}}) {
    expect_as_written<2>(lattice<2>(cells));
  }
  for (const auto& cells : {Counts<3>{3, 3, 3}, Counts<3>{5, 4, 4}, Counts<3>{13, 3, 3}}) {
    expect_as_written<3>(lattice<3>(cells));
  }
}

TEST(MomentOperator, IsTheLoopOverRowsOnVerticesAndJitter) {
  expect_as_written<2>(lattice<2>({9, 7}, 0.1, LatticeLayout::vertex));
  expect_as_written<2>(lattice<2>({9, 7}, 0.1, LatticeLayout::cell, 0.2));
  expect_as_written<3>(lattice<3>({4, 5, 4}, 0.1, LatticeLayout::vertex, 0.2));
}

TEST(MomentOperator, IsTheLoopOverRowsWithImages) {
  // Images outnumber a block, and their number is no multiple of the lanes.
  expect_as_written<2>(lattice<2>({9, 7}), {{0, 0.0}});
  expect_as_written<2>(lattice<2>({30, 9}), {{0, 0.0}, {1, 0.0}});
  expect_as_written<2>(lattice<2>({9, 7}, 0.1, LatticeLayout::cell, 0.2), {{1, 0.7}});
  expect_as_written<3>(lattice<3>({5, 4, 5}), {{0, 0.0}, {2, 0.5}});
}

TEST(MomentOperator, IsTheLoopOverRowsAfterAResearch) {
  Model<2> m(lattice<2>({20, 9}), true, {{0, 0.0}});
  Tensor<2> f;
  f << 1.0, 0.4, 0.0, 0.95;
  const Field<2> now = affine<2>(m.set.position, f, Vector<2>::Zero());
  const auto rebuilt = m.rows.research({20, 21, 22, 23, 24, 66, 101}, now,
                                       f.determinant() * m.set.volume, std::vector<char>(180, 0));
  ASSERT_EQ(rebuilt.size(), 7U);
  for (const Channels channels : every_channels) expect_as_written(m, channels);
}

// (S, W u) = (W^T S, u), the stresses being those that act on the moments.
template <int Dim>
void expect_adjoint(const LatticeOptions<Dim>& options, Channels channels,
                    const std::vector<SymmetryPlane>& planes) {
  const Model<Dim> m(options, channels.second, planes);
  const MomentOperator<Dim> op(m.rows, m.ghosts, channels);
  const Field<Dim> u = random_field<Dim>(op.size(), 21);
  const Eigen::MatrixXd moments = gathered(op, u);
  ASSERT_EQ(op.stress_count(), moments.cols());
  const Eigen::MatrixXd stress =
      random_vector(moments.size(), 22).reshaped(moments.rows(), moments.cols());
  const double of_moments = stress.cwiseProduct(moments).sum();
  const double of_forces = scattered(op, stress, u, u).cwiseProduct(u).sum();
  const double absolute = stress.cwiseProduct(moments).cwiseAbs().sum();
  // Each moment and each force is a sum of `widest` products; the two outer sums are pairwise.
  EXPECT_NEAR(of_moments, of_forces, round_off(widest, absolute));
}

TEST(MomentOperator, ScatterIsTheExactTransposeOfGather) {
  for (const double jitter : {0.0, 0.2}) {
    for (const Channels channels : {Channels{false, false}, Channels{false, true}}) {
      const auto plane = lattice<2>({13, 9}, 0.1, LatticeLayout::cell, jitter);
      const auto space = lattice<3>({6, 4, 5}, 0.1, LatticeLayout::cell, jitter);
      expect_adjoint<2>(plane, channels, {});
      expect_adjoint<2>(plane, channels, {{0, 0.0}, {1, 0.9}});
      expect_adjoint<3>(space, channels, {});
      expect_adjoint<3>(space, channels, {{2, 0.0}});
    }
  }
}

TEST(MomentOperator, ForEachEntryVisitsTheRowsWeights) {
  for (const double jitter : {0.0, 0.2}) {
    const Model<2> m(lattice<2>({13, 9}, 0.1, LatticeLayout::cell, jitter), true, {{0, 0.0}});
    const Channels all{true, true};
    const MomentOperator<2> op(m.rows, m.ghosts, all);
    for (Index a = 0; a < op.size(); ++a) {
      const auto row = reference_row(m.rows, a, all);
      std::size_t k = 0;
      op.for_each_entry(a, [&](Index b, const double* weights) {
        ASSERT_LT(k, row.node.size());
        EXPECT_EQ(b, row.node[k]);
        for (int c = 0; c < op.channel_count(); ++c) {
          EXPECT_EQ(weights[c], row.weight(c, static_cast<Eigen::Index>(k)));
        }
        ++k;
      });
      EXPECT_EQ(k, row.node.size());
    }
  }
}

template <int Dim>
void expect_channels_where_they_say(const LatticeOptions<Dim>& options) {
  const Model<Dim> m(options, true);
  fpm::RowGeometry<Dim> geometry;
  fpm::RowWeights<Dim> weights;
  constexpr Index row = 0;
  m.rows.geometry(row, geometry);
  compute_weights(geometry, m.rows.options().kernel, true, weights);
  for (const Channels channels : every_channels) {
    const MomentOperator<Dim> op(m.rows, m.ghosts, channels);
    ASSERT_EQ(op.channel_count(), channels.count(Dim));
    ASSERT_LE(channels.count(Dim), fpm::most_channels<Dim>);
    Eigen::Index k = 0;
    op.for_each_entry(row, [&](Index, const double* w) {
      int used = 0;
      const auto expect = [&](int at, const Eigen::VectorXd& values) {
        for (const double value : values) EXPECT_EQ(w[at++], value);
        used += static_cast<int>(values.size());
      };
      expect(0, weights.gradient.col(k));
      if (channels.pair) {
        expect(Channels::kappa(Dim), weights.kappa.segment(k, 1));
        expect(Channels::kappa_x(Dim), weights.kappa[k] * geometry.offset.col(k));
      }
      if (channels.second) expect(channels.second_gradient(Dim), weights.second.col(k));
      EXPECT_EQ(used, channels.count(Dim));
      ++k;
    });
    EXPECT_EQ(k, geometry.size());
  }
}

TEST(Channels, SayWhereTheWeightsOfEachKindBegin) {
  expect_channels_where_they_say<2>(lattice<2>({5, 4}));
  expect_channels_where_they_say<3>(lattice<3>({5, 4, 4}));
}

TEST(MomentOperator, PairMomentsAreThoseOfTheWeights) {
  const Model<3> m(lattice<3>({5, 4, 4}));
  const MomentOperator<3> op(m.rows, m.ghosts, {.pair = true});
  fpm::RowGeometry<3> geometry;
  fpm::RowWeights<3> weights;
  for (Index a = 0; a < op.size(); ++a) {
    m.rows.geometry(a, geometry);
    compute_weights(geometry, fpm::Kernel::cubic_spline, false, weights);
    const Vector<3> first = geometry.offset * weights.kappa;
    const Tensor<3> second =
        geometry.offset * weights.kappa.asDiagonal() * geometry.offset.transpose();
    const double terms = static_cast<double>(geometry.size());
    EXPECT_LE((op.first_moment(a) - first).norm(),
              round_off(terms, (weights.kappa * geometry.support_radius).maxCoeff()));
    EXPECT_LE((op.second_moment(a) - second).norm(), round_off(terms, 1.0));
    EXPECT_NEAR(op.second_moment(a).trace(), 1.0, round_off(terms, 1.0));
  }
}

TEST(MomentOperator, LatticeRowsShareTheirStencils) {
  // The footing's lattice: all but a rim of three particles, which is 10 % of it.
  const Model<2> m(lattice<2>({110, 66}));
  const MomentOperator<2> op(m.rows, m.ghosts, {.pair = true});
  EXPECT_GT(op.shared_share(), 0.85);
  EXPECT_LE(op.shared_share(), 1.0);
  const Model<2> jittered(lattice<2>({110, 66}, 0.1, LatticeLayout::cell, 0.01));
  const MomentOperator<2> own(jittered.rows, jittered.ghosts, {.pair = true});
  EXPECT_EQ(own.shared_share(), 0.0);
  EXPECT_LT(op.bytes(), own.bytes() / 5);
}

TEST(MomentOperator, SharedAndOwnStencilsGiveTheSame) {
  // The same lattice in a random order shares nothing and differs in the order of sums alone.
  const auto options = lattice<2>({30, 20});
  const Model<2> m(options, true);
  std::vector<Index> order(600);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 generator(5);
  for (std::size_t k = 599; k > 0; --k) std::swap(order[k], order[generator() % (k + 1)]);
  ParticleSet<2> shuffled;
  shuffled.position = m.set.position(order, Eigen::all);
  shuffled.volume = m.set.volume(order);
  const Model<2> n(shuffled, row_options<2>(0.1, true));
  const Channels all{true, true};
  const MomentOperator<2> shared(m.rows, m.ghosts, all);
  const MomentOperator<2> own(n.rows, n.ghosts, all);
  ASSERT_GT(shared.shared_share(), 0.5);
  ASSERT_EQ(own.shared_share(), 0.0);

  const Field<2> u = random_field<2>(600, 31);
  const Eigen::MatrixXd moments = gathered(shared, u);
  const Eigen::MatrixXd reordered = gathered(own, Field<2>(u(order, Eigen::all)));
  // Weights of the two come from moment matrices summed in different orders; the worst condition
  // number is that of A in the corners, below 1e3.
  constexpr double condition = 1e3;
  for (Eigen::Index c = 0; c < moments.cols(); ++c) {
    const double largest = moments.col(c).cwiseAbs().maxCoeff();
    EXPECT_LE((moments(order, c) - reordered.col(c)).cwiseAbs().maxCoeff(),
              (4.0 * condition + widest) * epsilon * largest);
  }
  const Eigen::MatrixXd stress =
      random_vector(600 * shared.stress_count(), 32).reshaped(600, shared.stress_count());
  const Field<2> force = scattered(shared, stress, u, m.set.position);
  const Field<2> same =
      scattered(own, stress(order, Eigen::all), Field<2>(u(order, Eigen::all)), shuffled.position);
  EXPECT_LE((force(order, Eigen::all) - same).cwiseAbs().maxCoeff(),
            (4.0 * condition + widest) * epsilon * force.cwiseAbs().maxCoeff());
}

TEST(MomentOperator, ConstantFieldsHaveNoMomentsAtAll) {
  for (const double jitter : {0.0, 0.2}) {
    const Model<2> m(lattice<2>({13, 9}, 0.1, LatticeLayout::cell, jitter), true);
    const MomentOperator<2> op(m.rows, m.ghosts, {true, true});
    EXPECT_EQ(gathered(op, Field<2>(Field<2>::Constant(117, 2, 1e9))).cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(MomentOperator, IncrementsLoseNoDigitsToTheDistanceFromTheOrigin) {
  // Moments are sums of differences: a translation of the set changes the last bits of the
  // coordinates, and nothing else.
  const Model<2> near(lattice<2>({9, 7}, 0.125));
  const Model<2> far(lattice<2>({9, 7}, 0.125, LatticeLayout::cell, 0.0, 65536.0));
  const Field<2> u = 1e-6 * random_field<2>(63, 41);
  EXPECT_EQ(gathered(MomentOperator<2>(near.rows, near.ghosts, {}), u),
            gathered(MomentOperator<2>(far.rows, far.ghosts, {}), u));
}

TEST(MomentOperator, RefusesAPotentialOfAnotherSize) {
  const Model<2> m(lattice<2>({9, 7}));
  EXPECT_THROW(MomentOperator<2>(m.rows, m.ghosts, {}, {Field<2>::Zero(62, 2), {}}),
               fpm::ShapeError);
}

}  // namespace

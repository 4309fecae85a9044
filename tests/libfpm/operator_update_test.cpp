// An operator that has followed re-searches against one that is built anew: the same to the bit.
#include <gtest/gtest.h>
#include <fpm/moment_operator.hpp>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::Channels;
using fpm::MomentOperator;

template <int Dim>
void expect_equal(const MomentOperator<Dim>& found, const MomentOperator<Dim>& expected) {
  const Field<Dim> u = random_field<Dim>(found.size(), 5);
  const Field<Dim> x = random_field<Dim>(found.size(), 6);
  EXPECT_EQ(gathered(found, u), gathered(expected, u));
  const Eigen::MatrixXd stress = random_vector(found.size() * found.stress_count(), 7)
                                     .reshaped(found.size(), found.stress_count());
  EXPECT_EQ(scattered(found, stress, u, x), scattered(expected, stress, u, x));
  for (Index a = 0; a < found.size() && found.channels().pair; ++a) {
    EXPECT_EQ(found.first_moment(a), expected.first_moment(a)) << a;
    EXPECT_EQ(found.second_moment(a), expected.second_moment(a)) << a;
  }
}

// Patches of rows are searched again and again while the set shears.
template <int Dim>
void expect_follows(const LatticeOptions<Dim>& box, const std::vector<SymmetryPlane>& planes,
                    Channels channels) {
  Model<Dim> m(box, channels.second, planes);
  const Index n = m.rows.size();
  MomentOperator<Dim> op(m.rows, m.ghosts, channels);
  const std::vector<char> excluded(static_cast<std::size_t>(n), 0);
  std::size_t rebuilt_rows = 0;
  for (const Index round : {1, 2, 3}) {
    Tensor<Dim> f = Tensor<Dim>::Identity();
    f(0, 1) = 0.3 * round;
    const Field<Dim> now = affine<Dim>(m.set.position, f, Vector<Dim>::Zero());
    std::vector<Index> rows;
    for (Index a = n / 5 * round; a < n / 5 * round + 1 + n / 9; ++a) rows.push_back(a);
    const auto rebuilt = m.rows.research(rows, now, m.set.volume, excluded);
    rebuilt_rows += rebuilt.size();
    op.update(m.rows, rebuilt);
    expect_equal(op, MomentOperator<Dim>(m.rows, m.ghosts, channels));
  }
  EXPECT_GT(rebuilt_rows, static_cast<std::size_t>(n / 9));
}

TEST(OperatorUpdate, IsTheOperatorBuiltAnew) {
  for (const bool pair : {false, true}) {
    for (const bool second : {false, true}) {
      SCOPED_TRACE(testing::Message() << "pair " << pair << ", second " << second);
      expect_follows<2>(lattice<2>({31, 17}), {}, {pair, second});
      expect_follows<3>(lattice<3>({9, 7, 8}), {}, {pair, second});
    }
  }
}

TEST(OperatorUpdate, IsSoWithImagesAndJitter) {
  expect_follows<2>(lattice<2>({31, 17}), {{1, 0.0}}, {true, true});
  expect_follows<2>(lattice<2>({23, 17}, 0.1, LatticeLayout::vertex, 0.2), {}, {true, true});
}

TEST(OperatorUpdate, OfNoRowsChangesNothing) {
  const Model<2> m(lattice<2>({12, 9}));
  MomentOperator<2> op(m.rows, m.ghosts, {true, false});
  op.update(m.rows, {});
  expect_equal(op, MomentOperator<2>(m.rows, m.ghosts, {true, false}));
}

TEST(OperatorUpdate, KeepsOneCopyOfASharedStencil) {
  Model<2> m(lattice<2>({60, 40}));
  MomentOperator<2> op(m.rows, m.ghosts, {});
  const std::vector<char> excluded(2400, 0);
  Tensor<2> f = Tensor<2>::Identity();
  f(0, 1) = 0.3;
  const Field<2> now = affine<2>(m.set.position, f, Vector<2>::Zero());
  for (Index a = 1210; a < 1230; ++a) {
    op.update(m.rows, m.rows.research({a}, now, m.set.volume, excluded));
  }
  EXPECT_EQ(op.bytes(), MomentOperator<2>(m.rows, m.ghosts, {}).bytes());
}

TEST(OperatorUpdate, RefusesOtherRows) {
  const Model<2> m(lattice<2>({12, 9}));
  const Model<2> other(lattice<2>({12, 8}));
  MomentOperator<2> op(m.rows, m.ghosts, {});
  EXPECT_THROW(op.update(other.rows, {}), fpm::ShapeError);
}

}  // namespace

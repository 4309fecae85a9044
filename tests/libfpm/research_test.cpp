// Local re-search: rows rebuilt on current positions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <fpm/rows.hpp>

#include <numeric>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

std::vector<Index> every_row(Index n) {
  std::vector<Index> rows(static_cast<std::size_t>(n));
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

std::vector<char> nothing_excluded(Index n) {
  return std::vector<char>(static_cast<std::size_t>(n), 0);
}

std::vector<Index> list(const Rows<2>& rows, Index a) {
  const auto found = rows.neighbours(a);
  return {found.begin(), found.end()};
}

// Moderate simple shear with compression: neighbours change, no row is lost.
Tensor<2> deformation() {
  Tensor<2> f;
  f << 1.1, 0.6, 0.0, 0.9;
  return f;
}

TEST(Research, RebuiltRowsReproduceLinearFieldsOfTheCurrentPositions) {
  Model<2> m(lattice<2>({12, 10}));
  const Field<2> now = affine<2>(m.set.position, deformation(), Vector<2>::Constant(4.0));
  const Eigen::VectorXd volume = deformation().determinant() * m.set.volume;
  const auto rebuilt = m.rows.research(every_row(120), now, volume, nothing_excluded(120));
  ASSERT_EQ(rebuilt, every_row(120));

  fpm::RowGeometry<2> row;
  fpm::RowWeights<2> weights;
  for (const Index a : rebuilt) {
    EXPECT_TRUE(m.rows.searched(a));
    EXPECT_EQ(m.rows.reference_volume()[a], volume[a]);
    m.rows.geometry(a, row);
    compute_weights(row, fpm::Kernel::cubic_spline, false, weights);
    Tensor<2> unit = Tensor<2>::Zero();
    Eigen::Index k = 0;
    for (const Index b : m.rows.neighbours(a)) {
      unit += (now.row(b) - now.row(a)).transpose() * weights.gradient.col(k++).transpose();
    }
    const double absolute_sum = weights.gradient.cwiseAbs().sum() * row.support_radius;
    EXPECT_LE((unit - Tensor<2>::Identity()).norm(),
              (4.0 * weights.condition + 50.0) * epsilon * absolute_sum);
  }
}

TEST(Research, FindsTheNeighboursWithinTheSupportAtPresent) {
  Model<2> m(lattice<2>({12, 10}));
  const Field<2> now = affine<2>(m.set.position, deformation(), Vector<2>::Zero());
  const auto before = list(m.rows, 54);
  m.rows.research({54}, now, m.set.volume, nothing_excluded(120));
  std::vector<Index> expected;
  for (Index b = 0; b < 120; ++b) {
    if (b != 54 && (now.row(b) - now.row(54)).norm() < support * 0.1) expected.push_back(b);
  }
  EXPECT_EQ(list(m.rows, 54), expected);
  EXPECT_NE(expected, before);
}

TEST(Research, LeavesTheOtherRowsAsTheyWere) {
  Model<2> m(lattice<2>({12, 10}));
  const Rows<2> before = m.rows;
  const Field<2> now = affine<2>(m.set.position, deformation(), Vector<2>::Zero());
  m.rows.research({7, 54}, now, 2.0 * m.set.volume, nothing_excluded(120));
  fpm::RowGeometry<2> kept;
  fpm::RowGeometry<2> old;
  for (Index a = 0; a < 120; ++a) {
    if (a == 7 || a == 54) continue;
    before.geometry(a, old);
    m.rows.geometry(a, kept);
    EXPECT_EQ(list(m.rows, a), list(before, a));
    EXPECT_EQ(kept.offset, old.offset);
    EXPECT_EQ(kept.volume, old.volume);
    EXPECT_EQ(kept.own_volume, old.own_volume);
  }
}

TEST(Research, KeepsTheReferenceOfEarlierRebuiltRows) {
  Model<2> m(lattice<2>({12, 10}));
  const Field<2> first = affine<2>(m.set.position, deformation(), Vector<2>::Zero());
  m.rows.research({54}, first, m.set.volume, nothing_excluded(120));
  fpm::RowGeometry<2> before;
  m.rows.geometry(54, before);
  const Field<2> later = affine<2>(first, deformation(), Vector<2>::Zero());
  m.rows.research({30, 90}, later, 3.0 * m.set.volume, nothing_excluded(120));
  fpm::RowGeometry<2> after;
  m.rows.geometry(54, after);
  EXPECT_EQ(after.offset, before.offset);
  EXPECT_EQ(after.volume, before.volume);
  EXPECT_EQ(after.own_volume, before.own_volume);
}

TEST(Research, TheOrderAndRepetitionOfTheRowsDoNotMatter) {
  Model<2> m(lattice<2>({12, 10}));
  Model<2> n(lattice<2>({12, 10}));
  const Field<2> now = affine<2>(m.set.position, deformation(), Vector<2>::Zero());
  EXPECT_THAT(m.rows.research({90, 7, 54, 7}, now, m.set.volume, nothing_excluded(120)),
              ElementsAre(7, 54, 90));
  n.rows.research({7, 54, 90}, now, m.set.volume, nothing_excluded(120));
  fpm::RowGeometry<2> left;
  fpm::RowGeometry<2> right;
  for (Index a = 0; a < 120; ++a) {
    EXPECT_EQ(list(m.rows, a), list(n.rows, a));
    m.rows.geometry(a, left);
    n.rows.geometry(a, right);
    EXPECT_EQ(left.offset, right.offset);
  }
}

TEST(Research, DoesNotPickUpExcludedParticlesButKeepsThoseItHad) {
  // The upper half slides by five spacings over the lower one; the last row is a plate's.
  Model<2> m(lattice<2>({12, 10}));
  Field<2> now = m.set.position;
  for (Index a = 60; a < 120; ++a) now(a, 0) += 0.3;
  std::vector<char> excluded = nothing_excluded(120);
  const Index row = 53;   // fifth row from below, next to the interface
  const Index kept = 65;  // right above it at the start, still within reach
  const Index met = 63;   // slides over it
  ASSERT_THAT(list(m.rows, row), Contains(kept));
  Model<2> free = m;
  free.rows.research({row}, now, m.set.volume, excluded);
  ASSERT_THAT(list(free.rows, row), Contains(61));
  ASSERT_THAT(list(m.rows, row), Not(Contains(61)));
  for (Index a = 60; a < 120; ++a) excluded[static_cast<std::size_t>(a)] = 1;
  ASSERT_THAT(m.rows.research({row}, now, m.set.volume, excluded), ElementsAre(row));
  EXPECT_THAT(list(m.rows, row), Not(Contains(61)));
  EXPECT_THAT(list(m.rows, row), Contains(met));
}

TEST(Research, SkipsARowThatWouldLoseItsNeighbourhood) {
  Model<2> m(lattice<2>({12, 10}));
  Field<2> now = m.set.position;
  now.row(54) << 10.0, 10.0;
  const auto before = list(m.rows, 54);
  EXPECT_THAT(m.rows.research({54}, now, 2.0 * m.set.volume, nothing_excluded(120)), IsEmpty());
  EXPECT_FALSE(m.rows.searched(54));
  EXPECT_EQ(list(m.rows, 54), before);
  EXPECT_EQ(m.rows.reference_volume()[54], m.set.volume[54]);
}

TEST(Research, SkipsARowWhoseNeighboursFellIntoALine) {
  Model<2> m(lattice<2>({12, 10}));
  Field<2> now = m.set.position;
  now.col(1).setZero();
  EXPECT_THAT(m.rows.research({54}, now, m.set.volume, nothing_excluded(120)), IsEmpty());
}

TEST(Research, SeesTheImagesAtTheirCurrentPlace) {
  // A lattice beside the plane x = 0, stretched along it: images move with their sources.
  Model<2> m(lattice<2>({8, 8}), false, {{0, 0.0}});
  Tensor<2> f = Tensor<2>::Identity();
  f(0, 0) = 0.8;
  const Field<2> now = affine<2>(m.set.position, f, Vector<2>::Zero());
  const Index row = 32;  // next to the plane
  ASSERT_THAT(m.rows.research({row}, now, 0.8 * m.set.volume, nothing_excluded(64)),
              ElementsAre(row));
  fpm::RowGeometry<2> geometry;
  m.rows.geometry(row, geometry);
  Eigen::Index k = 0;
  int images = 0;
  for (const Index b : m.rows.neighbours(row)) {
    if (b >= 64) {
      ++images;
      const Index source = m.ghosts.source(b - 64);
      EXPECT_NEAR(geometry.offset(0, k), -now(source, 0) - now(row, 0), 2.0 * epsilon);
      EXPECT_NEAR(geometry.offset(1, k), now(source, 1) - now(row, 1), 2.0 * epsilon);
      EXPECT_EQ(geometry.volume[k], 0.8 * m.set.volume[source]);
    }
    ++k;
  }
  EXPECT_GT(images, 5);
}

TEST(Research, RefusesSizesAndRowsThatCannotBe) {
  Model<2> m(lattice<2>({8, 8}));
  const Field<2> short_field = m.set.position.topRows(63);
  const Eigen::VectorXd short_volume = m.set.volume.head(63);
  const auto refused = [](const char* why) {
    return ThrowsMessage<fpm::ShapeError>(HasSubstr(why));
  };
  EXPECT_THAT([&] { m.rows.research({0}, short_field, m.set.volume, nothing_excluded(64)); },
              refused("positions has size 63, expected 64"));
  EXPECT_THAT([&] { m.rows.research({0}, m.set.position, short_volume, nothing_excluded(64)); },
              refused("volumes has size 63, expected 64"));
  EXPECT_THAT([&] { m.rows.research({0}, m.set.position, m.set.volume, nothing_excluded(63)); },
              refused("excluded has size 63, expected 64"));
  EXPECT_THAT([&] { m.rows.research({64}, m.set.position, m.set.volume, nothing_excluded(64)); },
              refused("row 64 of 64"));
  EXPECT_THAT([&] { m.rows.research({-1}, m.set.position, m.set.volume, nothing_excluded(64)); },
              refused("row -1 of 64"));
}

}  // namespace

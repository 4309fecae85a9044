// Bodies of a lattice, the faces they share, and rows that see their own body alone.
#include <gtest/gtest.h>
#include <fpm/bodies.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::Face;

bool never(Index, Index) {
  return false;
}

// Labels of a 2D lattice from its rows' pictures, the lowest row first.
std::vector<Index> labels(const std::vector<std::string>& rows) {
  std::vector<Index> all;
  for (const std::string& row : rows) {
    for (const char letter : row) all.push_back(letter - 'a');
  }
  return all;
}

TEST(Bodies, AreConnectedByFaces) {
  const auto body = fpm::bodies_of<2>(Cells<2>(lattice<2>({4, 4})),
                                      labels({"aabb", "aabb", "bbaa", "bbaa"}), never, 2);
  EXPECT_EQ(body, labels({"aabb", "aabb", "ccdd", "ccdd"}));
}

TEST(Bodies, OfJoinedLabelsAreOne) {
  const auto joined = [](Index low, Index high) { return low == 0 && high == 2; };
  const auto body =
      fpm::bodies_of<2>(Cells<2>(lattice<2>({6, 2})), labels({"aabbcc", "aabbcc"}), joined, 2);
  EXPECT_EQ(body, labels({"aabbcc", "aabbcc"}));
  const auto next =
      fpm::bodies_of<2>(Cells<2>(lattice<2>({6, 2})), labels({"bbaacc", "bbaacc"}), joined, 2);
  EXPECT_EQ(next, labels({"aabbbb", "aabbbb"}));
}

// A chain 0 - 1 - 2 - 3 and a particle of its own.
TEST(BodiesOfPairs, AreThoseThatMeetWithEqualOrJoinedLabels) {
  const std::vector<std::pair<Index, Index>> chain{{1, 0}, {1, 2}, {3, 2}};
  const auto never = [](Index, Index) { return false; };
  const auto always = [](Index low, Index high) { return low < high; };
  EXPECT_EQ(fpm::bodies_of({5, 5, 7, 5, 7}, chain, never), (std::vector<Index>{0, 0, 1, 2, 3}));
  EXPECT_EQ(fpm::bodies_of({5, 5, 7, 5, 7}, chain, always), (std::vector<Index>{0, 0, 0, 0, 1}));
  EXPECT_THROW((void)fpm::bodies_of({5, 5}, chain, never), fpm::ShapeError);
}

TEST(Bodies, ThinOnesGoWithTheirNeighbours) {
  const std::vector<Index> seam = labels({"aaa", "aaa", "aaa", "bbb", "bbb", "aaa", "aaa", "aaa"});
  EXPECT_EQ(fpm::bodies_of<2>(Cells<2>(lattice<2>({3, 8})), seam, never, 3),
            std::vector<Index>(24, 0));
  EXPECT_EQ(fpm::bodies_of<2>(Cells<2>(lattice<2>({3, 8})), seam, never, 2),
            labels({"aaa", "aaa", "aaa", "bbb", "bbb", "ccc", "ccc", "ccc"}));
}

// A wedge is a body for all its tip.
TEST(Bodies, ThinInPartStayBodies) {
  const std::vector<Index> wedge =
      labels({"aaaaaaaa", "aaaaaaaa", "aaaaaaaa", "bbbbbbbb", "bbbbbbcc", "bbbbcccc", "bbbccccc",
              "cccccccc", "cccccccc", "cccccccc"});
  EXPECT_EQ(fpm::bodies_of<2>(Cells<2>(lattice<2>({8, 10})), wedge, never, 3), wedge);
}

// Two particles of their own have no row; such rows see all bodies, and no others see them for it.
TEST(Bodies, RowsWithoutNeighbourhoodOfTheirOwnSeeAll) {
  ParticleSet<2> set = make_lattice(lattice<2>({8, 8}));
  set.body.assign(64, 0);
  set.body[0] = set.body[1] = 1;
  const Ghosts<2> none;
  const Rows<2> rows(set, none, row_options<2>());
  const auto sees = [&](Index row, Index other) {
    const auto neighbours = rows.neighbours(row);
    return std::find(neighbours.begin(), neighbours.end(), other) != neighbours.end();
  };
  EXPECT_TRUE(sees(0, 1));
  EXPECT_TRUE(sees(0, 8));
  EXPECT_FALSE(sees(8, 0));
  EXPECT_TRUE(sees(8, 9));
}

template <int Dim>
void expect_closed_surfaces(const Cells<Dim>& cells) {
  // A block in the upper corner is of another body.
  const ParticleSet<Dim> set = fpm::make_particles(cells);
  std::vector<Index> label;
  for (Index a = 0; a < set.size(); ++a) {
    label.push_back((set.position.row(a).array() > 0.29).all() ? 1 : 0);
  }
  const auto body = fpm::bodies_of<Dim>(cells, label, never, 2);
  EXPECT_EQ(body, label);
  auto faces = fpm::common_faces(cells, body);
  ASSERT_EQ(faces.first.size(), faces.second.size());
  for (std::size_t c = 0; c < faces.first.size(); ++c) {
    EXPECT_NE(body[static_cast<std::size_t>(faces.first[c])],
              body[static_cast<std::size_t>(faces.second[c])]);
  }
  // sum s = 0 and sum s x X = |Omega| I of the block, its outer faces and those it shares.
  Vector<Dim> sum = Vector<Dim>::Zero();
  Tensor<Dim> moment = Tensor<Dim>::Zero();
  const auto add = [&](const auto& points, Eigen::Index c, double sign) {
    const Vector<Dim> s = sign * points.weight[c] * points.normal.row(c).transpose();
    sum += s;
    moment += s * points.position.row(c);
  };
  for (Eigen::Index c = 0; c < faces.points.weight.size(); ++c) {
    const bool block_first =
        body[static_cast<std::size_t>(faces.first[static_cast<std::size_t>(c)])] == 1;
    add(faces.points, c, block_first ? 1.0 : -1.0);
  }
  for (const Face& face : fpm::all_faces<Dim>()) {
    const auto outer = fpm::outer_faces(cells, face);
    EXPECT_NEAR(outer.points.weight.sum(), std::pow(0.6, Dim - 1), 1e-14);
    for (Eigen::Index c = 0; c < outer.points.weight.size(); ++c) {
      const Index cell = outer.first[static_cast<std::size_t>(c)];
      EXPECT_EQ(cells.containing(outer.points.position.row(c).transpose()), cell);
      if (body[static_cast<std::size_t>(cell)] == 1) add(outer.points, c, 1.0);
    }
  }
  double volume = 0.0;
  for (Index a = 0; a < set.size(); ++a) {
    if (body[static_cast<std::size_t>(a)] == 1) volume += set.volume[a];
  }
  EXPECT_LE(sum.norm(), 1e-15);
  EXPECT_LE((moment - volume * Tensor<Dim>::Identity()).norm(), 1e-15);
}

TEST(CommonFaces, CloseTheSurfaceOfEachBody) {
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    expect_closed_surfaces(Cells<2>(lattice<2>({6, 6}, 0.1, layout)));
    expect_closed_surfaces(Cells<3>(lattice<3>({6, 6, 6}, 0.1, layout)));
  }
}

TEST(CommonFaces, CloseTheSurfaceOfEachBodyWhereCellsDifferInWidth) {
  // Fine beside a face of the block that the widest cells end at.
  const auto graded = [](const auto& lower, const auto& /*upper*/) {
    return lower[0] < 0.29 ? 0.05 : 0.1;
  };
  const Cells<2> cells(lattice<2>({12, 12}, 0.05), graded);
  ASSERT_TRUE(cells.graded());
  expect_closed_surfaces(cells);
  expect_closed_surfaces(Cells<3>(lattice<3>({12, 12, 12}, 0.05), graded));
}

TEST(Bodies, RowsAndPointsSeeTheirOwnAlone) {
  const auto box = lattice<2>({10, 8}, 0.1, LatticeLayout::cell, 0.2);
  ParticleSet<2> set = make_lattice(box);
  std::vector<Index> body(80);
  for (Index a = 0; a < 80; ++a) body[static_cast<std::size_t>(a)] = a / 10 < 4 ? 0 : 1;
  set.body = body;
  const Ghosts<2> none;
  Rows<2> rows(set, none, row_options<2>());
  const auto expect_own = [&] {
    for (Index a = 0; a < 80; ++a) {
      for (const Index b : rows.neighbours(a)) EXPECT_EQ(a / 10 < 4, b / 10 < 4) << a << ' ' << b;
    }
  };
  expect_own();
  std::vector<Index> all(80);
  for (Index a = 0; a < 80; ++a) all[static_cast<std::size_t>(a)] = a;
  ASSERT_FALSE(rows.research(all, set.position, set.volume, std::vector<char>(80, 0)).empty());
  expect_own();

  Field<2> field = Field<2>::Zero(80, 2);  // a jump from one body to the other
  field.bottomRows(40).setOnes();
  Field<2> points(2, 2);
  points << 0.5, 0.4, 0.5, 0.4;
  const fpm::PointOperator<2> either(set, none, points, row_options<2>(), {0, 40});
  EXPECT_LE(either.value(0, field).norm(), round_off(30.0, 1.0));
  EXPECT_LE((either.value(1, field) - Vector<2>::Ones()).norm(), round_off(30.0, 1.0));
}

}  // namespace

// Cells of lattices and of balanced trees, and what follows the spacing of each particle.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <fpm/boundary.hpp>
#include <fpm/cells.hpp>
#include <fpm/points.hpp>
#include <fpm/rows.hpp>
#include <stdexcept>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::BoundaryPoints;
using fpm::Face;

template <int Dim>
void expect_a_partition(const Cells<Dim>& cells) {
  const auto& box = cells.lattice();
  const ParticleSet<Dim> set = make_particles(cells);
  ASSERT_EQ(set.size(), cells.size());
  const double volume = (box.max - box.min).prod();
  EXPECT_NEAR(set.volume.sum(), volume, 1e-13 * volume);
  for (Index a = 0; a < cells.size(); ++a) {
    EXPECT_EQ(cells.containing(cells.site(a)), a);
    EXPECT_NEAR((cells.upper(a) - cells.lower(a)).prod(), set.volume[a], 1e-13 * set.volume[a]);
  }
}

TEST(Cells, PartitionTheirBox) {
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    expect_a_partition(Cells<2>(lattice<2>({5, 3}, 0.1, layout)));
    expect_a_partition(Cells<3>(lattice<3>({3, 4, 2}, 0.1, layout)));
  }
  expect_a_partition(graded_cells<2>({32, 24}));
  expect_a_partition(graded_cells<2>({37, 21}));  // no whole number of the widest
  expect_a_partition(graded_cells<3>({12, 9, 8}));
}

TEST(Cells, OfALatticeGiveItsParticles) {
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    const auto box = lattice<2>({7, 4}, 0.1, layout, 0.2);
    EXPECT_EQ(make_particles(Cells<2>(box)).position, make_lattice(box).position);
  }
  // A tree that is as fine everywhere is the lattice, in its order, jitter included.
  const auto box = lattice<2>({7, 4}, 0.1, LatticeLayout::cell, 0.2);
  const auto set = make_particles(Cells<2>(box, [](const auto&, const auto&) { return 0.0; }));
  EXPECT_EQ(set.position, make_lattice(box).position);
  EXPECT_EQ(set.spacing, Eigen::VectorXd::Constant(28, 0.1));
}

template <int Dim>
void expect_balance(const Cells<Dim>& cells) {
  bool graded = false;
  for (Index a = 0; a < cells.size(); ++a) {
    for (Index k = 0; k < static_cast<Index>(std::pow(3, Dim)); ++k) {  // corners included
      typename Cells<Dim>::Place beside = cells.place(a);
      for (Index i = 0, rest = k; i < Dim; ++i, rest /= 3) {
        beside[i] += rest % 3 == 0 ? -1 : rest % 3 == 1 ? 0 : cells.steps(a);
      }
      const Index b = cells.holding(beside);
      if (b < 0) continue;
      EXPECT_LE(cells.steps(b), 2 * cells.steps(a));
      graded = graded || cells.steps(b) > cells.steps(a);
    }
  }
  EXPECT_TRUE(graded);
}

TEST(Cells, ThatTouchDifferByAFactorOfTwoAtMost) {
  const auto fine_at = [](double radius) {
    return [radius](const auto& lower, const auto& /*upper*/) {
      return lower.norm() < radius ? 0.1 : 100.0;
    };
  };
  expect_balance(Cells<2>(lattice<2>({64, 48}), fine_at(0.05)));
  expect_balance(Cells<3>(lattice<3>({16, 16, 24}), fine_at(0.05)));
  expect_balance(graded_cells<2>({37, 21}));
}

// Heights of a number of finest cells that is nearly a power of two leave a thin cell of each width
// at the upper face: on wider ones none would see three layers, as quadratic fields ask for.
TEST(Cells, HaveNoLayerOfOneOnWiderOnes) {
  const auto fine_at_the_corner = [](const auto& lower, const auto& /*upper*/) {
    return std::max(0.1, 0.25 * lower.norm());
  };
  for (const Index height : {14, 15, 30, 31}) {
    const Cells<2> cells(lattice<2>({64, height}), fine_at_the_corner);
    expect_a_partition(cells);
    expect_balance(cells);
    for (Index a = 0; a < cells.size(); ++a) {
      if (cells.place(a)[1] + cells.steps(a) != height) continue;
      Vector<2> below = cells.site(a);
      below[1] -= cells.width(a);
      EXPECT_LE(cells.steps(cells.containing(below)), cells.steps(a));
    }
    EXPECT_NO_THROW(
        (void)fpm::Rows<2>(make_particles(cells), Ghosts<2>{}, row_options<2>(0.1, true)));
  }
}

TEST(Cells, AreAsWideAsWantedWhereNothingElseForbidsIt) {
  const Cells<2> cells(lattice<2>({64, 64}), [](const auto& lower, const auto& /*upper*/) {
    return std::max(0.1, 0.25 * lower.norm());
  });
  double widest = 0.0;
  for (Index a = 0; a < cells.size(); ++a) {
    EXPECT_LE(cells.width(a), (1.0 + 1e-9) * std::max(0.1, 0.25 * cells.lower(a).norm()));
    widest = std::max(widest, cells.width(a));
  }
  EXPECT_DOUBLE_EQ(widest, 1.6);
}

TEST(Cells, Coarsened) {
  const auto cells = graded_cells<2>({32, 24});
  for (const int levels : {1, 2}) {
    const auto coarse = cells.coarsened(levels);
    expect_a_partition(coarse);
    expect_balance(coarse);
    for (Index a = 0; a < cells.size(); ++a) {
      const Index around = coarse.containing(cells.site(a));
      EXPECT_GE(coarse.steps(around), cells.steps(a));
      EXPECT_LE(coarse.steps(around), cells.steps(a) << levels);
    }
    EXPECT_LT(coarse.size(), cells.size() / (2 * levels));
  }
  const auto halved = Cells<2>(lattice<2>({8, 6})).coarsened(1);
  EXPECT_EQ(halved.size(), 12);
}

TEST(Cells, Restricted) {
  // Of 4 x 3 equal cells the last column is cut away, and cell 6 goes to the one before it.
  const auto fine = [](const auto&, const auto&) { return 0.0; };
  const Cells<2> all(lattice<2>({4, 3}), fine);
  std::vector<Index> owner{0, 1, 2, -1, 4, 5, 5, -1, 8, 9, 10, -1};
  const Cells<2> rest = all.restricted(owner);
  ASSERT_EQ(rest.size(), 8);
  EXPECT_EQ(rest.containing({0.05, 0.05}), 0);
  EXPECT_EQ(rest.containing({0.35, 0.05}), -1);
  EXPECT_EQ(rest.containing({0.15, 0.15}), 4);
  EXPECT_EQ(rest.containing({0.25, 0.15}), 4);  // taken over
  EXPECT_EQ(rest.beside(2, 0, true), -1);
  EXPECT_EQ(rest.beside(4, 0, true), -1);  // past what it took over
  EXPECT_EQ(rest.beside(2, 1, true), 4);
  EXPECT_EQ(rest.beside(7, 1, false), 4);
  Index pairs = 0;
  rest.for_each_pair([&](Index low, Index high, int) {
    EXPECT_NE(low, high);
    ++pairs;
  });
  EXPECT_EQ(pairs, 5 + 6);  // 2 + 1 + 2 along x, 2 + 2 + 2 along y
  EXPECT_EQ(make_particles(rest).size(), 8);

  owner[5] = 4;  // who owns a cell is there
  EXPECT_THROW(static_cast<void>(all.restricted(owner)), fpm::ShapeError);
  owner.pop_back();
  EXPECT_THROW(static_cast<void>(all.restricted(owner)), fpm::ShapeError);
  EXPECT_THROW(
      static_cast<void>(Cells<2>(lattice<2>({4, 3})).restricted(std::vector<Index>(12, 0))),
      std::invalid_argument);
}

TEST(Cells, RefuseWhatIsNoTree) {
  const auto any = [](const auto&, const auto&) { return 1.0; };
  const auto vertices = lattice<2>({4, 4}, 0.1, LatticeLayout::vertex);
  EXPECT_THROW(Cells<2>(vertices, any), std::invalid_argument);
  EXPECT_THROW(Cells<2>(vertices).coarsened(1), std::invalid_argument);
  auto odd = lattice<2>({4, 4});
  odd.max[0] += 0.03;
  EXPECT_THROW(Cells<2>(odd, any), std::invalid_argument);
  auto long_bar = lattice<3>({4, 4, 4});
  long_bar.max[0] = 0.1 * (1 << 19);
  EXPECT_THROW(Cells<3>(long_bar, any), std::invalid_argument);
  EXPECT_THROW(make_particles(graded_cells<2>({8, 8}, 0.1, 0.5)), std::invalid_argument);
}

TEST(GradedRows, HaveSupportsOfTheirOwnSpacings) {
  const auto cells = graded_cells<2>({32, 24});
  const Model<2> model(make_particles(cells), row_options<2>());
  for (Index a = 0; a < model.set.size(); ++a) {
    fpm::RowGeometry<2> row;
    model.rows.geometry(a, row);
    EXPECT_GE(row.support_radius, support * cells.width(a) * (1.0 - 1e-15));
    for (Index b = 0; b < model.set.size(); ++b) {
      const double distance = (model.set.position.row(b) - model.set.position.row(a)).norm();
      if (b == a || std::abs(distance - row.support_radius) < 1e-9) continue;
      EXPECT_EQ(std::ranges::count(model.rows.neighbours(a), b), distance < row.support_radius);
    }
  }
}

// Rows of a half see what those of the whole do: no image is missing, near the finest neither.
TEST(GradedRows, OfAHalfAreThoseOfTheWhole) {
  const auto wanted = [](const auto& lower, const auto& upper) {
    const double beside = std::min(std::abs(lower[0] - 3.2), std::abs(upper[0] - 3.2));
    return std::clamp(0.2 * std::hypot(beside, lower[1]), 0.1, 0.4);
  };
  const Cells<2> all(lattice<2>({64, 64}), wanted);
  auto right = lattice<2>({32, 64});
  right.min[0] += 3.2;
  right.max[0] += 3.2;
  const Cells<2> half(right, wanted);
  for (const double enlargement : {1.0, 2.0}) {
    auto options = row_options<2>();
    options.support_radius *= enlargement;  // as if every row had been widened as far as it may
    const Model<2> whole(make_particles(all), options);
    auto reach = options;
    reach.support_radius /= enlargement;
    const ParticleSet<2> set = make_particles(half);
    const auto ghosts = fpm::make_ghosts(set, planes_of_symmetry<2>({{0, 3.2}}),
                                         enlargement > 1.0 ? reach : options);
    const Rows<2> rows(set, ghosts, options);
    EXPECT_LT(ghosts.size(), set.size());
    for (Index a = 0; a < set.size(); ++a) {
      const Index twin = all.containing(set.position.row(a).transpose());
      EXPECT_EQ(rows.neighbours(a).size(), whole.rows.neighbours(twin).size()) << a;
    }
  }
}

TEST(GradedPoints, HaveSupportsOfTheirCellsSpacings) {
  const auto cells = graded_cells<2>({32, 24}, 0.1, 0.2);
  const auto set = make_particles(cells);
  BoundaryPoints<2> points;
  for (const Face& face : fpm::all_faces<2>()) points.append(boundary_quadrature(cells, face));
  EXPECT_NEAR(points.weight.sum(), 2.0 * (3.2 + 2.4), 1e-13);
  std::vector<Index> own;
  for (Index c = 0; c < points.size(); ++c) {
    own.push_back(cells.containing(points.position.row(c).transpose()));
    EXPECT_NEAR(points.weight[c], 0.5 * cells.width(own.back()), 1e-14);
  }
  const fpm::PointOperator<2> op(set, {}, points.position, row_options<2>(), own);
  const fpm::PointOperator<2> nearest(set, {}, points.position, row_options<2>());
  const Field<2> field = affine<2>(set.position, some_tensor<2>(), {0.3, -0.2});
  const Field<2> expected = affine<2>(points.position, some_tensor<2>(), {0.3, -0.2});
  for (Index c = 0; c < points.size(); ++c) {
    EXPECT_GE(op.support_radius(c), support * cells.width(own[static_cast<std::size_t>(c)]));
    // Condition numbers are below 1e4, the options' bound.
    for (const auto* each : {&op, &nearest}) {
      EXPECT_LE((each->value(c, field) - expected.row(c).transpose()).norm(), 1e4 * epsilon * 10.0);
    }
  }
  EXPECT_THROW(fpm::PointOperator<2>(set, {}, points.position, row_options<2>(), {0}),
               fpm::ShapeError);
  own[0] = set.size();
  EXPECT_THROW(fpm::PointOperator<2>(set, {}, points.position, row_options<2>(), own),
               fpm::ShapeError);
}

TEST(GradedPoints, CoverAPartOfAFaceWhateverTheCells) {
  const auto cells = graded_cells<3>({12, 12, 8});
  const double infinity = std::numeric_limits<double>::infinity();
  const Vector<3> from(0.13, -infinity, 0.2), to(1.11, infinity, 0.77);
  const auto part = boundary_quadrature(cells, {1, true}, from, to);
  EXPECT_NEAR(part.weight.sum(), 0.98 * 0.57, 1e-14);
  EXPECT_NEAR(part.weight.dot(part.position.col(0)), 0.98 * 0.57 * 0.62, 1e-14);
  EXPECT_THROW(
      boundary_quadrature(cells, {1, true}, Vector<3>(2.0, 0.0, 0.0), Vector<3>(3.0, 0.0, 1.0)),
      std::invalid_argument);
}

}  // namespace

// Where boundary terms are integrated, and the area vectors of particle sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/boundary.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::BoundaryPoints;
using fpm::BoundaryQuadratureOptions;
using fpm::Face;
using fpm::PointOperator;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

TEST(BoundaryQuadrature, CoversARangeThatDoesNotFitTheSpacing) {
  // A patch of width 1/2 on a face with particles 1/9 apart.
  const auto points = boundary_quadrature(BoundaryQuadratureOptions<2>{.max = {1.0, 1.0},
                                                                       .spacing = 1.0 / 9.0,
                                                                       .face = {1, true},
                                                                       .range_min = {0.0, 0.0},
                                                                       .range_max = {0.5, 0.0}});
  EXPECT_NEAR(points.weight.sum(), 0.5, 10.0 * epsilon);
  EXPECT_NEAR(points.weight.dot(points.position.col(0)), 0.125, 10.0 * epsilon);
  EXPECT_EQ(points.size(), 9);  // 9 half spacings
  EXPECT_TRUE((points.position.col(1).array() == 1.0).all());
  EXPECT_EQ(points.normal, Field<2>(Eigen::RowVector2d(0.0, 1.0).replicate(9, 1)));

  // One that begins and ends within cells: the cuts take nothing away.
  const auto cut = boundary_quadrature(BoundaryQuadratureOptions<2>{.spacing = 1.0 / 9.0,
                                                                    .face = {0, false},
                                                                    .range_min = {0.0, 0.21},
                                                                    .range_max = {0.0, 0.83}});
  EXPECT_NEAR(cut.weight.sum(), 0.62, 10.0 * epsilon);
  EXPECT_NEAR(cut.weight.dot(cut.position.col(1)), 0.5 * (0.83 * 0.83 - 0.21 * 0.21),
              10.0 * epsilon);
  EXPECT_GT(cut.weight.minCoeff(), 0.0);
  EXPECT_EQ(cut.normal, Field<2>(Eigen::RowVector2d(-1.0, 0.0).replicate(cut.size(), 1)));
}

TEST(BoundaryQuadrature, LeavesNoSliverWhereRangeAndCellsMeet) {
  // 0.3 and 0.7 are lattice lines up to round-off.
  const auto points =
      boundary_quadrature(BoundaryQuadratureOptions<2>{.spacing = 0.1,
                                                       .face = {1, false},
                                                       .range_min = {0.1 + 0.2, 0.0},
                                                       .range_max = {1.0 - 0.3, 0.0},
                                                       .points_per_spacing = 1});
  EXPECT_EQ(points.size(), 4);
  EXPECT_NEAR(points.weight.minCoeff(), 0.1, 1e-9 * 0.1 + epsilon);
  EXPECT_NEAR(points.weight.sum(), 0.4, 10.0 * epsilon);
}

// Five thousand kilometres away, as map coordinates are, where they are known to a nanometre.
constexpr double far = 5e6;

TEST(BoundaryQuadrature, HasTheSamePiecesAndWeightsWhereverTheOriginIs) {
  const auto on_top = [](double origin) {
    const auto box = lattice<2>({9, 6}, 0.1, LatticeLayout::cell, 0.0, origin);
    return std::pair(box, boundary_quadrature(BoundaryQuadratureOptions<2>{
                              .min = box.min,
                              .max = box.max,
                              .spacing = box.spacing,
                              .face = {1, true},
                              .range_min = {origin + 0.3, 0.0},
                              .range_max = {origin + 0.7, 2.0 * far}}));
  };
  const auto values = [](const LatticeOptions<2>& box, const BoundaryPoints<2>& points) {
    const Model<2> m(box);
    const PointOperator<2> op(m.set, m.ghosts, points.position, row_options<2>());
    Field<2> result(points.size(), 2);
    op.values(random_field<2>(m.set.size(), 3), result);
    return result;
  };
  const auto [near_box, near] = on_top(0.0);
  const auto [far_box, away] = on_top(far);
  ASSERT_EQ(near.size(), 8);
  EXPECT_EQ(away.weight, near.weight);
  EXPECT_EQ(values(far_box, away), values(near_box, near));
}

TEST(BoundaryQuadrature, ClipsARangeToTheFace) {
  const auto points =
      boundary_quadrature(BoundaryQuadratureOptions<3>{.max = {1.0, 2.0, 3.0},
                                                       .spacing = 0.25,
                                                       .face = {2, true},
                                                       .range_min = {0.5, -4.0, 0.0},
                                                       .range_max = {9.0, 0.3, 0.0}});
  EXPECT_NEAR(points.weight.sum(), 0.5 * 0.3, 10.0 * epsilon);
  EXPECT_NEAR(points.weight.dot(points.position.col(0)), 0.75 * 0.15, 10.0 * epsilon);
  EXPECT_NEAR(points.weight.dot(points.position.col(1)), 0.15 * 0.15, 10.0 * epsilon);
  EXPECT_TRUE((points.position.col(2).array() == 3.0).all());
}

TEST(BoundaryQuadrature, MorePointsIntegrateCurvedTractionsBetter) {
  // Integral of x^2 over [0, 1]: the midpoint rule's error is h^2 / 12.
  for (const int per_spacing : {1, 2, 5}) {
    const auto points = boundary_quadrature(BoundaryQuadratureOptions<2>{
        .spacing = 0.25, .face = {1, true}, .points_per_spacing = per_spacing});
    const double integral = points.weight.dot(points.position.col(0).cwiseAbs2());
    const double h = 0.25 / per_spacing;
    EXPECT_NEAR(1.0 / 3.0 - integral, h * h / 12.0, 20.0 * epsilon);
  }
}

TEST(BoundaryQuadrature, SaysEverythingThatIsWrong) {
  const BoundaryQuadratureOptions<2> wrong{.max = {1.0, -1.0},
                                           .spacing = 0.0,
                                           .face = {2, true},
                                           .range_min = {3.0, 0.0},
                                           .points_per_spacing = 0};
  const auto messages = validate(wrong);
  EXPECT_EQ(messages.size(), 5U);
  for (const char* why :
       {"axis 2 in a space of dimension 2", "spacing must be positive", "at least 1, not 0",
        "the range misses the face along axis 0", "the box is empty along axis 1"}) {
    EXPECT_THAT(messages, Contains(HasSubstr(why)));
    EXPECT_THAT([&] { boundary_quadrature(wrong); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(why)));
  }
  EXPECT_THAT(validate(BoundaryQuadratureOptions<3>{}), IsEmpty());
}

// sum s = 0 and sum s x X = |Omega| I.
template <int Dim>
void expect_closed_surface(const Field<Dim>& area, const Field<Dim>& position,
                           const Vector<Dim>& extent, double tolerance) {
  EXPECT_LE(area.colwise().sum().cwiseAbs().maxCoeff(), tolerance * area.cwiseAbs().sum());
  const Tensor<Dim> volume = area.transpose() * position;
  EXPECT_LE((volume - extent.prod() * Tensor<Dim>::Identity()).cwiseAbs().maxCoeff(),
            tolerance * area.cwiseAbs().sum() * position.cwiseAbs().maxCoeff());
}

template <int Dim>
void expect_closed_tributary_surface(const Counts<Dim>& cells) {
  const auto box = lattice<Dim>(cells, 0.1, LatticeLayout::vertex, 0.0, 2.0);
  const auto set = fpm::make_lattice(box);
  expect_closed_surface<Dim>(fpm::tributary_area_vectors(box), set.position, box.max - box.min,
                             static_cast<double>(set.size()) * epsilon);
}

TEST(AreaVectors, OfAVertexLatticeCloseItsSurface) {
  expect_closed_tributary_surface<2>({7, 4});
  expect_closed_tributary_surface<3>({4, 3, 5});
}

template <int Dim>
void expect_closed_quadrature_surface(LatticeLayout layout, double jitter) {
  const auto box = lattice<Dim>(Counts<Dim>::Constant(Dim == 2 ? 10 : 5), 0.1, layout, jitter);
  const Model<Dim> m(box);
  const auto points = boundary_quadrature(
      BoundaryQuadratureOptions<Dim>{.min = box.min, .max = box.max, .spacing = box.spacing},
      fpm::all_faces<Dim>());
  auto options = row_options<Dim>();
  options.max_condition = 500.0;  // of N at every point: its round-off is 4 cond epsilon
  const PointOperator<Dim> op(m.set, m.ghosts, points.position, options);
  const double tolerance = (4.0 * options.max_condition + 90.0) * epsilon;
  expect_closed_surface<Dim>(area_vectors(op, points), m.set.position, box.max - box.min,
                             tolerance);
}

TEST(AreaVectors, OfAnySetCloseItsSurface) {
  for (const double jitter : {0.0, 0.2}) {
    expect_closed_quadrature_surface<2>(LatticeLayout::cell, jitter);
    expect_closed_quadrature_surface<2>(LatticeLayout::vertex, jitter);
    expect_closed_quadrature_surface<3>(LatticeLayout::cell, jitter);
    expect_closed_quadrature_surface<3>(LatticeLayout::vertex, jitter);
  }
}

TEST(AreaVectors, LieOnTheBoundaryOfAVertexLattice) {
  const auto area = fpm::tributary_area_vectors(lattice<2>({3, 2}, 2.0, LatticeLayout::vertex));
  Field<2> expected(12, 2);
  expected << -1, -1, 0, -2, 0, -2, 1, -1,  // lower face
      -2, 0, 0, 0, 0, 0, 2, 0,              //
      -1, 1, 0, 2, 0, 2, 1, 1;              // upper face
  EXPECT_EQ(area, expected);
}

TEST(AreaVectors, LeaveOutAPlaneOfSymmetry) {
  const auto box = lattice<2>({3, 2}, 2.0, LatticeLayout::vertex);
  const auto area = fpm::tributary_area_vectors(box, {{0, true}, {1, false}, {1, true}});
  EXPECT_EQ(area(4, 0), 0.0);
  EXPECT_EQ(area(0, 0), 0.0);
  EXPECT_EQ(area(0, 1), -1.0);
  EXPECT_EQ(area(7, 0), 2.0);
}

TEST(TributaryPoints, AreTheFacesParticlesWithTheirShares) {
  const auto box = lattice<2>({4, 3}, 0.5, LatticeLayout::vertex);
  const auto whole = fpm::tributary_points(box, Face{1, true});
  EXPECT_EQ(whole.particle, (std::vector<Index>{15, 16, 17, 18, 19}));
  Eigen::VectorXd shares(5);
  shares << 0.25, 0.5, 0.5, 0.5, 0.25;
  EXPECT_EQ(whole.points.weight, shares);
  EXPECT_EQ(whole.points.position, fpm::make_lattice(box).position.bottomRows(5));

  // A range that ends within a share cuts it.
  const auto part = fpm::tributary_points<2>(box, Face{1, true}, {0.0, 0.0}, {0.85, 0.0});
  EXPECT_EQ(part.particle, (std::vector<Index>{15, 16, 17}));
  EXPECT_NEAR(part.points.weight.sum(), 0.85, 4.0 * epsilon);
  EXPECT_NEAR(part.points.weight[2], 0.1, 4.0 * epsilon);
}

TEST(TributaryPoints, HaveTheSameSharesWhereverTheOriginIs) {
  const auto shares = [](double origin) {
    const auto box = lattice<3>({4, 3, 5}, 0.1, LatticeLayout::vertex, 0.0, origin);
    return fpm::tributary_points<3>(box, Face{0, true}, {0.0, origin + 0.1, origin},
                                    {0.0, origin + 0.3, origin + 0.25});
  };
  EXPECT_EQ(shares(far).particle, shares(0.0).particle);
  EXPECT_EQ(shares(far).points.weight, shares(0.0).points.weight);
}

TEST(TributaryPoints, CoverAFaceInSpace) {
  const auto box = lattice<3>({3, 4, 2}, 0.25, LatticeLayout::vertex);
  const auto points = fpm::tributary_points(box, Face{0, false});
  EXPECT_EQ(points.particle.size(), 15U);
  EXPECT_DOUBLE_EQ(points.points.weight.sum(), 1.0 * 0.5);
  EXPECT_DOUBLE_EQ(points.points.weight.minCoeff(), 0.125 * 0.125);
}

TEST(TributaryPoints, RefuseOtherSetsAndRanges) {
  const auto refused = [](const char* why) {
    return ThrowsMessage<std::invalid_argument>(HasSubstr(why));
  };
  const auto cells = lattice<2>({4, 3}, 0.5);
  const auto jittered = lattice<2>({4, 3}, 0.5, LatticeLayout::vertex, 0.1);
  const auto box = lattice<2>({4, 3}, 0.5, LatticeLayout::vertex);
  EXPECT_THAT([&] { fpm::tributary_points(cells, Face{}); }, refused("vertex lattices"));
  EXPECT_THAT([&] { fpm::tributary_area_vectors(jittered); }, refused("without jitter"));
  EXPECT_THAT([&] { fpm::tributary_points(box, Face{2, true}); }, refused("axis 2"));
  EXPECT_THAT(
      [&] {
        fpm::tributary_points<2>(box, Face{1, true}, {5.0, 0.0}, {6.0, 0.0});
      },
      refused("misses the face"));
}

}  // namespace

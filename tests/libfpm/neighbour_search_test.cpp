#include <gtest/gtest.h>
#include <fpm/neighbour_search.hpp>

#include <cmath>

#include "sets.hpp"

namespace {

using namespace fpm_test;

template <int Dim>
std::vector<Index> brute_force(const Field<Dim>& points, const Vector<Dim>& centre, double radius) {
  std::vector<Index> found;
  for (Index b = 0; b < points.rows(); ++b) {
    if ((points.row(b).transpose() - centre).squaredNorm() < radius * radius) found.push_back(b);
  }
  return found;
}

template <int Dim>
void expect_brute_force_answers(const Field<Dim>& points, double radius) {
  const fpm::NeighbourSearch<Dim> search(points);
  std::vector<Index> found{-1};
  std::size_t most = 0;
  for (Index a = 0; a < points.rows(); ++a) {
    const Vector<Dim> centre = points.row(a).transpose();
    search.within(centre, radius, found);
    ASSERT_EQ(found, brute_force<Dim>(points, centre, radius)) << "centre " << a;
    most = std::max(most, found.size());
  }
  EXPECT_GT(most, 1U);
}

TEST(NeighbourSearch, FindsWhatBruteForceFindsAmongRandomPoints) {
  expect_brute_force_answers<2>(random_field<2>(500, 1), 0.17);
  expect_brute_force_answers<3>(random_field<3>(500, 2), 0.31);
}

TEST(NeighbourSearch, FindsWhatBruteForceFindsOnLattices) {
  expect_brute_force_answers<2>(fpm::make_lattice(lattice<2>({20, 15})).position, 0.24);
  expect_brute_force_answers<3>(fpm::make_lattice(lattice<3>({7, 6, 5})).position, 0.24);
}

TEST(NeighbourSearch, IsExactFarFromTheOrigin) {
  // A float holds 1e6 to 0.06 only; the coordinates' own round-off is 1e-10.
  expect_brute_force_answers<2>((random_field<2>(300, 3).array() + 1e6).matrix(), 0.2);
  expect_brute_force_answers<3>((random_field<3>(300, 4).array() - 1e6).matrix(), 0.4);
}

TEST(NeighbourSearch, TellsPointsOnTheRadiusFromThoseInside) {
  // Powers of two, so that distances are exact: the four lattice neighbours lie on the radius.
  const auto points = fpm::make_lattice(lattice<2>({9, 9}, 0.25)).position;
  const fpm::NeighbourSearch<2> search(points);
  const Vector<2> centre = points.row(40).transpose();
  std::vector<Index> found;
  search.within(centre, 0.25, found);
  EXPECT_EQ(found, (std::vector<Index>{40}));
  search.within(centre, std::nextafter(0.25, 1.0), found);
  EXPECT_EQ(found, (std::vector<Index>{31, 39, 40, 41, 49}));
}

TEST(NeighbourSearch, AnswersAwayFromThePointsAndFindsCoincidentOnes) {
  Field<2> points(3, 2);
  points << 0.0, 0.0, 0.0, 0.0, 1.0, 0.0;
  const fpm::NeighbourSearch<2> search(points);
  std::vector<Index> found;
  search.within({0.0, 0.0}, 0.5, found);
  EXPECT_EQ(found, (std::vector<Index>{0, 1}));
  search.within({1e3, 1e3}, 0.5, found);
  EXPECT_TRUE(found.empty());
}

TEST(NeighbourSearch, CopiesItsPoints) {
  auto points = std::make_unique<Field<2>>(random_field<2>(50, 5));
  const Field<2> kept = *points;
  const fpm::NeighbourSearch<2> search(*points);
  points->setZero();
  points.reset();
  std::vector<Index> found;
  const Vector<2> centre = kept.row(7).transpose();
  search.within(centre, 0.5, found);
  EXPECT_EQ(found, brute_force<2>(kept, centre, 0.5));
}

}  // namespace

// The smooth field behind one that alternates.
#include <gtest/gtest.h>
#include <fpm/recovery.hpp>

#include <cmath>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::recover;

constexpr double spacing = 0.1;
constexpr fpm::RecoveryOptions usual{.radius = 4.8 * spacing};

template <int Dim>
Eigen::VectorXd linear_field(const Field<Dim>& x, const Vector<Dim>& slope, double level = 1.0) {
  return (x * slope).array() + level;
}

template <int Dim>
double largest_error(const ParticleSet<Dim>& set, const Eigen::VectorXd& field,
                     const std::vector<fpm::GhostPlane<Dim>>& planes = {}) {
  return (recover<Dim>(set, field, planes, usual) - field).cwiseAbs().maxCoeff();
}

// A weighted fit of differences no larger than the range of the field over a neighbourhood: some
// sums of at most 4000 products of relative size 1, divided by spreads of some 1 / 20 of radius^2.
constexpr double exact = 1e-11;

template <int Dim>
void expect_linear_exactness(const Counts<Dim>& cells, const Vector<Dim>& slope) {
  for (const LatticeLayout layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    for (const double jitter : {0.0, 0.2, 0.4}) {
      const auto set = fpm::make_lattice(lattice<Dim>(cells, spacing, layout, jitter));
      EXPECT_LT(largest_error(set, linear_field<Dim>(set.position, slope)), exact)
          << "jitter " << jitter;
    }
  }
}

TEST(Recovery, KeepsLinearFieldsUpToTheFaces) {
  expect_linear_exactness<2>({14, 11}, {1.0, -2.0});
  expect_linear_exactness<3>({8, 7, 6}, {1.0, -2.0, 0.5});
}

TEST(Recovery, KeepsAConstantToTheLastBit) {
  const auto set = fpm::make_lattice(lattice<2>({9, 9}, spacing, LatticeLayout::cell, 0.3));
  EXPECT_EQ(largest_error<2>(set, Eigen::VectorXd::Constant(set.size(), 0.1)), 0.0);
}

// A field that alternates has no gradient on a lattice: by columns, by rows, by both. What a fit
// leaves of it inside is the kernel's own transform at that wave number, below a per cent from a
// radius of 3.2 spacings on. At a face the fit leans on the rows next to it: of what alternates
// along the face as little is left, of what alternates from row to row behind it somewhat
// more than a half.
TEST(Recovery, LeavesNextToNothingOfWhatAlternates) {
  constexpr double left = 0.01;
  const Index across = 24, middle = across / 2;
  const auto set = fpm::make_lattice(lattice<2>({across, across}, spacing));
  for (const auto& [along_x, along_y] : {std::pair{1, 0}, std::pair{0, 1}, std::pair{1, 1}}) {
    Eigen::VectorXd field(set.size());
    for (Index a = 0; a < set.size(); ++a) {
      const int odd = along_x * (a % across) + along_y * (a / across);
      field[a] = odd % 2 == 0 ? 1.0 : -1.0;
    }
    const Eigen::VectorXd recovered = recover<2>(set, field, {}, usual);
    EXPECT_LT(std::abs(recovered[middle * across + middle]), left);
    EXPECT_LT(recovered.cwiseAbs().maxCoeff(), 0.6);
    EXPECT_LT(along_x * std::abs(recovered[middle]), left);
    EXPECT_LT(along_y * std::abs(recovered[middle * across]), left);
  }
}

TEST(Recovery, OfAHalfIsThatOfTheWholeBody) {
  const auto whole = fpm::make_lattice(lattice<2>({24, 9}, spacing));
  const auto half = fpm::make_lattice(lattice<2>({12, 9}, spacing));
  const Eigen::VectorXd field = random_vector(half.size(), 3);
  Eigen::VectorXd both(whole.size());
  for (Index row = 0; row < 9; ++row) {
    for (Index k = 0; k < 12; ++k) {
      both[row * 24 + k] = field[row * 12 + 11 - k];
      both[row * 24 + 12 + k] = field[row * 12 + k];
    }
  }
  // The half begins at its mirror, x = 0; the whole one has it at 12 spacings.
  const Eigen::VectorXd of_half = recover<2>(half, field, {symmetry_plane<2>(0, 0.0)}, usual);
  const Eigen::VectorXd of_whole = recover<2>(whole, both, {}, usual);
  for (Index row = 0; row < 9; ++row) {
    for (Index k = 0; k < 12; ++k) {
      EXPECT_NEAR(of_half[row * 12 + k], of_whole[row * 24 + 12 + k], exact);
    }
  }
}

// The images of a support are none of the body.
TEST(Recovery, DoesNotMirrorAtAHeldPlane) {
  const auto set = fpm::make_lattice(lattice<2>({12, 12}, spacing));
  fpm::GhostPlane<2> held;
  held.axis = 1;
  held.held = {true, true};
  EXPECT_LT(largest_error<2>(set, linear_field<2>(set.position, {1.0, -2.0}), {held}), exact);
}

TEST(Recovery, KeepsAJumpBetweenBodies) {
  auto set = fpm::make_lattice(lattice<2>({16, 16}, spacing));
  Eigen::VectorXd field(set.size());
  for (Index a = 0; a < set.size(); ++a) {
    set.body.push_back(set.position(a, 1) > 0.8 ? 1 : 0);
    field[a] = set.body.back() == 1 ? 100.0 - set.position(a, 0) : set.position(a, 1);
  }
  EXPECT_LT(largest_error<2>(set, field), 100.0 * exact);
  set.body.clear();
  EXPECT_GT(largest_error<2>(set, field), 1.0);
}

// A seam of one row: nothing is known across it.
TEST(Recovery, IsConstantAcrossASeamOfOneRow) {
  const auto set = fpm::make_lattice(lattice<2>({20, 1}, spacing));
  EXPECT_LT(largest_error<2>(set, linear_field<2>(set.position, {3.0, 0.0})), exact);
  const auto one = fpm::make_lattice(lattice<2>({1, 1}, spacing));
  EXPECT_EQ(largest_error<2>(one, Eigen::VectorXd::Ones(1)), 0.0);
}

TEST(Recovery, RefusesWhatDoesNotFit) {
  const auto set = fpm::make_lattice(lattice<2>({6, 6}, spacing));
  const Eigen::VectorXd field = Eigen::VectorXd::Ones(set.size());
  EXPECT_THROW(recover<2>(set, field.head(5), {}, usual), fpm::ShapeError);
  auto parted = set;
  parted.body.resize(3);
  EXPECT_THROW(recover<2>(parted, field, {}, usual), fpm::ShapeError);
  EXPECT_THROW(recover<2>(set, field, {}, {}), std::invalid_argument);
}

}  // namespace

// A half model with images against the symmetric full one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/ghosts.hpp>

#include <map>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::Channels;
using fpm::MomentOperator;
using testing::HasSubstr;
using testing::ThrowsMessage;

// The part of a full lattice on the positive side of the planes x_i = 0, i < Planes, and where each
// full particle's counterpart is.
template <int Dim>
struct Halves {
  Model<Dim> full;
  Model<Dim> half;
  std::vector<Index> counterpart;  // per full particle: its half particle
  Field<Dim> sign;                 // per full particle: of each component
  std::vector<Index> origin;       // per half particle: the full particle it is

  Halves(const Counts<Dim>& half_cells, int planes)
      : full(lattice_around(half_cells, planes, true), true),
        half(lattice_around(half_cells, planes, false), true, symmetry(planes)) {
    // A lattice position, in half spacings, identifies a particle.
    std::map<std::vector<long>, Index> place;
    for (Index a = 0; a < half.rows.size(); ++a) place[key(half.set.position.row(a))] = a;
    origin.resize(static_cast<std::size_t>(half.rows.size()));
    sign.setOnes(full.rows.size(), Dim);
    for (Index a = 0; a < full.rows.size(); ++a) {
      Eigen::Matrix<double, 1, Dim> x = full.set.position.row(a);
      for (int i = 0; i < planes; ++i) {
        if (x[i] < 0.0) sign(a, i) = -1.0;
        x[i] = std::abs(x[i]);
      }
      const Index b = place.at(key(x));
      counterpart.push_back(b);
      if ((sign.row(a).array() > 0.0).all()) origin[static_cast<std::size_t>(b)] = a;
    }
  }

  /// The symmetric field on the full set.
  Field<Dim> unfolded(const Field<Dim>& field) const {
    return field(counterpart, Eigen::all).cwiseProduct(sign);
  }

 private:
  static std::vector<long> key(const Eigen::Matrix<double, 1, Dim>& x) {
    std::vector<long> k;
    for (const double value : x) k.push_back(std::lround(value / 0.05));
    return k;
  }
  static LatticeOptions<Dim> lattice_around(const Counts<Dim>& cells, int planes, bool whole) {
    auto options = lattice<Dim>(cells);
    for (int i = 0; i < planes && whole; ++i) options.min[i] = -options.max[i];
    return options;
  }
  static std::vector<SymmetryPlane> symmetry(int planes) {
    std::vector<SymmetryPlane> result;
    for (int i = 0; i < planes; ++i) result.push_back({i, 0.0});
    return result;
  }
};

// How each stress entry changes sign under the reflection `s`, and v and x with it.
template <int Dim>
Eigen::VectorXd stress_signs(const Eigen::Matrix<double, 1, Dim>& s, Channels channels) {
  std::vector<double> signs;
  const auto tensor = [&] {
    for (int j = 0; j < Dim; ++j) {
      for (int i = 0; i < Dim; ++i) signs.push_back(s[i] * s[j]);
    }
  };
  tensor();
  if (channels.pair) {
    signs.push_back(1.0);
    for (int i = 0; i < Dim; ++i) signs.push_back(s[i]);
    tensor();
    tensor();
  }
  if (channels.second) {
    for (int k = 0; k < Dim; ++k) {
      for (int l = k; l < Dim; ++l) {
        for (int i = 0; i < Dim; ++i) signs.push_back(s[i] * s[k] * s[l]);
      }
    }
  }
  return Eigen::Map<Eigen::VectorXd>(signs.data(), static_cast<Eigen::Index>(signs.size()));
}

template <int Dim>
void expect_half_is_full(const Counts<Dim>& half_cells, int planes) {
  const Halves<Dim> h(half_cells, planes);
  const Channels all{true, true};
  const MomentOperator<Dim> full(h.full.rows, h.full.ghosts, all);
  const MomentOperator<Dim> half(h.half.rows, h.half.ghosts, all);
  const Field<Dim> u = random_field<Dim>(half.size(), 61);
  const Field<Dim> x = random_field<Dim>(half.size(), 62);

  // Neighbours come in another order, so the moment matrices differ in round-off; the worst
  // condition number is that of A in the corners, below 1e3.
  constexpr double condition = 1e3;
  constexpr double widest = 90.0;
  const double tolerance = (4.0 * condition + widest) * epsilon;
  const Eigen::MatrixXd of_half = gathered(half, u);
  const Eigen::MatrixXd of_full = gathered(full, h.unfolded(u))(h.origin, Eigen::all);
  for (Eigen::Index c = 0; c < of_half.cols(); ++c) {
    EXPECT_LE((of_half.col(c) - of_full.col(c)).cwiseAbs().maxCoeff(),
              tolerance * of_full.col(c).cwiseAbs().maxCoeff())
        << "moment " << c;
  }

  const Eigen::MatrixXd stress = random_vector(half.size() * half.stress_count(), 63)
                                     .reshaped(half.size(), half.stress_count());
  Eigen::MatrixXd symmetric = stress(h.counterpart, Eigen::all);
  for (Index a = 0; a < full.size(); ++a) {
    symmetric.row(a).array() *= stress_signs<Dim>(h.sign.row(a), all).transpose().array();
  }
  const Field<Dim> half_force = scattered(half, stress, u, x);
  const Field<Dim> full_force = scattered(full, symmetric, h.unfolded(u), h.unfolded(x));
  EXPECT_LE((half_force - full_force(h.origin, Eigen::all)).cwiseAbs().maxCoeff(),
            tolerance * full_force.cwiseAbs().maxCoeff());
  EXPECT_LE((full_force - h.unfolded(half_force)).cwiseAbs().maxCoeff(),
            tolerance * full_force.cwiseAbs().maxCoeff());
}

TEST(Ghosts, MakeTheHalfModelTheFullOne) {
  expect_half_is_full<2>({9, 12}, 1);
  expect_half_is_full<3>({5, 5, 4}, 1);
}

TEST(Ghosts, MakeTheQuarterModelTheFullOne) {
  expect_half_is_full<2>({9, 8}, 2);
  expect_half_is_full<3>({5, 5, 4}, 2);
}

TEST(Ghosts, MakeTheEighthModelTheFullOne) {
  expect_half_is_full<3>({5, 5, 5}, 3);
}

TEST(Ghosts, LieBehindThePlaneAtTheSameDistance) {
  const auto set = fpm::make_lattice(lattice<2>({6, 4}));
  const Ghosts<2> ghosts(set.position, {symmetry_plane<2>(0, 0.6)}, 0.24);
  ASSERT_EQ(ghosts.size(), 8);  // two columns of four
  Field<2> extended(24 + 8, 2);
  extended.topRows(24) = set.position;
  ghosts.extend_positions(extended.data(), 24, 32);
  for (Index g = 0; g < 8; ++g) {
    const auto source = set.position.row(ghosts.source(g));
    EXPECT_NEAR(extended(24 + g, 0), 1.2 - source[0], 4.0 * epsilon);
    EXPECT_EQ(extended(24 + g, 1), source[1]);
    EXPECT_EQ(ghosts.sign(g, 0), -1.0);
    EXPECT_EQ(ghosts.sign(g, 1), 1.0);
  }
}

TEST(Ghosts, FoldingForcesIsTheTransposeOfExtendingVectors) {
  const auto set = fpm::make_lattice(lattice<3>({4, 4, 4}));
  const Ghosts<3> ghosts(
      set.position,
      {symmetry_plane<3>(0, 0.0), symmetry_plane<3>(1, 0.0), symmetry_plane<3>(2, 0.4)}, 0.24);
  const Index n = set.size();
  const Index total = n + ghosts.size();
  ASSERT_GT(ghosts.size(), 100);
  Field<3> u = Field<3>::Zero(total, 3);
  u.topRows(n) = random_field<3>(n, 71);
  ghosts.extend_vectors(u.data(), n, total);
  const Field<3> f = random_field<3>(total, 72);
  Field<3> folded = f;
  ghosts.fold_forces(folded.data(), n, total);
  const double of_extended = f.cwiseProduct(u).sum();
  const double of_folded = folded.topRows(n).cwiseProduct(u.topRows(n)).sum();
  EXPECT_NEAR(of_extended, of_folded, round_off(8.0, f.cwiseProduct(u).cwiseAbs().sum()));
}

TEST(Ghosts, LeaveOutParticlesOnThePlaneAndOutOfReach) {
  Field<2> position(3, 2);
  position << 0.0, 0.0, 0.1, 0.0, 0.5, 0.0;
  const Ghosts<2> ghosts(position, {symmetry_plane<2>(0, 0.0)}, 0.3);
  ASSERT_EQ(ghosts.size(), 1);
  EXPECT_EQ(ghosts.source(0), 1);
}

TEST(Ghosts, RefuseAnAxisThatDoesNotExist) {
  const auto set = fpm::make_lattice(lattice<2>({4, 4}));
  for (const int axis : {-1, 2}) {
    EXPECT_THAT([&] { Ghosts<2>(set.position, {symmetry_plane<2>(axis, 0.0)}, 0.24); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("in a space of dimension 2")));
  }
}

}  // namespace

// A half model with images against the symmetric full one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/ghosts.hpp>
#include <fpm/points.hpp>

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

// A box held on its lower face along y, held in all directions, and at its left one by symmetry.
template <int Dim>
std::vector<GhostPlane<Dim>> base_and_mirror(double low) {
  GhostPlane<Dim> base;
  base.axis = 1;
  base.position = low;
  base.held.fill(true);
  return {base, symmetry_plane<Dim>(0, 0.0)};
}

template <int Dim>
void expect_a_held_plane_moves_as_given(double jitter) {
  auto options = lattice<Dim>(Dim == 2 ? Counts<Dim>::Constant(8) : Counts<Dim>::Constant(5));
  options.jitter = jitter;
  const auto set = fpm::make_lattice(options);
  const auto rows_options = row_options<Dim>(options.spacing, false);
  const Ghosts<Dim> ghosts(set.position, base_and_mirror<Dim>(0.0),
                           2.0 * rows_options.support_radius);
  const Rows<Dim> rows(set, ghosts, rows_options);
  const MomentOperator<Dim> op(rows, ghosts, Channels{});
  // u = v at y = 0, and the same strain on either side; symmetric at x = 0.
  fpm::Vector<Dim> v = fpm::Vector<Dim>::Constant(0.01);
  v[0] = 0.0;
  Field<Dim> u(set.size(), Dim);
  for (Index a = 0; a < set.size(); ++a) {
    u.row(a) = v.transpose() * (1.0 + set.position(a, 1));
  }
  Eigen::VectorXd extended(op.stride() * Dim);
  op.extend(u.data(), extended.data());
  const Field<Dim> motion = ghosts.of_motion({v, fpm::Vector<Dim>::Zero()});
  for (int i = 0; i < Dim; ++i) {
    extended.segment(i * op.stride() + set.size(), ghosts.size()) += motion.col(i);
  }
  Eigen::VectorXd moments(op.channel_count() * Dim * MomentOperator<Dim>::block_stride);
  fpm::Tensor<Dim> gradient = fpm::Tensor<Dim>::Zero();
  gradient.col(1) = v;
  for (Index block = 0; block < op.block_count(); ++block) {
    op.gather(block, extended.data(), moments.data());
    for (Index r = 0; r < op.block_size(block); ++r) {
      for (int k = 0; k < Dim * Dim; ++k) {
        EXPECT_NEAR(moments[k * MomentOperator<Dim>::block_stride + r], gradient.data()[k],
                    round_off(100.0, 1.0));
      }
    }
  }
}

TEST(HeldPlane, MovesAsGivenUnderAnyStrain) {
  for (const double jitter : {0.0, 0.3}) {
    expect_a_held_plane_moves_as_given<2>(jitter);
    expect_a_held_plane_moves_as_given<3>(jitter);
  }
}

TEST(HeldPlane, IsHeldByTheForcesThatWorkOnItsMotion) {
  const auto set = fpm::make_lattice(lattice<2>({6, 6}));
  const Index n = set.size();
  const Ghosts<2> ghosts(set.position, base_and_mirror<2>(0.0), 0.48);
  const Index total = n + ghosts.size();
  const Field<2> force = random_field<2>(total, 73);
  const std::vector<fpm::Vector<2>> motion{{0.3, -0.7}, {0.2, 0.0}};
  std::vector<fpm::Vector<2>> on_planes;
  ghosts.plane_forces(force.data(), n, total, on_planes);
  double of_planes = 0.0;
  Field<2> by_particle = Field<2>::Zero(n, 2);
  for (std::size_t p = 0; p < motion.size(); ++p) {
    of_planes += motion[p].dot(on_planes[p]);
    ghosts.add_reactions(p, force.data(), n, total, by_particle);
  }
  const double of_ghosts =
      force.bottomRows(ghosts.size()).cwiseProduct(ghosts.of_motion(motion)).sum();
  const double size = force.cwiseAbs().sum();
  EXPECT_NEAR(of_planes, of_ghosts, round_off(8.0, size));
  const fpm::Vector<2> sum = on_planes[0] + on_planes[1];
  EXPECT_NEAR((by_particle.colwise().sum().transpose() - sum).norm(), 0.0, round_off(8.0, size));
  // A body and its planes shifted as one: the forces on particles and planes sum up to those on
  // all.
  Field<2> folded = force;
  ghosts.fold_forces(folded.data(), n, total);
  const double shifted = folded.topRows(n).col(1).sum() + on_planes[0][1];
  EXPECT_NEAR(shifted, force.col(1).sum(), round_off(8.0, size));
  EXPECT_THROW((void)ghosts.of_motion({motion[0]}), fpm::ShapeError);
}

// A plate on the left half of the top: y = 0.6, x <= 0.3.
GhostPlane<2> plate() {
  GhostPlane<2> plane;
  plane.axis = 1;
  plane.position = 0.6;
  plane.held = {true, true};
  plane.range_max[0] = 0.3;
  return plane;
}

TEST(Plate, HasImagesOverItsRangeAloneForRowsUnderIt) {
  const auto set = fpm::make_lattice(lattice<2>({6, 6}));
  const auto options = row_options<2>(0.1, false);
  const Ghosts<2> ghosts(set.position, {plate()}, options.support_radius);
  ASSERT_EQ(ghosts.size(), 6);  // three columns, two rows within 0.24 (0.05 and 0.15)
  for (Index g = 0; g < ghosts.size(); ++g) {
    EXPECT_LT(set.position(ghosts.source(g), 0), 0.3);
    EXPECT_FALSE(ghosts.by_symmetry(g));
    EXPECT_TRUE(ghosts.visible_from({0.25, 0.55}, g));
    EXPECT_FALSE(ghosts.visible_from({0.35, 0.55}, g));
    EXPECT_TRUE(ghosts.visible_from({0.35, 0.55}, g, {{0.1, 0.0}}));
  }
  const Rows<2> rows(set, ghosts, options);
  for (Index a = 0; a < set.size(); ++a) {
    for (const Index b : rows.neighbours(a)) {
      if (b < set.size()) continue;
      EXPECT_LT(set.position(a, 0), 0.3);
    }
  }
}

TEST(Plate, LosesTheImagesOfParticlesThatLeaveIt) {
  const auto set = fpm::make_lattice(lattice<2>({6, 6}));
  const Ghosts<2> ghosts(set.position, {plate()}, 0.24);
  const std::vector<fpm::Vector<2>> down{{0.0, -0.04}};
  EXPECT_TRUE(ghosts.stands_for({0.25, 0.55}, 0, down));
  EXPECT_FALSE(ghosts.stands_for({0.31, 0.5}, 0, down));   // beside it
  EXPECT_FALSE(ghosts.stands_for({0.25, 0.57}, 0, down));  // past it
}

TEST(Plate, IsNotInterpolatedAtPoints) {
  const auto set = fpm::make_lattice(lattice<2>({6, 6}));
  const auto options = row_options<2>(0.1, false);
  const Ghosts<2> ghosts(set.position, {plate()}, 2.0 * options.support_radius);
  Field<2> at(1, 2);
  at << 0.2, 0.6;
  const fpm::PointOperator<2> with(set, ghosts, at, options);
  const fpm::PointOperator<2> without(set, {}, at, options);
  const Field<2> u = random_field<2>(set.size(), 74);
  EXPECT_EQ(with.value(0, u), without.value(0, u));
}

// What flows out from under a plate: its rows are rebuilt without the images it had.
TEST(Plate, ServesNoRowThatHasLeftIt) {
  const auto set = fpm::make_lattice(lattice<2>({8, 6}));
  const auto options = row_options<2>(0.1, false);
  const Ghosts<2> ghosts(set.position, {plate()}, 2.0 * options.support_radius);
  Rows<2> rows(set, ghosts, options);
  Field<2> now = set.position;
  std::vector<Index> all;
  for (Index a = 0; a < set.size(); ++a) {
    all.push_back(a);
    now(a, 0) += 0.2;
  }
  const std::vector<char> none(static_cast<std::size_t>(set.size()), 0);
  const auto rebuilt = rows.research(all, now, set.volume, none, {fpm::Vector<2>::Zero()});
  ASSERT_EQ(rebuilt.size(), all.size());
  for (Index a = 0; a < set.size(); ++a) {
    for (const Index b : rows.neighbours(a)) {
      if (b < set.size()) continue;
      EXPECT_LT(now(a, 0), 0.3);
      EXPECT_LT(now(ghosts.source(b - set.size()), 0), 0.3);
    }
  }
}

}  // namespace

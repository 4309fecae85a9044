#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/particles.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using testing::HasSubstr;
using testing::ThrowsMessage;

template <int Dim>
void expect_exact_integrals(const LatticeOptions<Dim>& options) {
  const auto set = fpm::make_lattice(options);
  const Vector<Dim> extent = options.max - options.min;
  const double n = static_cast<double>(set.size());
  EXPECT_NEAR(set.volume.sum(), extent.prod(), round_off(n, set.volume.maxCoeff()));
  if (options.jitter > 0.0) return;
  const Vector<Dim> first = set.position.transpose() * set.volume;
  const Vector<Dim> centre = 0.5 * (options.min + options.max);
  for (int i = 0; i < Dim; ++i) {
    EXPECT_NEAR(first[i], extent.prod() * centre[i], round_off(n, set.volume.maxCoeff()));
  }
}

TEST(Lattice, VolumesSumToTheBoxAndTheirCentreIsItsCentre) {
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    expect_exact_integrals(lattice<2>({7, 4}, 0.1, layout));
    expect_exact_integrals(lattice<3>({4, 3, 2}, 0.1, layout));
    expect_exact_integrals(lattice<2>({7, 4}, 0.1, layout, 0.2));
  }
}

TEST(Lattice, RunsAlongTheFirstAxisFirst) {
  const auto set = fpm::make_lattice(lattice<2>({3, 2}, 1.0));
  Field<2> expected(6, 2);
  expected << 0.5, 0.5, 1.5, 0.5, 2.5, 0.5, 0.5, 1.5, 1.5, 1.5, 2.5, 1.5;
  EXPECT_EQ(set.position, expected);
}

TEST(Lattice, VertexVolumesAreHalvedPerFace) {
  const auto set = fpm::make_lattice(lattice<2>({2, 2}, 2.0, LatticeLayout::vertex));
  Eigen::VectorXd expected(9);
  expected << 1, 2, 1, 2, 4, 2, 1, 2, 1;
  EXPECT_EQ(set.volume, expected);
}

TEST(Lattice, JitterStaysWithinItsRangeAndMovesEveryInnerParticle) {
  const double spacing = 0.1;
  const auto regular = fpm::make_lattice(lattice<3>({5, 4, 6}, spacing));
  const auto moved = fpm::make_lattice(lattice<3>({5, 4, 6}, spacing, LatticeLayout::cell, 0.2));
  const Field<3> shift = moved.position - regular.position;
  EXPECT_LE(shift.cwiseAbs().maxCoeff(), 0.2 * spacing * (1.0 + 1e-12));
  EXPECT_GT(shift.cwiseAbs().maxCoeff(), 0.19 * spacing);  // 360 uniform numbers
  EXPECT_GT(shift.rowwise().norm().minCoeff(), 0.0);
  // 360 numbers of deviation 0.2 / sqrt(3): five deviations of their mean.
  EXPECT_NEAR(shift.mean(), 0.0, 5.0 * 0.2 * spacing / std::sqrt(3.0 * 360.0));
}

TEST(Lattice, JitteredVerticesKeepToTheirFaces) {
  const auto options = lattice<2>({6, 5}, 0.1, LatticeLayout::vertex, 0.3);
  const auto set = fpm::make_lattice(options);
  for (Index b = 0; b < 7; ++b) {
    EXPECT_EQ(set.position(b, 1), options.min[1]);
    EXPECT_NEAR(set.position(35 + b, 1), options.max[1], epsilon);
  }
}

TEST(Lattice, TheSeedAloneDecidesTheJitter) {
  auto options = lattice<2>({6, 5}, 0.1, LatticeLayout::cell, 0.3);
  const auto first = fpm::make_lattice(options).position;
  EXPECT_EQ(fpm::make_lattice(options).position, first);
  options.seed = 2;
  EXPECT_NE(fpm::make_lattice(options).position, first);
}

TEST(Lattice, RefusesWhatIsOutOfRangeAndSaysWhy) {
  const auto with = [](auto change) {
    auto options = lattice<2>({4, 4}, 0.25);
    change(options);
    return [options] { fpm::make_lattice(options); };
  };
  const auto refused = [](const char* why) {
    return ThrowsMessage<std::invalid_argument>(HasSubstr(why));
  };
  EXPECT_THAT(with([](auto& o) { o.spacing = 0.0; }), refused("spacing must be positive"));
  EXPECT_THAT(with([](auto& o) { o.spacing = NAN; }), refused("spacing must be positive"));
  EXPECT_THAT(with([](auto& o) { o.spacing = 0.3; }),
              refused("lattice spacings wide along axis 0"));
  EXPECT_THAT(with([](auto& o) { o.max[1] = -1.0; }), refused("along axis 1"));
  EXPECT_THAT(with([](auto& o) { o.jitter = -0.1; }), refused("between 0 and 0.45"));
  EXPECT_THAT(with([](auto& o) { o.jitter = 0.5; }), refused("between 0 and 0.45"));
  EXPECT_THAT(with([](auto& o) { o.jitter = NAN; }), refused("between 0 and 0.45"));
}

}  // namespace

// Sub-points of a plane particle.
#include <gtest/gtest.h>
#include <fpm/subpoints.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::SecondGradient;
using fpm::subpoint_count;
using fpm::subpoint_offset;
using fpm::subpoint_weights;

TEST(SubPoints, ShareTheVolumeAroundTheirParticle) {
  const double volume = 0.04;
  double total = 0.0;
  Vector<2> centre = Vector<2>::Zero();
  for (std::size_t k = 0; k < subpoint_count; ++k) {
    total += subpoint_weights[k];
    centre += subpoint_weights[k] * subpoint_offset(k, volume);
    EXPECT_EQ(subpoint_offset(k, volume).cwiseAbs(), Vector<2>(0.05, 0.05));
    for (std::size_t l = 0; l < k; ++l) {
      EXPECT_NE(subpoint_offset(k, volume), subpoint_offset(l, volume));
    }
  }
  EXPECT_EQ(total, 1.0);
  EXPECT_EQ(centre, Vector<2>(0.0, 0.0));
}

TEST(SubPoints, SeeTheGradientOfAQuadraticMotion) {
  // x_i = 1/2 H_iXX X^2 + H_iXY X Y + 1/2 H_iYY Y^2 has dx_i/dX = H_iXX X + H_iXY Y and so on.
  const SecondGradient h = random_vector(6, 1).reshaped(2, 3);
  const Vector<2> xi{0.3, -0.7};
  Tensor<2> expected;
  for (int i = 0; i < 2; ++i) {
    expected(i, 0) = h(i, 0) * xi[0] + h(i, 1) * xi[1];
    expected(i, 1) = h(i, 1) * xi[0] + h(i, 2) * xi[1];
  }
  EXPECT_EQ(fpm::second_gradient_at(h, xi), expected);
}

TEST(SubPoints, SecondStressIsTheTransposeOfTheTaylorField) {
  const SecondGradient h = random_vector(6, 2).reshaped(2, 3);
  const Tensor<2> nominal = random_vector(4, 3).reshaped(2, 2);
  const Vector<2> xi{0.3, -0.7};
  SecondGradient t = SecondGradient::Ones();
  fpm::add_second_stress(nominal, xi, t);
  t.array() -= 1.0;
  EXPECT_NEAR(nominal.cwiseProduct(fpm::second_gradient_at(h, xi)).sum(), t.cwiseProduct(h).sum(),
              round_off(8.0, 1.0));
}

}  // namespace

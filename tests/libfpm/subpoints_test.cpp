// Sub-points of a plane particle.
#include <gtest/gtest.h>
#include <fpm/subpoints.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::subpoint_count;
using fpm::subpoint_offset;
using fpm::subpoint_weights;

TEST(SubPoints, ShareTheVolumeAroundTheirParticle) {
  const double volume = 0.04;
  double total = 0.0;
  Vector<2> centre = Vector<2>::Zero();
  for (std::size_t k = 0; k < subpoint_count; ++k) {
    total += subpoint_weights[k];
    centre += subpoint_weights[k] * subpoint_offset<2>(k, volume);
    EXPECT_EQ(subpoint_offset<2>(k, volume).cwiseAbs(), Vector<2>(0.05, 0.05));
    for (std::size_t l = 0; l < k; ++l) {
      EXPECT_NE(subpoint_offset<2>(k, volume), subpoint_offset<2>(l, volume));
    }
  }
  EXPECT_EQ(total, 1.0);
  EXPECT_EQ(centre, Vector<2>(0.0, 0.0));
}

TEST(SubPoints, SeeTheGradientOfAQuadraticMotion) {
  // x_i = 1/2 H_iXX X^2 + H_iXY X Y + 1/2 H_iYY Y^2 has dx_i/dX = H_iXX X + H_iXY Y and so on.
  const fpm::SecondGradient<2> h = random_vector(6, 1).reshaped(2, 3);
  const Vector<2> xi{0.3, -0.7};
  Tensor<2> expected;
  for (int i = 0; i < 2; ++i) {
    expected(i, 0) = h(i, 0) * xi[0] + h(i, 1) * xi[1];
    expected(i, 1) = h(i, 1) * xi[0] + h(i, 2) * xi[1];
  }
  EXPECT_EQ(fpm::second_gradient_at<2>(h, xi), expected);
}

TEST(SubPoints, SecondStressIsTheTransposeOfTheTaylorField) {
  const fpm::SecondGradient<2> h = random_vector(6, 2).reshaped(2, 3);
  const Tensor<2> nominal = random_vector(4, 3).reshaped(2, 2);
  const Vector<2> xi{0.3, -0.7};
  fpm::SecondGradient<2> t = fpm::SecondGradient<2>::Ones();
  fpm::add_second_stress<2>(nominal, xi, t);
  t.array() -= 1.0;
  EXPECT_NEAR(nominal.cwiseProduct(fpm::second_gradient_at<2>(h, xi)).sum(),
              t.cwiseProduct(h).sum(), round_off(8.0, 1.0));
}

// Seen along an axis the four of space are the four of the plane, so a slab is the plane strain
// body; and they see a linear field as eight at all corners would.
TEST(SubPoints, OfSpaceAreThoseOfThePlaneSeenAlongEveryAxis) {
  const double volume = 0.008;  // h = 0.2
  Tensor<3> spread = Tensor<3>::Zero();
  for (std::size_t k = 0; k < subpoint_count; ++k) {
    const Vector<3> xi = subpoint_offset<3>(k, volume);
    EXPECT_LT((xi.head<2>() - subpoint_offset<2>(k, 0.04)).norm(), epsilon);
    EXPECT_NEAR(xi.prod(), 0.05 * 0.05 * 0.05, epsilon);
    spread += subpoint_weights[k] * xi * xi.transpose();
  }
  EXPECT_LT((spread - 0.05 * 0.05 * Tensor<3>::Identity()).norm(), epsilon);
}

TEST(SubPoints, OfSpaceSeeTheGradientOfAQuadraticMotion) {
  const fpm::SecondGradient<3> h = random_vector(18, 1).reshaped(3, 6);
  const Vector<3> xi{0.3, -0.7, 0.4};
  constexpr int column[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};  // XX XY XZ YY YZ ZZ
  Tensor<3> expected = Tensor<3>::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) expected.col(i) += h.col(column[i][j]) * xi[j];
  }
  EXPECT_LT((fpm::second_gradient_at<3>(h, xi) - expected).norm(), round_off(3.0, 1.0));
  const Tensor<3> nominal = random_vector(9, 3).reshaped(3, 3);
  fpm::SecondGradient<3> t = fpm::SecondGradient<3>::Zero();
  fpm::add_second_stress<3>(nominal, xi, t);
  EXPECT_NEAR(nominal.cwiseProduct(expected).sum(), t.cwiseProduct(h).sum(), round_off(27.0, 1.0));
  const Eigen::Matrix<double, 6, 1> weights = h.row(0).transpose();
  EXPECT_LT((fpm::second_weight_at<3>(weights, xi) - expected.row(0).transpose()).norm(),
            round_off(3.0, 1.0));
}

}  // namespace

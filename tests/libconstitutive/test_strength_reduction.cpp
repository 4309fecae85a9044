#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "constitutive/strength_reduction.hpp"

namespace constitutive {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double round_off = 1e-14;  // of some ten operations

// Mohr-Coulomb's shear strength c + p tan(phi) is divided at every pressure, the dilation with it.
TEST(StrengthReduction, DividesTheShearStrengthAtEveryPressure) {
  MaterialParameters whole;
  whole.cohesion = 10e3;
  whole.friction_angle = 30.0;
  whole.dilation_angle = 30.0;
  whole.youngs_modulus = 1e7;
  const MaterialParameters half = with_strength_over(whole, 2.0);
  for (const double pressure : {0.0, 1e3, 1e6}) {
    const auto strength = [&](const MaterialParameters& p) {
      return p.cohesion + pressure * std::tan(p.friction_angle * degree);
    };
    EXPECT_NEAR(strength(half), 0.5 * strength(whole), round_off * strength(whole));
  }
  EXPECT_DOUBLE_EQ(half.dilation_angle, half.friction_angle);
  EXPECT_EQ(half.youngs_modulus, whole.youngs_modulus);
}

TEST(StrengthReduction, DividesWhatIsLeftOfItLikewise) {
  MaterialParameters whole;
  whole.cohesion = 10e3;
  whole.friction_angle = 30.0;
  whole.residual_strain = 0.1;
  whole.residual_cohesion = 2e3;
  whole.residual_friction_angle = 20.0;
  const MaterialParameters half = with_strength_over(whole, 2.0);
  EXPECT_DOUBLE_EQ(half.residual_cohesion, 1e3);
  EXPECT_DOUBLE_EQ(std::tan(half.residual_friction_angle * degree), 0.5 * std::tan(20.0 * degree));
  EXPECT_EQ(half.residual_strain, 0.1);
  // Absent is absent.
  whole.residual_friction_angle = MaterialParameters{}.residual_friction_angle;
  EXPECT_EQ(with_strength_over(whole, 2.0).residual_friction_angle, whole.residual_friction_angle);
}

TEST(StrengthReduction, ByOneChangesNoBit) {
  MaterialParameters whole;
  whole.cohesion = 10.1e3;
  whole.friction_angle = 33.3;
  whole.dilation_angle = 11.1;
  EXPECT_EQ(with_strength_over(whole, 1.0), whole);
}

TEST(StrengthReduction, DividesAFacesAdhesionAndTangent) {
  InterfaceLaw law;
  law.tied = false;
  law.friction_tangent = 0.5;
  law.adhesion = 3e3;
  law.tension = true;
  const InterfaceLaw half = with_strength_over(law, 2.0);
  EXPECT_EQ(half.friction_tangent, 0.25);
  EXPECT_EQ(half.adhesion, 1.5e3);
  EXPECT_TRUE(half.tension);
  EXPECT_TRUE(with_strength_over(InterfaceLaw{}, 2.0).tied);
}

}  // namespace
}  // namespace constitutive

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "points.hpp"

// Truths that hold for every material, in plane strain and in three dimensions.
namespace {

using namespace constitutive;

constexpr int samples = 2000;

template <class Dimension>
class StressUpdate : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(StressUpdate, Dimensions);

TYPED_TEST(StressUpdate, NeverViolatesYield) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(p.cohesion);
    int plastic = 0;
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      const UpdateOutcome outcome = update(material, trial, s0, s1);
      ASSERT_NE(outcome.status(), UpdateStatus::failed);
      plastic += outcome.plastic;
      ASSERT_LE(points::yield_function<Dim>(material, s1.stress),
                points::round_off * points::magnitude<Dim>(trial, p))
          << points::label(p) << " trial " << trial.transpose();
    }
    EXPECT_GT(plastic, samples / 4) << "the sample must exercise " << points::label(p);
    EXPECT_LT(plastic, samples) << "the sample must exercise " << points::label(p);
  }
}

TYPED_TEST(StressUpdate, LeavesAnAdmissibleTrialBitForBit) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(p.cohesion);
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      if (points::yield_function<Dim>(material, trial) > 0) continue;
      PointState<Dim> s0, s1;
      s0.plastic_strain = 0.25;
      s0.plastic_volume_strain = -0.125;
      const UpdateOutcome outcome = update(material, trial, s0, s1);
      ASSERT_FALSE(outcome.plastic);
      ASSERT_EQ(s1.stress, trial);
      ASSERT_EQ(s1.plastic_strain, s0.plastic_strain);
      ASSERT_EQ(s1.plastic_volume_strain, s0.plastic_volume_strain);
      ASSERT_TRUE(trial_tangent(material, trial, s0).isIdentity(0));
    }
  }
}

TYPED_TEST(StressUpdate, OfAReturnedStressChangesItByRoundOffOnly) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    // Trials no larger than about ten times the strength: the return's round-off is relative to the
    // trial, the elastic test's allowance to the stress on the surface.
    points::RandomStress<Dim> random(p.cohesion / 3);
    for (int i = 0; i < samples; ++i) {
      PointState<Dim> s0, s1, s2;
      (void)update(material, random(), s0, s1);
      const UpdateOutcome again = update(material, s1.stress, s1, s2);
      const double change = (s2.stress - s1.stress).norm();
      ASSERT_LE(change, points::round_off * points::magnitude<Dim>(s1.stress, p));
      if (again.plastic) {
        ASSERT_LE(s2.plastic_strain - s1.plastic_strain,
                  points::round_off * points::magnitude<Dim>(s1.stress, p) / moduli(material).shear)
            << points::label(p);
      }
    }
  }
}

TYPED_TEST(StressUpdate, RotatesWithItsTrial) {
  constexpr int Dim = TypeParam::value;
  std::mt19937_64 engine(7);
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(p.cohesion);
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      SpatialMatrix<Dim> q;
      if constexpr (Dim == 3) {
        q = points::random_rotation(engine);
      } else {
        q = Eigen::Rotation2Dd(0.1 * i).toRotationMatrix();
      }
      PointState<Dim> s0, straight, turned;
      (void)update(material, trial, s0, straight);
      (void)update(material, rotate(trial, q), s0, turned);
      const StressVector<Dim> expected = rotate(straight.stress, q);
      ASSERT_LE((turned.stress - expected).norm(),
                points::round_off * points::magnitude<Dim>(trial, p))
          << points::label(p) << " trial " << trial.transpose();
    }
  }
}

TYPED_TEST(StressUpdate, HasTheSameDigitsInPaKPaAndMPa) {
  constexpr int Dim = TypeParam::value;
  for (MaterialParameters p : points::plastic_soils()) {
    const Material pascal = make_material(p);
    const double cohesion = p.cohesion, stiffness = p.youngs_modulus;
    for (const double unit : {1e3, 1e6}) {
      p.cohesion = cohesion / unit;
      p.youngs_modulus = stiffness / unit;
      const Material other = make_material(p);
      points::RandomStress<Dim> random(cohesion);
      for (int i = 0; i < samples; ++i) {
        const StressVector<Dim> trial = random();
        PointState<Dim> s0, a, b;
        (void)update(pascal, trial, s0, a);
        (void)update(other, StressVector<Dim>(trial / unit), s0, b);
        const double allowed = points::round_off * (trial.norm() + cohesion);
        ASSERT_LE((a.stress - unit * b.stress).norm(), allowed) << points::label(p);
        ASSERT_NEAR(a.plastic_strain, b.plastic_strain, allowed / moduli(pascal).shear);
      }
    }
  }
}

TYPED_TEST(StressUpdate, SurvivesHugeIncrements) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(1e6 * p.cohesion);
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      const UpdateOutcome outcome = update(material, trial, s0, s1);
      ASSERT_NE(outcome.status(), UpdateStatus::failed);
      ASSERT_TRUE(s1.stress.allFinite() && std::isfinite(s1.plastic_strain));
      ASSERT_LE(points::yield_function<Dim>(material, s1.stress),
                points::round_off * points::magnitude<Dim>(trial, p));
      ASSERT_TRUE(trial_tangent(material, trial, s0).allFinite());
    }
  }
}

TYPED_TEST(StressUpdate, ReportsANonFiniteTrialAsFailedAndKeepsTheState) {
  constexpr int Dim = TypeParam::value;
  std::vector<MaterialParameters> all = points::plastic_soils();
  all.push_back(points::soil("elastic"));
  const double inf = std::numeric_limits<double>::infinity();
  for (const MaterialParameters& p : all) {
    const Material material = make_material(p);
    for (const double bad : {std::nan(""), inf, -inf}) {
      for (int row = 0; row < stress_size<Dim>; ++row) {
        PointState<Dim> s0, s1;
        s0.stress.setConstant(-1e3);
        s0.plastic_strain = 0.5;
        StressVector<Dim> trial = StressVector<Dim>::Constant(-1e3);
        trial[row] = bad;
        const UpdateOutcome outcome = update(material, trial, s0, s1);
        EXPECT_EQ(outcome.status(), UpdateStatus::failed) << points::label(p) << " row " << row;
        EXPECT_FALSE(outcome.plastic);
        EXPECT_EQ(s1.stress, s0.stress);
        EXPECT_EQ(s1.plastic_strain, s0.plastic_strain);
      }
    }
  }
}

TYPED_TEST(StressUpdate, MayWriteOverItsOwnBeginState) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(3 * p.cohesion);
    for (int i = 0; i < 100; ++i) {
      PointState<Dim> s0, s1, both;
      s0.plastic_strain = both.plastic_strain = 0.1;
      const StressVector<Dim> trial = random();
      (void)update(material, trial, s0, s1);
      (void)update(material, trial, both, both);
      ASSERT_EQ(both.stress, s1.stress);
      ASSERT_EQ(both.plastic_strain, s1.plastic_strain);
      ASSERT_EQ(both.plastic_volume_strain, s1.plastic_volume_strain);
    }
  }
}

TYPED_TEST(StressUpdate, AccumulatesTheStrainItTakesFromTheTrial) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    const TangentMatrix<Dim> compliance =
        elastic_stiffness<Dim>(p.youngs_modulus, p.poissons_ratio).inverse();
    points::RandomStress<Dim> random(3 * p.cohesion);
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      (void)update(material, trial, s0, s1);
      const StrainVector<Dim> plastic = compliance * (trial - s1.stress);
      const Eigen::Matrix3d tensor = to_matrix(with_tensor_shear(plastic));
      const double allowed =
          points::round_off * points::magnitude<Dim>(trial, p) / moduli(material).shear;
      ASSERT_NEAR(s1.plastic_strain, std::sqrt(2.0 / 3) * tensor.norm(), allowed);
      ASSERT_NEAR(s1.plastic_volume_strain, trace(plastic), allowed);
    }
  }
}

TYPED_TEST(StressUpdate, DissipatesByAssociatedFlow) {
  constexpr int Dim = TypeParam::value;
  std::vector<MaterialParameters> associated;
  for (const char* model : {"drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    associated.push_back(points::soil(model, 30, 30));
    associated.push_back(points::soil(model, 0, 0));
  }
  for (const MaterialParameters& p : associated) {
    const Material material = make_material(p);
    const TangentMatrix<Dim> compliance =
        elastic_stiffness<Dim>(p.youngs_modulus, p.poissons_ratio).inverse();
    points::RandomStress<Dim> random(3 * p.cohesion), other(p.cohesion, 2);
    for (int i = 0; i < samples; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      (void)update(material, trial, s0, s1);
      const StrainVector<Dim> plastic = compliance * (trial - s1.stress);
      const double size = points::magnitude<Dim>(trial, p);
      const double allowed = points::round_off * size * size / moduli(material).shear;
      ASSERT_GE(s1.stress.dot(plastic), -allowed);
      // Maximum dissipation: no admissible stress does more work on this plastic strain.
      const StressVector<Dim> rival = other();
      if (points::yield_function<Dim>(material, rival) > 0) continue;
      ASSERT_GE((s1.stress - rival).dot(plastic), -allowed) << points::label(p);
    }
  }
}

}  // namespace

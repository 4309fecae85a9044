#include <gtest/gtest.h>
#include <Eigen/LU>

#include <Eigen/Geometry>
#include <constitutive/objective.hpp>
#include <numbers>

#include "points.hpp"

namespace {

using namespace constitutive;
using std::numbers::pi;

template <int Dim>
SpatialMatrix<Dim> random_increment(std::mt19937_64& engine, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  SpatialMatrix<Dim> f = SpatialMatrix<Dim>::Identity();
  for (double& component : f.reshaped()) component += uniform(engine);
  return f;
}

template <int Dim>
SpatialMatrix<Dim> rotation(double angle) {
  if constexpr (Dim == 2) {
    return Eigen::Rotation2Dd(angle).toRotationMatrix();
  } else {
    return Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  }
}

template <class Dimension>
class ObjectiveUpdate : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ObjectiveUpdate, Dimensions);

TYPED_TEST(ObjectiveUpdate, RotatesRigidlyThrough360DegreesWithoutDrift) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    StressVector<Dim> trial = StressVector<Dim>::Constant(-0.4 * p.cohesion);
    trial[0] = -5 * p.cohesion;
    for (const int steps : {4, 7, 360}) {
      PointState<Dim> start, s0, s1;
      (void)update(material, trial, PointState<Dim>{}, start);  // on the yield surface
      ASSERT_GT(start.plastic_strain, 0) << points::label(p);
      s0 = start;
      for (int i = 0; i < steps; ++i) {
        const auto increment = objective_increment(rotation<Dim>(2 * pi / steps));
        const UpdateOutcome outcome =
            update(material, elastic_trial(s0.stress, increment, moduli(material)), s0, s1);
        ASSERT_NE(outcome.status(), UpdateStatus::failed);
        s0 = s1;
      }
      // Each step rounds dF, whose error is eps of strain: eps E of stress and the rotation's own.
      const double allowed = points::round_off * steps * (start.stress.norm() + p.youngs_modulus);
      EXPECT_LE((s1.stress - start.stress).norm(), allowed) << points::label(p) << " " << steps;
      EXPECT_LE(s1.plastic_strain - start.plastic_strain, allowed / moduli(material).shear);
    }
  }
}

TYPED_TEST(ObjectiveUpdate, RotationOfTheIncrementIsOrthogonalAndExactForRigidMotion) {
  constexpr int Dim = TypeParam::value;
  std::mt19937_64 engine(11);
  for (int i = 0; i < 200; ++i) {
    const auto general = objective_increment(random_increment<Dim>(engine, 0.4));
    EXPECT_TRUE((general.rotation * general.rotation.transpose()).isIdentity(points::round_off));
    EXPECT_GT(general.rotation.determinant(), 0);
    const SpatialMatrix<Dim> turn = rotation<Dim>(-3 + 0.03 * i);
    const auto rigid = objective_increment(turn);
    // H grows as 1 / cos^2(angle / 2) towards half a turn.
    const double amplification = rigid.half_inverse.squaredNorm();
    EXPECT_LE((rigid.rotation - turn).norm(), points::round_off * amplification);
    EXPECT_LE(rigid.strain.norm(), points::round_off * amplification);
  }
}

TYPED_TEST(ObjectiveUpdate, MatchesItsDefinitionByMatrixInversion) {
  constexpr int Dim = TypeParam::value;
  std::mt19937_64 engine(12);
  const SpatialMatrix<Dim> identity = SpatialMatrix<Dim>::Identity();
  for (int i = 0; i < 200; ++i) {
    const SpatialMatrix<Dim> f = random_increment<Dim>(engine, 0.3);
    const auto inc = objective_increment(f);
    const SpatialMatrix<Dim> l = (f - identity) * ((f + identity) / 2).inverse();
    const SpatialMatrix<Dim> w = (l - l.transpose()) / 2;
    const SpatialMatrix<Dim> q = (identity - w / 2).inverse() * (identity + w / 2);
    EXPECT_TRUE(inc.gradient.isApprox(l, points::round_off));
    EXPECT_TRUE(inc.rotation.isApprox(q, points::round_off));
    EXPECT_TRUE(inc.strain.isApprox((l + l.transpose()) / 2, points::round_off));
    EXPECT_DOUBLE_EQ(inc.midpoint_determinant, ((f + identity) / 2).determinant());
  }
}

TYPED_TEST(ObjectiveUpdate, DerivativeEqualsCentralDifferences) {
  constexpr int Dim = TypeParam::value;
  // Truncation h^2 times third derivatives below about 100 for increments up to 0.3; eps / h.
  constexpr double h = 1e-5, allowed = 100 * h * h + points::eps / h;
  std::mt19937_64 engine(13);
  const ElasticModuli m = elastic_moduli(1, 0.3);
  const StressVector<Dim> stress = StressVector<Dim>::LinSpaced(-1, 0.5);
  for (int i = 0; i < 100; ++i) {
    const SpatialMatrix<Dim> f = random_increment<Dim>(engine, 0.3);
    const SpatialMatrix<Dim> direction =
        random_increment<Dim>(engine, 1) - SpatialMatrix<Dim>::Identity();
    const auto inc = objective_increment(f);
    const auto plus = objective_increment(SpatialMatrix<Dim>(f + h * direction));
    const auto minus = objective_increment(SpatialMatrix<Dim>(f - h * direction));
    const auto d = derivative(inc, direction);
    const auto difference = [&](auto field) {
      return ((plus.*field - minus.*field) / (2 * h)).eval();
    };
    using Increment = ObjectiveIncrement<Dim>;
    EXPECT_LE((d.gradient - difference(&Increment::gradient)).norm(), allowed);
    EXPECT_LE((d.strain - difference(&Increment::strain)).norm(), allowed);
    EXPECT_LE((d.rotation - difference(&Increment::rotation)).norm(), allowed);
    const StressVector<Dim> expected =
        (elastic_trial(stress, plus, m) - elastic_trial(stress, minus, m)) / (2 * h);
    EXPECT_LE((elastic_trial_derivative(stress, inc, d, m) - expected).norm(), allowed);
  }
}

TYPED_TEST(ObjectiveUpdate, IsRecoverablyInadmissibleWhenTheMidpointInverts) {
  constexpr int Dim = TypeParam::value;
  const SpatialMatrix<Dim> identity = SpatialMatrix<Dim>::Identity();
  EXPECT_TRUE(objective_increment(identity).is_admissible());
  SpatialMatrix<Dim> f = identity;
  f(0, 0) = -0.999;
  EXPECT_TRUE(objective_increment(f).is_admissible());
  f(0, 0) = -1;
  EXPECT_FALSE(objective_increment(f).is_admissible()) << "singular";
  f(0, 0) = -1.5;
  EXPECT_FALSE(objective_increment(f).is_admissible()) << "inverted";
  f(0, 0) = std::nan("");
  EXPECT_FALSE(objective_increment(f).is_admissible()) << "not a number";
}

TYPED_TEST(ObjectiveUpdate, ApproachesSmallStrainQuadratically) {
  constexpr int Dim = TypeParam::value;
  const ElasticModuli m = elastic_moduli(1, 0.3);
  std::mt19937_64 engine(14);
  const SpatialMatrix<Dim> shape =
      random_increment<Dim>(engine, 1) - SpatialMatrix<Dim>::Identity();
  const SpatialMatrix<Dim> strain = (shape + shape.transpose()) / 2;
  const auto error = [&](double size) {
    const auto inc =
        objective_increment(SpatialMatrix<Dim>(SpatialMatrix<Dim>::Identity() + size * shape));
    const StressVector<Dim> zero = StressVector<Dim>::Zero();
    return (elastic_trial(zero, inc, m) -
            elastic_trial<Dim>(zero, strain_vector<Dim>(SpatialMatrix<Dim>(size * strain)), m))
        .norm();
  };
  EXPECT_NEAR(error(1e-3) / error(1e-4), 100, 1) << "terms of third order are 1e-3 of the second";
}

TEST(ObjectiveIncrement, OfAUniaxialStretchIsTheMidpointStrain) {
  for (const double stretch : {0.5, 0.9, 1.0, 1.3, 4.0}) {
    Eigen::Matrix2d f = Eigen::Matrix2d::Identity();
    f(1, 1) = stretch;
    EXPECT_DOUBLE_EQ(objective_increment(f).strain(1, 1), 2 * (stretch - 1) / (stretch + 1));
  }
}

TEST(ObjectiveIncrement, InPlaneStrainIsTheThreeDimensionalOneWithoutOutOfPlaneMotion) {
  std::mt19937_64 engine(15);
  const ElasticModuli m = elastic_moduli(1, 0.3);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix2d flat = random_increment<2>(engine, 0.3);
    Eigen::Matrix3d solid = Eigen::Matrix3d::Identity();
    solid.topLeftCorner<2, 2>() = flat;
    const StressVector<2> s2 = StressVector<2>::LinSpaced(-1, 0.5);
    StressVector<3> s3 = StressVector<3>::Zero();
    s3.head<4>() = s2;
    const StressVector<3> t3 = elastic_trial(s3, objective_increment(solid), m);
    EXPECT_TRUE(
        t3.head<4>().isApprox(elastic_trial(s2, objective_increment(flat), m), points::round_off));
    EXPECT_LE(t3.tail<2>().norm(), points::round_off);
  }
}

TEST(ObjectiveUpdate2D, ConvergesToJaumannSimpleShearWithFirstOrder) {
  // Closed form of the Jaumann rate in simple shear gamma: sigma_xy = mu sin gamma,
  // sigma_xx = -sigma_yy = mu (1 - cos gamma). The step adds its strain e unrotated to the end
  // frame, where half of the step's spin is missing: a local error of mu |w e - e w| = mu dgamma^2
  // / 2 in the normal stresses, mu gamma^2 / (2 steps) over the path at most.
  const ElasticModuli m = elastic_moduli(2.6, 0.3);  // mu = 1
  const double gamma = 2;
  const auto error = [&](int steps) {
    Eigen::Matrix2d f = Eigen::Matrix2d::Identity();
    f(0, 1) = gamma / steps;
    StressVector<2> stress = StressVector<2>::Zero();
    for (int i = 0; i < steps; ++i) stress = elastic_trial(stress, objective_increment(f), m);
    const double c = 1 - std::cos(gamma), s = std::sin(gamma);
    return (stress - StressVector<2>(c, -c, 0, s)).norm();
  };
  const auto bound = [&](int steps) { return std::sqrt(2.0) * gamma * gamma / (2 * steps); };
  EXPECT_LE(error(100), bound(100));
  EXPECT_LE(error(800), bound(800));
  EXPECT_NEAR(error(400) / error(800), 2, 0.01) << "first order up to the second";
}

}  // namespace

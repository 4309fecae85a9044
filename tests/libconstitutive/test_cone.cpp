#include <gtest/gtest.h>

#include <numbers>

#include "points.hpp"

namespace {

using namespace constitutive;

constexpr double degree = std::numbers::pi / 180;
constexpr double cohesion = 15e3;

TEST(PlaneStrainCone, EqualsMohrCoulombInPlaneAtCollapse) {
  // At collapse the elastic strain rates vanish; with no out-of-plane strain the flow rule gives
  // s_zz = -2 beta sqrt(J2). Then J2 = r^2 + 3/4 s_zz^2 for the in-plane radius r.
  for (const double phi : {0.0, 1e-6, 5.0, 20.0, 45.0, 89.0}) {
    for (const double ratio : {0.0, 0.3, 1.0}) {
      const double angle = phi * degree;
      const Cone cone = plane_strain_cone(cohesion, angle, ratio * angle);
      for (const double p : {-1e6, -1e4, 0.0}) {
        const double sqrt_j2 = cone.radius(p);
        const double s_zz = -2 * cone.beta * sqrt_j2;
        const double r = std::sqrt(sqrt_j2 * sqrt_j2 - 3.0 / 4 * s_zz * s_zz);
        const double in_plane_mean = p - s_zz / 2;
        const double mohr_coulomb = cohesion * std::cos(angle) - in_plane_mean * std::sin(angle);
        EXPECT_NEAR(r, mohr_coulomb, points::round_off * (cohesion - p)) << phi << " " << ratio;
      }
    }
  }
}

TEST(PlaneStrainCone, IsTheCylinderOfTheCohesionWithoutFriction) {
  const Cone cone = plane_strain_cone(cohesion, 0, 0);
  EXPECT_EQ(cone.alpha, 0);
  EXPECT_EQ(cone.beta, 0);
  EXPECT_EQ(cone.strength, cohesion);
}

TEST(PlaneStrainCone, IsTheKnownClosedFormForAssociatedFlow) {
  const double t = std::tan(0.5);
  const Cone cone = plane_strain_cone(cohesion, 0.5, 0.5);
  EXPECT_DOUBLE_EQ(cone.alpha, t / std::sqrt(9 + 12 * t * t));
  EXPECT_DOUBLE_EQ(cone.beta, cone.alpha);
  EXPECT_DOUBLE_EQ(cone.strength, 3 * cohesion / std::sqrt(9 + 12 * t * t));
}

TEST(CompressionCone, TouchesMohrCoulombInTriaxialCompressionAndIsNowhereInside) {
  for (const double phi : {0.0, 20.0, 45.0, 89.0}) {
    const double angle = phi * degree, s = std::sin(angle);
    const Cone cone = compression_cone(cohesion, angle, 0);
    for (const double cell : {0.0, -1e5}) {
      // Principal stresses at failure: (1 + s) sigma_1 - (1 - s) sigma_3 = 2 c cos phi.
      const double axial = ((1 + s) * cell - 2 * cohesion * std::cos(angle)) / (1 - s);
      for (const double between : {0.0, 0.4, 1.0}) {
        StressVector<3> failure = StressVector<3>::Zero();
        failure.head<3>() << cell, cell + between * (axial - cell), axial;
        const double f = points::yield_function<3>(cone, failure);
        const double allowed = points::round_off * (failure.norm() + cohesion);
        if (between == 0) {
          EXPECT_NEAR(f, 0, allowed) << phi;
        }
        EXPECT_LE(f, allowed) << phi;
      }
    }
  }
}

TEST(DruckerPrager, ReturnsTensionToTheApexAndCountsItsPlasticVolume) {
  for (const double psi : {0.0, 10.0, 20.0}) {
    const auto m = std::get<DruckerPrager>(make_material(points::soil("drucker_prager", 20, psi)));
    const double apex = m.cone.strength / (3 * m.cone.alpha);
    PointState<3> s0, s1;
    const StressVector<3> trial = isotropic<3>(10 * apex);
    EXPECT_EQ(update(m, trial, s0, s1).status(), UpdateStatus::apex);
    EXPECT_LE((s1.stress - isotropic<3>(apex)).norm(), points::round_off * trial.norm());
    EXPECT_NEAR(s1.plastic_volume_strain, 9 * apex / m.moduli.bulk,
                points::round_off * 10 * apex / m.moduli.bulk);
    EXPECT_TRUE(trial_tangent(m, trial, s0).isZero(0));
  }
}

TEST(DruckerPrager, WithoutFrictionHasNoApexAndKeepsThePressure) {
  const Material m = make_material(points::soil("drucker_prager", 0, 0));
  StressVector<2> trial = isotropic<2>(1e6 * cohesion);
  trial[3] = 5 * cohesion;
  PointState<2> s0, s1;
  const UpdateOutcome outcome = update(m, trial, s0, s1);
  EXPECT_EQ(outcome.status(), UpdateStatus::ok);
  EXPECT_TRUE(outcome.plastic);
  EXPECT_DOUBLE_EQ(mean_stress(s1.stress), mean_stress(trial));
  EXPECT_EQ(s1.plastic_volume_strain, 0);
}

TEST(DruckerPrager, WithoutCohesionStandsOnItsApexAtZeroStress) {
  MaterialParameters p = points::soil("drucker_prager", 30, 10);
  p.cohesion = 0;
  const Material m = make_material(p);
  PointState<2> s0, s1;
  const UpdateOutcome rest = update(m, StressVector<2>(StressVector<2>::Zero()), s0, s1);
  EXPECT_FALSE(rest.plastic);
  EXPECT_EQ(s1.stress, StressVector<2>(StressVector<2>::Zero()));
  const UpdateOutcome pulled = update(m, isotropic<2>(1e3), s0, s1);
  EXPECT_EQ(pulled.status(), UpdateStatus::apex);
  EXPECT_EQ(s1.stress, StressVector<2>(StressVector<2>::Zero()));
}

/// Drives constant-volume shear until well beyond the cut-off.
template <class M>
void expect_dilation_to_stop(const M& m, double cutoff) {
  PointState<2> s;
  StrainVector<2> strain = StrainVector<2>::Zero();
  strain[3] = 1e-3;
  double largest_step = 0, at_cutoff = -1;
  for (int i = 0; i < 400; ++i) {
    const PointState<2> s0 = s;
    (void)update(m, elastic_trial<2>(s0.stress, strain, m.moduli), s0, s);
    const double dilation = s.plastic_volume_strain - s0.plastic_volume_strain;
    if (s0.plastic_volume_strain >= cutoff) {
      EXPECT_NEAR(dilation, 0, points::eps) << "no dilation after the cut-off";
      if (at_cutoff < 0) at_cutoff = s0.plastic_volume_strain;
    } else {
      largest_step = std::max(largest_step, dilation);
    }
  }
  EXPECT_GE(at_cutoff, cutoff) << "the path must reach the cut-off";
  EXPECT_LE(at_cutoff, cutoff + largest_step) << "overshoot of at most one step";
}

TEST(DilationCutOff, StopsPlasticVolumeWithinOneStep) {
  constexpr double cutoff = 0.02;
  MaterialParameters p = points::soil("drucker_prager", 30, 20);
  p.dilation_cutoff = cutoff;
  expect_dilation_to_stop(std::get<DruckerPrager>(make_material(p)), cutoff);
  p.model = "mohr_coulomb";
  expect_dilation_to_stop(std::get<MohrCoulomb>(make_material(p)), cutoff);
}

TEST(DilationCutOff, OfZeroMeansNoDilationAtAll) {
  MaterialParameters p = points::soil("drucker_prager", 30, 20);
  p.dilation_cutoff = 0;
  const Cone cone = yield_cone(std::get<DruckerPrager>(make_material(p)), 0);
  EXPECT_EQ(cone.beta, 0);
  EXPECT_GT(cone.alpha, 0);
}

// Without dilation the match to Mohr-Coulomb in plane strain is that of psi = 0, so that the load
// at collapse does not depend on when dilation has ended.
TEST(DilationCutOff, LeavesThePlaneStrainMatch) {
  MaterialParameters p = points::soil("drucker_prager", 30, 30);
  p.dilation_cutoff = 0.01;
  const Cone beyond = yield_cone(std::get<DruckerPrager>(make_material(p)), 0.01);
  p.dilation_angle = 0;
  const Cone flat = yield_cone(std::get<DruckerPrager>(make_material(p)), 0);
  EXPECT_EQ(beyond.alpha, flat.alpha);
  EXPECT_EQ(beyond.beta, 0);
  EXPECT_EQ(beyond.strength, flat.strength);
}

}  // namespace

#include <gtest/gtest.h>

#include "points.hpp"

// Parameters at the ends of their ranges: still on the surface, still finite, still consistent.
namespace {

using namespace constitutive;

std::vector<MaterialParameters> extremes() {
  std::vector<MaterialParameters> all;
  for (const char* model :
       {"von_mises", "drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    for (const double nu : {-0.9, 0.499999}) {
      all.push_back(points::soil(model));
      all.back().poissons_ratio = nu;
    }
    all.push_back(points::soil(model));
    all.back().cohesion = 1e-9;
    if (all.back().model == "von_mises") continue;
    for (const double psi : {0.0, 45.0, 89.0}) all.push_back(points::soil(model, 89, psi));
    all.push_back(points::soil(model, 1e-9, 0));
    all.push_back(points::soil(model));
    all.back().cohesion = 0;
  }
  return all;
}

/// Condition number of the pair of flow directions of a Mohr-Coulomb edge, which multiplies the
/// round-off of a return; the cones have no such pair.
double condition(const Material& material) {
  const auto* m = std::get_if<MohrCoulomb>(&material);
  return m == nullptr ? 1 : 4 / ((1 - m->sin_friction) * (1 - m->sin_dilation));
}

template <class Dimension>
class Extreme : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Extreme, Dimensions);

TYPED_TEST(Extreme, ParametersReturnToTheSurface) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : extremes()) {
    ASSERT_TRUE(validate(p).empty()) << points::label(p);
    const Material material = make_material(p);
    points::RandomStress<Dim> random(15e3);
    for (int i = 0; i < 2000; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      const UpdateOutcome outcome = update(material, trial, s0, s1);
      ASSERT_NE(outcome.status(), UpdateStatus::failed);
      ASSERT_TRUE(s1.stress.allFinite() && std::isfinite(s1.plastic_strain));
      ASSERT_GE(s1.plastic_strain, 0);
      ASSERT_LE(points::yield_function<Dim>(material, s1.stress),
                points::round_off * condition(material) * points::magnitude<Dim>(trial, p))
          << points::label(p) << " trial " << trial.transpose();
      ASSERT_TRUE(tangent(material, trial, s0).allFinite()) << points::label(p);
    }
  }
}

TYPED_TEST(Extreme, NearlyIncompressibleAssociatedFlowStaysOnTheSurfaceInStrainSteps) {
  constexpr int Dim = TypeParam::value;
  for (const char* model : {"drucker_prager", "mohr_coulomb"}) {
    MaterialParameters p = points::soil(model, 20, 20);
    p.poissons_ratio = 0.499999;
    const Material material = make_material(p);
    const ElasticModuli& m = moduli(material);
    PointState<Dim> s;
    StrainVector<Dim> strain = StrainVector<Dim>::Zero();
    strain[0] = -1e-3;
    strain[1] = 1e-3;
    strain[3] = 5e-4;
    for (int i = 0; i < 100; ++i) {
      const PointState<Dim> s0 = s;
      const StressVector<Dim> trial = elastic_trial<Dim>(s0.stress, strain, m);
      ASSERT_NE(update(material, trial, s0, s).status(), UpdateStatus::failed);
      ASSERT_LE(points::yield_function<Dim>(material, s.stress),
                points::round_off * condition(material) * points::magnitude<Dim>(trial, p));
    }
    // The motion keeps the volume: what flows plastically is taken back elastically by pressure.
    EXPECT_GT(s.plastic_volume_strain, 0);
    EXPECT_NEAR(s.plastic_volume_strain * m.bulk / -mean_stress(s.stress), 1,
                100 * points::round_off * condition(material));
  }
}

TYPED_TEST(Extreme, TrialsAreNeverSilentlyAccepted) {
  // Finite numbers whose squares overflow cannot be returned: they must fail, not pass as elastic.
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    StressVector<Dim> trial = StressVector<Dim>::Zero();
    trial[0] = 1e200;
    PointState<Dim> s0, s1;
    EXPECT_EQ(update(material, trial, s0, s1).status(), UpdateStatus::failed) << points::label(p);
  }
}

}  // namespace

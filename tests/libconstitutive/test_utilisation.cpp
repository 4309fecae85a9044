#include <gtest/gtest.h>

#include "constitutive/utilisation.hpp"
#include "points.hpp"

namespace {

using namespace constitutive;

// A stress well outside comes back to the surface, where all strength is used up.
TEST(Utilisation, IsOneWhereAMaterialYields) {
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<2> random(1e6);
    int yielded = 0;
    for (int i = 0; i < 200; ++i) {
      PointState<2> s0, s1;
      const UpdateOutcome outcome = update<2>(material, random(), s0, s1);
      const double used =
          utilisation<2>(material, s1.stress, s0.plastic_volume_strain, s0.plastic_strain);
      if (outcome.plastic) {
        // Near the apex the strength is the difference of two large numbers.
        EXPECT_NEAR(used, 1.0, 1e-6) << points::label(p);
        ++yielded;
      } else {
        EXPECT_LT(used, 1.0) << points::label(p);
      }
    }
    EXPECT_GT(yielded, 50) << points::label(p);
  }
}

// Half a Mohr circle's strength: c cos(phi) - mean sin(phi), 30 degrees.
TEST(Utilisation, IsTheShareOfTheShearStrength) {
  MaterialParameters p = points::soil("mohr_coulomb", 30, 0);
  p.cohesion = 10e3;
  const double mean = -20e3, strength = 10e3 * std::sqrt(0.75) + 20e3 * 0.5;
  StressVector<2> stress;
  stress << mean + 0.25 * strength, mean - 0.25 * strength, mean, 0.0;
  EXPECT_NEAR(utilisation<2>(make_material(p), stress, 0.0, 0.0), 0.25, 1e-12);
  p = points::soil("von_mises");
  stress << 0.3 * p.cohesion, -0.3 * p.cohesion, 0.0, 0.0;
  EXPECT_NEAR(utilisation<2>(make_material(p), stress, 0.0, 0.0), 0.3, 1e-12);
  p.model = "elastic";
  EXPECT_EQ(utilisation<2>(make_material(p), stress, 0.0, 0.0), 0.0);
}

// Beyond the apex nothing is borne.
TEST(Utilisation, IsOneBeyondTheApex) {
  StressVector<2> tension = isotropic<2>(1e6);
  for (const char* model : {"drucker_prager", "mohr_coulomb"}) {
    EXPECT_EQ(utilisation<2>(make_material(points::soil(model)), tension, 0.0, 0.0), 1.0) << model;
  }
}

}  // namespace

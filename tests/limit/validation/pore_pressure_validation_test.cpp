// Pore pressures that are told from place to place, to a gap of 7 %.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limit/ground/ground_cases.hpp"
#include "limit/ground/water_scenes.hpp"

namespace {

using namespace limit;
using namespace told;

// Water that rises with a gradient i leaves ground a weight of gamma' - i gamma_w, with and without
// cohesion: 20 - 10 - 5 kN/m3.
TEST(PorePressure, OfWaterThatRisesLightensTheGround) {
  for (const double cohesion : {2e3, 0.0}) {
    const bracket::Solution light = solution(footing(cohesion, 5e3, ""));
    ASSERT_TRUE(light.lower && light.upper);
    for (const char* told :
         {"{ at = [0, 0], value = 0, gradient = [0, -15e3] }",
          "{ points = [[0, 0, 0], [5, 0, 0], [0, -2, 30e3], [5, -2, 30e3], [2, -1, 15e3]] }",
          "{ raster = [[0, 0, 0], [15e3, 15e3, 15e3], [30e3, 30e3, 30e3]], lower = [0, -2], "
          "step = [2.5, 1] }"}) {
      const bracket::Solution wet =
          solution(footing(cohesion, 20e3, fmt::format("[water]\npore_pressure = {}\n", told)));
      ASSERT_TRUE(wet.lower && wet.upper) << told;
      EXPECT_LE(*wet.lower, *light.upper) << told;
      EXPECT_LE(*light.lower, *wet.upper) << told;
      EXPECT_LE(wet.gap(), 0.07) << told;
    }
  }
}

// Seepage along a face, told by points whose triangles are no triangles of the mesh: the bracket
// has what the table along the face has, and the skin of sand slides at its closed form,
// tan(phi) / tan(beta) (1 - r_u / cos(beta)^2).
TEST(PorePressure, OfSeepageAlongAFaceByPoints) {
  const std::string points = points_in_slope([](double depth) { return 10e3 * depth; });
  const bracket::Solution told = solution(slope(1e3, points));
  const bracket::Solution table = solution(slope(
      1e3,
      fmt::format("[water]\nunit_weight = 10e3\ntable = [[-10, 10], [0, 10], [{}, 0], [{}, 0]]\n",
                  run, run + 10.0)));
  ASSERT_TRUE(told.lower && told.upper && table.lower && table.upper);
  EXPECT_LE(*told.lower, *table.upper);
  EXPECT_LE(*table.lower, *told.upper);
  EXPECT_LE(told.gap(), 0.07);
  const bracket::Solution sand = solution(slope(0.0, points));
  ASSERT_TRUE(sand.lower && sand.upper);
  const double cosine = std::cos(20.0 * degree);
  const double skin =
      std::tan(35.0 * degree) / std::tan(20.0 * degree) * (1.0 - 0.5 / (cosine * cosine));
  EXPECT_LE(*sand.lower, skin);
  EXPECT_GE(*sand.upper, (1.0 - 1e-9) * skin);
  EXPECT_LE(sand.gap(), 0.07);
}

}  // namespace

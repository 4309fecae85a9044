// Where the body is and how slender it is.

#include <omp.h>

#include "scene/reader.hpp"
#include "small_footing.hpp"

namespace extremes {
namespace {

// Ten thousand half widths from the origin, coordinates have lost four digits of twelve.
TEST(Place, FarFromTheOriginChangesTheLoadLessThanTheSolverTolerance) {
  constexpr double tolerance = 1e-3;
  const Steps near = footing_steps(small_footing());
  const Steps far = footing_steps(small_footing(1.0, 1.0, 2200.0));
  ASSERT_EQ(near.size(), far.size());
  for (std::size_t k = 0; k < near.size(); ++k) {
    EXPECT_NEAR(far[k].mean_pressure / near[k].mean_pressure, 1.0, tolerance);
  }
}

// A pressed block and its measures, 0.1 m apart, whose lower corner is at (origin, origin).
std::string block_scene(double origin, const std::string& layout, const std::string& jitter) {
  const auto at = [&](double x, double y) {
    std::ostringstream text;
    text.precision(12);
    text << '[' << origin + x << ", " << origin + y << ']';
    return text.str();
  };
  return "[geometry]\ndimension = 2\nmin = " + at(0.0, 0.0) + "\nmax = " + at(1.0, 1.0) +
         "\nspacing = 0.1\nlayout = \"" + layout + "\"\njitter = " + jitter +
         "\n[approximation]\nconsistency = \"on\"\n" +
         R"([[material]]
name = "soil"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[material]]
name = "block"
model = "elastic"
youngs_modulus = 1e8
poissons_ratio = 0.3
)" +
         "region_min = " + at(0.3, 0.3) + "\nregion_max = " + at(0.5, 0.5) +
         R"(
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "strut"
directions = "x"
)" +
         "region_min = " + at(0.9, 0.65) + "\nregion_max = " + at(1.0, 0.8) + "\n" +
         R"([[traction]]
name = "load"
side = "top"
value = [100.0, -1000.0]
follower = false
[[traction]]
name = "water"
side = "left"
value = [500.0, 0.0]
follower = true
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 2
[solver]
tolerance = 1e-8
)";
}

// At 1e5 m coordinates are known to 1.5e-11 m, differences over a spacing, of which the strains
// are, to 3e-10; a few dozen of them meet in a force.
TEST(Place, FarFromTheOriginAnElasticBodyMovesAsItDoesNextToIt) {
  constexpr double round_off = 1e-8, solver_tolerance = 1e-8;
  constexpr double particles = 10.0;  // along a side: how much softer the body is than one
  omp_set_num_threads(1);             // so few particles keep no more of them busy
  for (const std::string layout : {"vertex", "cell"}) {
    for (const std::string jitter : {"0.0", "0.2"}) {
      SCOPED_TRACE(layout + ", jitter " + jitter);
      PlaneRun near(verification::scene_of(block_scene(0.0, layout, jitter)));
      PlaneRun far(verification::scene_of(block_scene(1e5, layout, jitter)));
      const Steps near_steps = near.complete(), far_steps = far.complete();
      ASSERT_EQ(far_steps.size(), near_steps.size());
      const double largest = near.state.displacement.cwiseAbs().maxCoeff();
      const double difference =
          (far.state.displacement - near.state.displacement).cwiseAbs().maxCoeff();
      report(layout + jitter, difference / largest);
      EXPECT_LE(difference, particles * (round_off + solver_tolerance) * largest);
    }
  }
}

std::string column_scene(int cells) {
  return "[geometry]\ndimension=2\nmin=[0.0, 0.0]\nmax=[" + std::to_string(0.1 * cells) +
         ", 1.0]\nspacing=0.1\n" +
         R"([[material]]
name = "soil"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.0
density = 1e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[gravity]
acceleration = [0.0, -10.0]
[drive]
kind = "load"
scales = ["gravity"]
[programme]
steps = 1
)";
}

TEST(Place, ColumnOfOneOrTwoCellsIsRefusedByName) {
  for (const int cells : {1, 2}) {
    const auto reading = scene::parse_scene(column_scene(cells), "column", {});
    ASSERT_FALSE(reading.scene);
    ASSERT_EQ(reading.errors.size(), 1U);
    EXPECT_NE(reading.errors[0].text().find("geometry.spacing"), std::string::npos);
    EXPECT_NE(reading.errors[0].text().find("at least 3"), std::string::npos);
  }
}

// With nu = 0 every column settles by rho g H^2 / (2 E); one of three cells has one-sided rows
// all over, which a first-order scheme pays with a share dx / H or two.
TEST(Place, ColumnOfThreeCellsSettlesUnderItsWeight) {
  constexpr double exact = 1e3 * 10.0 / (2.0 * 1e6), first_order = 0.2;
  PlaneRun run(verification::scene_of(column_scene(3)));
  const Steps steps = run.complete();
  ASSERT_FALSE(steps.empty());
  const double top = steps.back().max_displacement;
  report("top_error", top / exact - 1.0);
  EXPECT_NEAR(top / exact, 1.0, first_order);
  expect_finite(run);
}

}  // namespace
}  // namespace extremes

// Where the body is and how slender it is.

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

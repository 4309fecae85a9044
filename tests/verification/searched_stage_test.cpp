// Re-search in runs whose stages change the body or its supports.
#include <gtest/gtest.h>

#include <string>

#include "staged_run.hpp"

namespace verification {
namespace {

// Clay in plane strain, squeezed to a height of 1 - d, is as much wider: 2 c / (1 - d) over its
// first width. Each search costs a little of that: 1.6 % were measured at d = 0.3 before the body
// changed, 2.5 % after it.
constexpr double of_searches = 0.04;
double pressure_at(double d) {
  return 2.0 * 10e3 / (1.0 - d);
}

Eigen::Index searched_rows(const StagedRun& run) {
  Eigen::Index count = 0;
  for (Eigen::Index a = 0; a < run.state.displacement.rows(); ++a) {
    count += run.state.rows.searched(static_cast<fpm::Index>(a)) ? 1 : 0;
  }
  return count;
}

// A block of clay is squeezed by a third between smooth plates. A support that bears nothing ends:
// all rows are those of another body, none of which was searched, and are searched once more.
TEST(SearchedRows, StaySearchedAndBearOnWhenTheBodyChanges) {
  StagedRun run(scene_of(R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.125
[[material]]
name = "clay"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 10e3
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "idle"
at = [0.0625, 0.0625]
directions = ["x"]
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
lateral = "free"
width = 1.0
[re_search]
enabled = true
trigger = 0.1
[solver]
tolerance = 1e-6
[[stage]]
name = "squeeze"
to = 0.3
steps = 30
[[stage]]
name = "idle"
release = ["idle"]
steps = 1
[[stage]]
name = "on"
to = 0.35
steps = 5
)"));
  ASSERT_TRUE(run.complete_stage());
  const Eigen::Index before = searched_rows(run);
  ASSERT_GT(before, run.state.displacement.rows() / 2);
  const auto expect_pressure = [&](double d) {
    EXPECT_NEAR(run.records.back().back().mean_pressure, pressure_at(d),
                of_searches * pressure_at(d));
  };
  expect_pressure(0.3);
  run.stages.go_on(run.state);
  EXPECT_EQ(searched_rows(run), before);
  ASSERT_TRUE(run.complete_stage());
  expect_pressure(0.3);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  expect_pressure(0.35);
}

}  // namespace
}  // namespace verification

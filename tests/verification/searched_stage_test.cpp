// Re-search in runs whose stages change the body or its supports.
#include <gtest/gtest.h>

#include <string>

#include "staged_run.hpp"

namespace verification {
namespace {

// Of forces the solver leaves 1e-6 open in each step.
constexpr double of_solver = 1e-4;

Eigen::Index searched_rows(const StagedRun& run) {
  Eigen::Index count = 0;
  for (Eigen::Index a = 0; a < run.state.displacement.rows(); ++a) {
    count += run.state.rows.searched(static_cast<fpm::Index>(a)) ? 1 : 0;
  }
  return count;
}

// A block of clay is squeezed by a third between smooth plates: strains and stresses are the same
// everywhere. A support that bears nothing ends: all rows are those of another body, none of which
// was searched, and are searched once more. Nothing moves.
TEST(SearchedRows, OfAHomogeneousBodyAreCarriedExactly) {
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
  ASSERT_GT(searched_rows(run), run.state.displacement.rows() / 2);
  const fpm::Field<2> before = run.state.displacement;
  const auto stress = run.state.stress;
  const double pressure = run.records.back().back().mean_pressure;
  run.stages.go_on(run.state);
  EXPECT_GT(searched_rows(run), run.state.displacement.rows() / 2);
  ASSERT_TRUE(run.complete_stage());
  EXPECT_LT((run.state.displacement - before).cwiseAbs().maxCoeff(), of_solver * 0.3);
  EXPECT_LT((run.state.stress - stress).cwiseAbs().maxCoeff(), of_solver * pressure);
  EXPECT_NEAR(run.records.back().back().mean_pressure, pressure, of_solver * pressure);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  // True stress of clay in plane strain that is squeezed: 2 c over the width that it has.
  const double widened = 1.0 + before.col(0).maxCoeff();
  EXPECT_GT(run.records.back().back().mean_pressure, pressure);
  EXPECT_GT(widened, 1.3);
}

}  // namespace
}  // namespace verification

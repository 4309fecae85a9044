// Regions that become another material between stages.
#include <gtest/gtest.h>

#include <string>

#include "measure.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

// A column of two halves between smooth walls. Both are soft at first, and weightless; the lower
// one becomes stiffer, and heavier. Without Poisson's ratio its stiffness is Young's modulus.
constexpr double soft = 1e7, stiff = 4e7, half = 1.0, load = 100e3, weight = 25e3;

std::string column(const std::string& stages, const std::string& interfaces = "through",
                   const std::string& weights = "") {
  return R"(
[geometry]
spacing = 0.25
[approximation]
kinematics = "small_strain"
interfaces = ")" +
         interfaces + R"("
[[material]]
name = "soft"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.0
)" + weights +
         R"(
[[material]]
name = "stiff"
model = "elastic"
youngs_modulus = 4e7
poissons_ratio = 0.0
)" + (weights.empty() ? "" : "unit_weight = 25e3\n") +
         R"(
[[region]]
name = "lower"
material = "soft"
outline = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[region]]
name = "upper"
material = "soft"
outline = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[side]]
name = "walls"
kind = "roller"
along = [[0, 2], [0, 0], [1, 0], [1, 2]]
[[side]]
name = "top"
kind = "loaded"
live_pressure = 100e3
along = [[1, 2], [0, 2]]
[drive]
kind = "load"
scales = ["traction"]
[solver]
tolerance = 1e-9
[programme]
steps = 2
)" + stages;
}

// A body has weight in all its materials, or in none.
const std::string next_to_none = "unit_weight = 1.0\n";

// Of the topmost particles, half a spacing below the surface, which move as the middle of theirs.
double settlement(const StagedRun& run) {
  return -run.state.displacement.col(1).minCoeff();
}
constexpr double cover = 0.125;  // [m] above them

constexpr double of_solver = 1e-6;

TEST(Lining, BearsOnlyWhatComesAfterIt) {
  StagedRun run(scene_of(column(R"(
[[stage]]
name = "load"
to = 0.5
[[stage]]
name = "stiffen"
regions = ["lower"]
become = ["stiff"]
[[stage]]
name = "load on"
to = 1.0
)")));
  ASSERT_TRUE(run.complete_stage());
  const double first = 0.5 * load * (half + half - cover) / soft;
  EXPECT_NEAR(settlement(run), first, of_solver * first);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  EXPECT_NEAR(settlement(run), first, of_solver * first);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  const double second = 0.5 * load * ((half - cover) / soft + half / stiff);
  // Rows that go through smear the contrast over a spacing.
  EXPECT_NEAR(settlement(run), first + second, 0.01 * (first + second));
}

// Where materials are bodies of their own the two part, with springs on their common face: 100 E of
// the softer one over the spacing. What the face bore fades onto them.
TEST(Lining, IsABodyOfItsOwnThatIsTied) {
  StagedRun run(scene_of(column(R"(
[[stage]]
name = "load"
to = 0.5
[[stage]]
name = "stiffen"
regions = ["lower"]
become = ["stiff"]
[[stage]]
name = "load on"
to = 1.0
)",
                                "tied")));
  run.complete();
  const double springs = load * 0.25 / (100.0 * soft);
  const double settled =
      0.5 * load * ((half + half - 2.0 * cover) / soft + half / stiff + half / soft);
  EXPECT_NEAR(settlement(run), settled + springs, 1e-3 * settled);
}

TEST(Lining, ComesWithItsWeight) {
  StagedRun run(scene_of(column(R"(
[[stage]]
name = "exchange"
regions = ["lower"]
become = ["stiff"]
)",
                                "tied", next_to_none)));
  run.complete();
  // Weight is in lumps, of which those beside faces are half a cell off.
  const double settled = 0.5 * weight * half * half / stiff;
  EXPECT_NEAR(settlement(run), settled, 0.25 * 0.25 / (half * half) * settled);
}

// Backfill: what was dug comes back as another material.
TEST(Lining, MayComeInPlaceOfWhatWasDug) {
  StagedRun run(scene_of(column(R"(
[[stage]]
name = "dig"
remove = ["upper"]
[[stage]]
name = "fill"
place = ["upper"]
regions = ["upper"]
become = ["stiff"]
)",
                                "through", next_to_none)));
  run.complete();
  // The lower half settles under the upper one, which settles under itself and begins on it.
  const double settled = weight * half * half / soft + 0.5 * weight * half * half / stiff;
  EXPECT_NEAR(settlement(run), settled, 0.02 * settled);
}

}  // namespace
}  // namespace verification

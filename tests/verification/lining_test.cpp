// Regions that become another material between stages.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "measure.hpp"
#include "model/measures.hpp"
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

const std::string stiffened_under_load = R"(
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
)";

TEST(Lining, BearsOnlyWhatComesAfterIt) {
  StagedRun run(scene_of(column(stiffened_under_load)));
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

// What a bent body remembers of its shape against hourglass modes is forgotten by what is
// exchanged, not multiplied by the new stiffness.
TEST(Lining, MovesNothingWhereItComes) {
  StagedRun run(scene_of(R"(
[geometry]
spacing = 0.25
[approximation]
kinematics = "small_strain"
interfaces = "through"
[[material]]
name = "soft"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[material]]
name = "stiff"
model = "elastic"
youngs_modulus = 2e8
poissons_ratio = 0.3
[[region]]
name = "near"
material = "soft"
outline = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[region]]
name = "far"
material = "soft"
outline = [[2, 0], [4, 0], [4, 1], [2, 1]]
[[side]]
name = "wall"
kind = "fixed"
along = [[0, 1], [0, 0]]
[[side]]
name = "top"
kind = "loaded"
live_pressure = 10e3
along = [[4, 1], [0, 1]]
[[side]]
name = "below"
kind = "free"
along = [[0, 0], [4, 0], [4, 1]]
[drive]
kind = "load"
scales = ["traction"]
[solver]
tolerance = 1e-9
[programme]
steps = 1
[[stage]]
name = "bend"
to = 1.0
[[stage]]
name = "stiffen"
regions = ["near", "far"]
become = ["stiff", "stiff"]
)"));
  ASSERT_TRUE(run.complete_stage());
  const double bent = settlement(run);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  // What hourglass control bore, a few parts in a hundred of the load, is borne by the stiffer
  // beam.
  EXPECT_NEAR(settlement(run), bent, 0.01 * bent);
}

// Where materials are bodies of their own the two part, with springs on their common face: 100 E of
// the softer one over the spacing. What the face bore fades onto them.
TEST(Lining, IsABodyOfItsOwnThatIsTied) {
  StagedRun run(scene_of(column(stiffened_under_load, "tied")));
  run.complete();
  const double springs = load * 0.25 / (100.0 * soft);
  const double settled =
      0.5 * load * ((half + half - 2.0 * cover) / soft + half / stiff + half / soft);
  EXPECT_NEAR(settlement(run), settled + springs, 1e-3 * settled);
}

TEST(Lining, ComesWithItsWeight) {
  constexpr double spacing = 0.125;
  StagedRun run(scene_of(column(R"(
[[stage]]
name = "exchange"
regions = ["lower"]
become = ["stiff"]
)",
                                "tied", next_to_none),
                         {"geometry.spacing=0.125"}));
  run.complete();
  // Weight is in lumps, of which those beside faces are half a cell off.
  const double settled = 0.5 * weight * half * half / stiff;
  EXPECT_NEAR(settlement(run), settled, spacing * spacing / (half * half) * settled);
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

// A ring under pressures inside and outside in plane strain (Lame): how far a place moves outwards.
double moved_outwards(double r, double inner, double outer, double inside, double outside, double E,
                      double nu) {
  const double a = inner * inner, b = outer * outer;
  return (1.0 + nu) / E / (b - a) *
         ((1.0 - 2.0 * nu) * (inside * a - outside * b) * r + (inside - outside) * a * b / r);
}

// The rock has given way to 0.6 of what the core bore before the ring in it is concrete; the rest
// is borne by both, which move alike where they meet.
TEST(Lining, OfATunnelBearsWhatTheRockHasNotYetGivenWayTo) {
  constexpr double bore = 2.0, back = 2.4, far = 6.0, pressure = 1e6, before = 0.6;
  constexpr double rock = 500e6, of_rock = 0.25, concrete = 10e9, of_concrete = 0.2;
  const double pressed = -pressure * (1.0 + of_rock) * (1.0 - 2.0 * of_rock) / rock * bore;
  const double dug =
      pressed + moved_outwards(bore, bore, far, -before * pressure, 0.0, rock, of_rock);
  const double rest = -(1.0 - before) * pressure;
  const auto gap = [&](double between) {
    return moved_outwards(back, bore, back, rest, between, concrete, of_concrete) -
           moved_outwards(back, back, far, between, 0.0, rock, of_rock);
  };
  const double between = -gap(0.0) / (gap(1.0) - gap(0.0));
  const double lined = dug + moved_outwards(bore, bore, back, rest, between, concrete, of_concrete);
  StagedRun run(shipped_scene("lined_tunnel.toml"));
  const auto crown = [&] {
    const model::Measures<2> measures(run.stages.scene(), run.stages.model());
    return measures.of(run.state)[2];
  };
  constexpr double of_spacing = 0.005;  // 0.3 % with four particles through the ring
  for (const double expected : {pressed, dug, lined}) {
    ASSERT_TRUE(run.complete_stage());
    EXPECT_NEAR(crown(), expected, of_spacing * std::abs(expected));
    if (!run.stages.is_last()) run.stages.go_on(run.state);
  }
}

}  // namespace
}  // namespace verification

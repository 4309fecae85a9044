// Ground without cohesion that is not at rest under what is given is refused with the reason.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "limit/bracket/solve.hpp"
#include "limit/ground/ground_case.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scene.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A footing behind a face that falls by 2 m over a run, in soil of 30 degrees.
std::string bench(double cohesion, double run, const std::string& on_top, const char* sought) {
  return fmt::format(R"([load]
sought = "{2}"
[[material]]
name = "sand"
cohesion = {0}
friction_angle = 30
unit_weight = 18e3
[[region]]
material = "sand"
outline = [[0, -4], [12, -4], [12, -2], [{1}, -2], [4, 0], [2, 0], [0, 0]]
[[side]]
name = "top"
{3}
along = [[0, 0], [2, 0]]
[[side]]
name = "face"
kind = "free"
along = [[2, 0], [4, 0], [{1}, -2], [12, -2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, 0], [0, -4], [12, -4], [12, -2]]
)",
                     cohesion, 4.0 + run, sought, on_top);
}

std::string complaint(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

const std::string footing = "kind = \"footing\"";
const std::string loaded = "kind = \"loaded\"\npressure = 5e3";
const std::string live = "kind = \"loaded\"\nlive_pressure = 1";

// 2 / 3.47 is 29.96 degrees, 2 / 3.46 is 30.03.
TEST(BareSand, StandsNoSteeperThanItsFriction) {
  EXPECT_THAT(complaint(bench(0.0, 3.47, footing, "footing")), IsEmpty());
  EXPECT_THAT(complaint(bench(0.0, 3.46, footing, "footing")),
              AllOf(HasSubstr("side.1.kind: what is given lets a skin slide of sand, which has no "
                              "cohesion, off the side \"face\" at (5.73, -1)"),
                    HasSubstr("bare sand does not stand steeper than it has friction")));
  EXPECT_THAT(complaint(bench(10.0, 3.46, footing, "footing")), IsEmpty());
  // What its strength may be divided by is less than one, and an answer.
  EXPECT_THAT(complaint(bench(0.0, 2.0, "kind = \"free\"", "strength")), IsEmpty());
}

TEST(BareSand, BearsNoGivenPressureThatEndsBesideIt) {
  EXPECT_THAT(
      complaint(bench(0.0, 6.0, loaded, "strength")),
      AllOf(HasSubstr("side.0.pressure: found 5000, which ends at (2, 0) beside the bare side "
                      "\"face\" of sand, which has no cohesion"),
            HasSubstr("where nothing presses on sand it bears nothing")));
  EXPECT_THAT(complaint(bench(5.0, 6.0, loaded, "strength")), IsEmpty());
  EXPECT_THAT(complaint(bench(0.0, 6.0, live, "traction")), IsEmpty());
}

// The stress of the sand beside nothing is nothing, whatever its weight: so is what grows.
TEST(BareSand, BearsNothingThatGrowsAndEndsBesideIt) {
  const auto sand = case_of(bench(0.0, 6.0, live, "traction"));
  ASSERT_TRUE(sand);
  const bracket::Solution found = bracket::solution_of(sand->associated, {}, {});
  EXPECT_EQ(found.upper, 0.0);
  EXPECT_TRUE(found.bracket.attempts.empty());
  EXPECT_THAT(sand->associated.notes,
              testing::Contains(HasSubstr("ends at (2, 0) beside the bare side \"face\" of sand, "
                                          "which has no cohesion")));
  const auto bonded = case_of(bench(5.0, 6.0, live, "traction"));
  ASSERT_TRUE(bonded);
  EXPECT_FALSE(bonded->associated.known_upper);
  EXPECT_FALSE(case_of(bench(0.0, 6.0, footing, "footing"))->associated.known_upper);
}

// Half of a strip anchor, twice as deep as it is wide, that is pulled up through sand. What it
// lifts is the sand between planes that lean outwards by phi, gamma H (1 + H / B tan(phi)), as
// Murray & Geddes (1987) have it, a mechanism of associated soil.
TEST(BareSand, HoldsAStripAnchorBetweenBounds) {
  const std::string anchor = R"([load]
sought = "footing"
[[material]]
name = "sand"
friction_angle = 30
unit_weight = 1.0
[[region]]
material = "sand"
outline = [[0, 0], [3.5, 0], [3.5, 2], [0, 2]]
[[side]]
name = "anchor"
kind = "footing"
along = [[0, 0], [0.5, 0]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0.5, 0], [3.5, 0], [3.5, 2]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, 2]]
[[side]]
name = "surface"
kind = "free"
along = [[0, 2], [3.5, 2]]
)";
  const auto problem = case_of(anchor);
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, {}, {});
  const double exact = 2.0 * (1.0 + 2.0 * std::tan(std::numbers::pi / 6.0));
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, exact);
  EXPECT_LT(found.gap(), 0.02);  // as asked by default
  EXPECT_NEAR(*found.upper, exact, 0.02 * exact);
}

}  // namespace

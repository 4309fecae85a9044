// Supports of every method that end and begin in stages.
#include <gtest/gtest.h>

#include <string>

#include "staged_run.hpp"

namespace verification {
namespace {

constexpr double E = 1e7, nu = 0.3, p = 40e3, spacing = 0.125;
constexpr double plane_modulus = E / (1.0 - nu * nu);
constexpr double factor = 20.0;  // of the springs
// The solver leaves 1e-9 of forces in each of ten steps; stresses are worse by the condition.
constexpr double of_solver = 1e-6;

// A block of 1 m by 1 m between smooth sides, pressed from above; its right side is a prop's.
std::string block(const std::string& prop) {
  return R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "prop"
side = "right"
directions = ["x"]
)" + prop +
         R"(
[[traction]]
name = "p"
side = "top"
value = [0.0, -40e3]
[drive]
kind = "load"
scales = ["traction"]
[solver]
tolerance = 1e-9
)";
}

// Of plane strain under -p, with springs of k per area that give way by u at x = 1:
// sigma_x = -k u, u = sigma_x / E' + nu (1 + nu) / E p.
double across(double pressure) {
  const double k = factor * E / spacing;
  return -k * nu * (1.0 + nu) / E * pressure / (1.0 + k / plane_modulus);
}

void expect_stress(const StagedRun& run, double sigma_x, double sigma_y, bool touches = false) {
  // Under faces that touch a constant stress is not exact, in whatever stage they begin: 0.4 % off
  // in the particles at the ends of this one.
  const double each = touches ? 0.01 : of_solver, mean = touches ? 1e-3 : of_solver;
  EXPECT_NEAR(run.state.stress.row(0).mean(), sigma_x, mean * p);
  EXPECT_NEAR(run.state.stress.row(1).mean(), sigma_y, mean * p);
  for (Eigen::Index a = 0; a < run.state.stress.cols(); ++a) {
    EXPECT_NEAR(run.state.stress(0, a), sigma_x, each * p);
    EXPECT_NEAR(run.state.stress(1, a), sigma_y, each * p);
  }
}

class Springs : public ::testing::TestWithParam<const char*> {};

// A prop that comes under half of the load bears of the other half alone; taken away, nothing; and
// back once more it bears nothing until the load changes.
TEST_P(Springs, BearFromWhereTheyBeganUntilTheyEnd) {
  const bool touches = std::string(GetParam()).find("contact") != std::string::npos;
  StagedRun run(scene_of(block(GetParam()) + R"(
[[stage]]
name = "half"
to = 0.5
steps = 2
[[stage]]
name = "prop"
hold = ["prop"]
steps = 1
[[stage]]
name = "whole"
to = 1.0
steps = 2
[[stage]]
name = "release"
release = ["prop"]
steps = 2
[[stage]]
name = "prop again"
hold = ["prop"]
to = 1.5
steps = 2
)"));
  const auto next = [&] {
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage());
  };
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, 0.0, -0.5 * p);
  next();
  expect_stress(run, 0.0, -0.5 * p);
  next();
  expect_stress(run, across(0.5 * p), -p, touches);
  next();
  expect_stress(run, 0.0, -p);
  next();
  expect_stress(run, across(0.5 * p), -1.5 * p, touches);
}

// From the first, and again.
TEST_P(Springs, EndAndComeBack) {
  const bool touches = std::string(GetParam()).find("contact") != std::string::npos;
  StagedRun run(scene_of(block(GetParam()) + R"(
[[stage]]
name = "load"
to = 1.0
steps = 2
[[stage]]
name = "release"
release = ["prop"]
steps = 2
[[stage]]
name = "more"
hold = ["prop"]
to = 2.0
steps = 2
)"));
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, across(p), -p, touches);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, 0.0, -p);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, across(p), -2.0 * p, touches);
}

INSTANTIATE_TEST_SUITE_P(Methods, Springs,
                         ::testing::Values("method = \"penalty\"\npenalty_factor = 20.0\n",
                                           "method = \"contact\"\nstiffness_factor = 20.0\n"),
                         [](const auto& info) { return info.index == 0 ? "Penalty" : "Contact"; });

// One that only touches lets go of a body that draws back from where it was when it began.
TEST(Contact, ThatBeginsOpensWhereTheGroundDrawsBack) {
  StagedRun run(scene_of(block("method = \"contact\"\nstiffness_factor = 20.0\n") + R"(
[[stage]]
name = "load"
to = 1.0
steps = 2
[[stage]]
name = "less"
hold = ["prop"]
to = 0.5
steps = 2
)"));
  run.complete();
  expect_stress(run, 0.0, -0.5 * p);
}

}  // namespace
}  // namespace verification

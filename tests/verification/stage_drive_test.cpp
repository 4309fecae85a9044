// Stages with drives of their own: what was driven before stays where it is, or is let go.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "measure.hpp"
#include "model/measures.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

// Plane strain, sigma_x = -q given and eps_y = -d: sigma_y = -E' d - nu / (1 - nu) q with
// E' = E / (1 - nu^2), of a block of 1 m by 1 m. Stresses are the same everywhere, which the
// approximation has exactly.
constexpr double E = 1e7, nu = 0.3, q = 20e3, d = 2e-3;
constexpr double plane_modulus = E / (1.0 - nu * nu);
constexpr double by_q = nu / (1.0 - nu) * q;
// The solver leaves 1e-9 of forces in each of ten steps; stresses are worse by the condition.
constexpr double of_solver = 1e-6;

const std::string block = R"(
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
[[traction]]
name = "q"
side = "right"
value = [-20e3, 0.0]
[solver]
tolerance = 1e-9
)";

const std::string plate = R"(
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
lateral = "free"
width = 1.0
)";

double measured(const StagedRun& run, const std::string& column) {
  const model::Measures<2> measures(run.stages.scene(), run.stages.model());
  const auto& columns = measures.columns();
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) throw std::runtime_error("no column " + column);
  return measures.of(run.state)[static_cast<std::size_t>(at - columns.begin())];
}

void expect_stress(const StagedRun& run, double across, double down, double each = of_solver,
                   double mean = of_solver) {
  const double size = plane_modulus * d;
  EXPECT_NEAR(run.state.stress.row(0).mean(), across, mean * size);
  EXPECT_NEAR(run.state.stress.row(1).mean(), down, mean * size);
  for (Eigen::Index a = 0; a < run.state.stress.cols(); ++a) {
    EXPECT_NEAR(run.state.stress(0, a), across, each * size);
    EXPECT_NEAR(run.state.stress(1, a), down, each * size);
  }
}

// Under faces that touch a constant stress is not exact, in whatever stage they begin: 1.1 % off in
// the particles at the ends of this plate, 2e-5 in the mean.
constexpr double of_contact = 0.02, of_its_mean = 1e-3;

// Pressed; pressed from the side under the plate that stays; taken back; pressed on; let go.
TEST(StageDrives, HoldThePlateOfBeforeWhileAnotherLoadComesAndGoes) {
  StagedRun run(scene_of(block + "[drive]\nname = \"plate\"" + plate + R"(
[[stage]]
name = "press"
to = 0.002
steps = 2
[[stage]]
name = "push"
steps = 2
drive = { name = "side", kind = "load", scales = ["traction"] }
[[stage]]
name = "pull back"
to = 0.25
steps = 2
[[stage]]
name = "press on"
drive.name = "plate"
to = 0.003
steps = 2
[[stage]]
name = "let go"
release = ["plate"]
steps = 2
)"));
  const auto next = [&] {
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage());
  };
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, 0.0, -plane_modulus * d);
  next();
  expect_stress(run, -q, -plane_modulus * d - by_q);
  // The curve reports the plate that is held, where it is and what it bears.
  const auto& pushed = run.records.back().back();
  EXPECT_DOUBLE_EQ(pushed.settlement, d);
  EXPECT_DOUBLE_EQ(pushed.load_parameter, 1.0);
  EXPECT_EQ(pushed.increment, 0.0);
  EXPECT_NEAR(pushed.mean_pressure, plane_modulus * d + by_q, of_solver * plane_modulus * d);
  EXPECT_DOUBLE_EQ(measured(run, "plate_moved_m"), d);
  EXPECT_DOUBLE_EQ(measured(run, "side_load_parameter"), 1.0);
  next();
  expect_stress(run, -0.25 * q, -plane_modulus * d - 0.25 * by_q);
  next();
  expect_stress(run, -0.25 * q, -plane_modulus * 1.5 * d - 0.25 * by_q);
  EXPECT_DOUBLE_EQ(measured(run, "plate_moved_m"), 1.5 * d);
  EXPECT_DOUBLE_EQ(measured(run, "side_load_parameter"), 0.25);
  next();
  expect_stress(run, -0.25 * q, 0.0);
  EXPECT_EQ(measured(run, "plate_Ry_N_per_m"), 0.0);
}

// A plate that comes after the side was loaded lies on the ground as it then is, and bears nothing
// until it moves. Its springs, of k = factor E / spacing per area, are in series with the block.
TEST(StageDrives, BeginALaterPlateWhereTheGroundIs) {
  constexpr double factor = 1e3;
  constexpr double springs = factor * E / 0.125;  // [Pa/m]
  StagedRun run(scene_of(block + R"(
[drive]
kind = "load"
scales = ["traction"]
[[stage]]
name = "push"
to = 1.0
steps = 2
[[stage]]
name = "press"
steps = 2
[stage.drive]
name = "plate"
method = "contact"
tension = true
stiffness_factor = 1e3
target = 0.002)" + plate));
  ASSERT_TRUE(run.complete_stage());
  expect_stress(run, -q, 0.0);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  const double pressure = d / (1.0 / plane_modulus + 1.0 / springs);
  expect_stress(run, -q, -pressure, of_contact, of_its_mean);
  EXPECT_NEAR(run.records.back().back().mean_pressure, pressure, of_its_mean * pressure);
  EXPECT_NEAR(run.records.back().front().mean_pressure, 0.5 * pressure, of_its_mean * pressure);
}

// In small strain elastic ground is linear: what was put on and taken off again leaves nothing, be
// the plate one of particles that begins under weight.
TEST(StageDrives, LeaveElasticGroundAsItWasWhenAllIsTakenBack) {
  const std::string weight = "[gravity]\nacceleration = [0.0, -10.0]\n";
  const std::string first = R"(
[drive]
name = "weight"
kind = "load"
scales = ["gravity"]
[[stage]]
name = "weigh"
to = 1.0
steps = 2
)";
  const Settings heavy = {"material.0.density=2e3"};
  StagedRun run(scene_of(block + weight + first + R"(
[[stage]]
name = "press"
steps = 2
[stage.drive]
name = "strip"
kind = "displacement"
side = "top"
range_min = 0.0
range_max = 0.5
direction = [0.0, -1.0]
target = 0.002
width = 0.5
[[stage]]
name = "push"
steps = 2
drive = { name = "side", kind = "load", scales = ["traction"], loads = ["q"] }
[[stage]]
name = "off"
release = ["strip", "side"]
steps = 3
)",
                         heavy));
  ASSERT_TRUE(run.complete_stage());
  const fpm::Field<2> weighed = run.state.displacement;
  for (int s = 1; s < 4; ++s) {
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage()) << "stage " << s;
    const double moved = (run.state.displacement - weighed).cwiseAbs().maxCoeff();
    if (s < 3) {
      EXPECT_GT(moved, 0.9 * d);
    } else {
      EXPECT_LT(moved, 1e-5 * d);
    }
  }
}

// Two plates loaded one after the other: the force on the first stays while the second's grows.
// Each bears its force, whatever is under it.
TEST(StageDrives, KeepTheForceOnAPlateThatWasLoadedBefore) {
  StagedRun run(scene_of(block + R"(
[drive]
name = "one"
kind = "load"
scales = ["plate"]
method = "contact"
tension = true
side = "top"
range_min = 0.0
range_max = 0.375
force = [0.0, -3e3]
[[stage]]
name = "first"
to = 1.0
steps = 2
[[stage]]
name = "second"
steps = 2
[stage.drive]
name = "two"
kind = "load"
scales = ["plate"]
method = "contact"
tension = true
side = "top"
range_min = 0.625
range_max = 1.0
force = [0.0, -5e3]
[[stage]]
name = "first off"
release = ["one"]
drive.kind = "none"
steps = 2
)",
                         {"traction.0.value=[0.0, 0.0]"}));
  ASSERT_TRUE(run.complete_stage());
  EXPECT_NEAR(measured(run, "one_Ry_N_per_m"), -3e3, of_solver * 3e3);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  EXPECT_NEAR(measured(run, "one_Ry_N_per_m"), -3e3, of_solver * 3e3);
  EXPECT_NEAR(measured(run, "two_Ry_N_per_m"), -5e3, of_solver * 5e3);
  EXPECT_NEAR(measured(run, "base_Ry_N_per_m"), 8e3, 1e2 * of_solver * 8e3);
  run.stages.go_on(run.state);
  ASSERT_TRUE(run.complete_stage());
  EXPECT_NEAR(measured(run, "two_Ry_N_per_m"), -5e3, of_solver * 5e3);
  EXPECT_NEAR(measured(run, "base_Ry_N_per_m"), 5e3, 1e2 * of_solver * 5e3);
  EXPECT_EQ(measured(run, "one_Ry_N_per_m"), 0.0);
}

TEST(StageDrives, HaveColumnsOfTheirOwnWhateverTheyAreCalled) {
  const StagedRun run(scene_of(block + R"(
[gravity]
acceleration = [0.0, -10.0]
[drive]
name = "a b"
kind = "load"
scales = ["traction"]
[[stage]]
name = "push"
to = 1.0
steps = 1
[[stage]]
name = "press"
steps = 1
drive = { name = "a_b", kind = "load", scales = ["gravity"] }
)",
                               {"material.0.density=2e3"}));
  const model::Measures<2> measures(run.stages.scene(), run.stages.model());
  EXPECT_EQ(measures.columns()[1], "a_b_load_parameter");
  EXPECT_EQ(measures.columns()[2], "a_b_1_load_parameter");
}

// Without measures of its own the curve of a displacement has none, be it let go or not.
TEST(StageDrives, MeasureTheSameInEveryStage) {
  StagedRun run(scene_of(block + "[drive]" + plate + R"(
[[stage]]
name = "press"
to = 0.002
steps = 1
[[stage]]
name = "let go"
release = ["drive"]
steps = 1
)"));
  const auto columns = [&] {
    return model::Measures<2>(run.stages.scene(), run.stages.model()).columns();
  };
  const auto pressed = columns();
  ASSERT_TRUE(run.complete_stage());
  run.stages.go_on(run.state);
  EXPECT_EQ(columns(), pressed);
}

}  // namespace
}  // namespace verification

// Runs in stages: there and back, and with their strength divided.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "measure.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

const std::string box = R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 2.0]
spacing = 0.125
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
width = 1.0
[[stage]]
name = "there"
to = 0.02
steps = 4
[[stage]]
name = "back"
to = -0.01
steps = 6
[[stage]]
name = "home"
to = 0.0
steps = 2
[solver]
tolerance = 1e-9
)";
const std::string elastic = R"(
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.3
)";

// The work of the plate by the trapezoidal rule, which is exact where forces are linear.
double work_of(const StagedRun& run) {
  double work = 0.0, force = 0.0, place = 0.0;
  for (const auto& stage : run.records) {
    for (const auto& row : stage) {
      work += 0.5 * (force + row.reaction) * (row.settlement - place);
      force = row.reaction;
      place = row.settlement;
    }
  }
  return work;
}

// In small strain an elastic body is linear: pushed, pulled beyond where it was and brought back,
// it is as it was. What is left is that of the solver, 1e-9 of forces in each of 12 steps.
TEST(ElasticCycle, GivesBackItsEnergyAndItsState) {
  constexpr double of_solver = 12 * 1e-9 * 100;  // displacements are worse by the condition
  StagedRun run(scene_of(elastic + box, {"approximation.kinematics=\"small_strain\""}));
  run.complete();
  ASSERT_EQ(run.records.size(), 3U);
  const double stiffness = run.records[0].front().reaction / run.records[0].front().settlement;
  const double most = 0.5 * stiffness * 0.02 * 0.02;
  EXPECT_LT(std::abs(work_of(run)), of_solver * most);
  EXPECT_EQ(run.records.back().back().settlement, 0.0);
  EXPECT_LT(run.state.displacement.cwiseAbs().maxCoeff(), of_solver * 0.02);
  EXPECT_LT(run.state.stress.cwiseAbs().maxCoeff(), of_solver * 0.01 * 1e6);
  // The same slope there, back and beyond.
  for (const auto& stage : run.records) {
    for (const auto& row : stage) {
      EXPECT_NEAR(row.reaction, stiffness * row.settlement, of_solver * stiffness * 0.02);
    }
  }
  EXPECT_LT(run.records[1].back().reaction, 0.0);
}

TEST(FootingCycle, UnloadsElasticallyAndReloadsToWhereItWas) {
  StagedRun run(shipped_scene("footing_cycle.toml"));
  run.complete();
  ASSERT_EQ(run.records.size(), 3U);
  const auto& load = run.records[0];
  const auto& unload = run.records[1];
  const auto& reload = run.records[2];
  const auto pressure_at = [](const std::vector<stepping::StepRecord>& rows, double settlement) {
    std::vector<std::vector<double>> curve;
    for (const auto& row : rows) curve.push_back({row.settlement, row.mean_pressure});
    return interpolated(curve, settlement);
  };

  // Unloading is elastic, but for a few particles at the plate's end, where stress is singular: the
  // slope of the same ground with a strength that it never uses. The solver leaves 1e-3 of the
  // forces open at either end.
  StagedRun strong(shipped_scene("footing_cycle.toml", {"material.0.cohesion=1e9"}));
  ASSERT_TRUE(strong.complete_stage());
  const double elastic_slope =
      strong.records[0].back().mean_pressure / strong.records[0].back().settlement;
  const double fall = load.back().mean_pressure - unload.back().mean_pressure;
  const double slope = fall / (load.back().settlement - unload.back().settlement);
  report("elastic_slope_kPa_per_m", 1e-3 * elastic_slope);
  report("unloading_slope_kPa_per_m", 1e-3 * slope);
  EXPECT_NEAR(slope, elastic_slope, 2e-3 * load.back().mean_pressure / fall * elastic_slope);
  for (const auto& row : unload)
    EXPECT_LT(row.plastic_particles, load.back().plastic_particles / 5);

  // Where it was left it bears what it did, and then the plateau of a run in one go.
  constexpr double of_steps = 0.01;  // two runs of other steps, 1e-3 of solver in each
  EXPECT_NEAR(pressure_at(reload, load.back().settlement), load.back().mean_pressure,
              of_steps * load.back().mean_pressure);
  StagedRun at_once(shipped_scene("footing_cycle.toml",
                                  {"stage.0.to=0.09", "stage.0.steps=30", "drive.target=0.09"}));
  ASSERT_TRUE(at_once.complete_stage());
  EXPECT_NEAR(reload.back().mean_pressure, at_once.records[0].back().mean_pressure,
              of_steps * reload.back().mean_pressure);
  report("plateau_over_c", reload.back().mean_pressure / 1e3);
  EXPECT_NEAR(reload.back().mean_pressure, (2.0 + M_PI) * 1e3, 0.025 * (2.0 + M_PI) * 1e3);
}

// A weightless block that bears q over a free side: q = 2 c' tan(45 + phi'/2) where the factor is
// reached, c' = c / F and tan(phi') = tan(phi) / F.
double factor_of_block(double cohesion, double phi_degrees, double q) {
  const double tangent = std::tan(phi_degrees * M_PI / 180.0);
  double low = 0.1, high = 100.0;
  for (int i = 0; i < 100; ++i) {
    const double F = 0.5 * (low + high);
    const double phi = std::atan(tangent / F);
    (2.0 * cohesion / F * std::tan(M_PI / 4.0 + phi / 2.0) > q ? low : high) = F;
  }
  return low;
}

TEST(StrengthReduction, OfABlockEndsAtItsFactor) {
  for (const double phi : {0.0, 25.0}) {
    std::ostringstream angle;
    angle << "friction_angle = " << phi << "\ndilation_angle = " << phi << '\n';
    StagedRun run(scene_of(R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "clay"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 40e3
)" + angle.str() + R"([[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[traction]]
name = "q"
side = "top"
value = [0.0, -50e3]
[drive]
kind = "strength"
target = 4.0
[programme]
steps = 30
)"));
    const double factor = factor_of_block(40e3, phi, 50e3);
    EXPECT_FALSE(run.complete_stage());
    const double reached = 1.0 + 3.0 * run.state.programme.progress;
    report("factor_reached_over_exact", reached / factor);
    // The last steps are a thousandth of the nominal one; 1e-3 of forces are left open.
    EXPECT_NEAR(reached, factor, 0.01 * factor) << "phi = " << phi;
  }
}

// Of two blocks only the one that is named grows weaker.
TEST(StrengthReduction, IsOfNamedMaterialsAlone) {
  const std::string text = R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.125
[[material]]
name = "a"
model = "von_mises"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 40e3
[[material]]
name = "b"
model = "von_mises"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 40e3
region_min = [0.0, 0.5]
region_max = [1.0, 1.0]
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[drive]
kind = "strength"
target = 2.0
weakened = ["b"]
[programme]
steps = 2
)";
  const TestScene scene = scene_of(text);
  const stepping::StagedModel<2> stages(scene);
  ASSERT_EQ(stages.model().reduced_laws.size(), 1U);
  EXPECT_EQ(stages.model().reduced_laws[0].law, 1);
}

}  // namespace
}  // namespace verification

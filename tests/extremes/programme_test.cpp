// Load programmes that ask too much or nothing: a cut, a report, never a NaN.

#include "scene/reader.hpp"
#include "small_footing.hpp"

namespace extremes {
namespace {

Settings footing_with(const Settings& more) {
  Settings settings = small_footing();
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

// 15 % of B in one nominal step, eight times the strain at yield: cut back, and of the same load.
TEST(Programme, CutsAHugeFirstStep) {
  PlaneRun run(verification::shipped_scene(
      "footing.toml", footing_with({"drive.target=0.033", "programme.steps=1"})));
  const auto first = run.stepper.advance();
  ASSERT_EQ(first.outcome, stepping::StepOutcome::converged);
  EXPECT_GT(first.record.cuts, 0);
  EXPECT_LT(first.record.load_parameter, 1.0);
  EXPECT_GT(first.record.mean_pressure, 0.0);
  expect_finite(run);
}

// Where no cut is allowed, the failure is a report and the state is the last good one.
TEST(Programme, ReportsAStepThatMayNotBeCutAndKeepsTheState) {
  PlaneRun run(verification::shipped_scene(
      "footing.toml", footing_with({"drive.target=0.3", "programme.steps=1",
                                    "programme.minimum_increment_ratio=1.0"})));
  const Eigen::MatrixXd stress = run.state.stress;
  const auto result = run.stepper.advance();
  EXPECT_EQ(result.outcome, stepping::StepOutcome::minimum_increment);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_GT(result.residual.norm(), 0.0);
  EXPECT_EQ(run.state.programme.step, 0);
  EXPECT_EQ(run.state.stress, stress);
  EXPECT_EQ(run.state.displacement.norm(), 0.0);
  expect_finite(run);
}

// A drive of a picometre: the soil stays where it is, up to the drift of its initial stress.
TEST(Programme, OfNearlyNothingMovesNothing) {
  PlaneRun run(verification::shipped_scene("footing.toml", footing_with({"drive.target=1e-12"})));
  const Steps steps = run.complete();
  ASSERT_FALSE(steps.empty());
  // First-order drift, dx / H at each of two faces, of the weight's settlement rho g H^2 / (2 M).
  const double confined = 50e6 * 0.6 / (1.4 * 0.2);
  const double drift = 2.0 * 0.02 / 0.66 * 1850.0 * 9.81 * 0.66 * 0.66 / (2.0 * confined);
  EXPECT_LT(steps.back().max_displacement, drift);
  EXPECT_EQ(steps.back().cuts, 0);
}

TEST(Programme, OfNothingIsRefused) {
  const Settings nothing = {"drive.target=0"};
  const auto reading =
      scene::read_scene(std::filesystem::path(FPM_SCENES) / "footing.toml", nothing);
  ASSERT_FALSE(reading.scene);
  EXPECT_NE(reading.errors[0].text().find("drive.target"), std::string::npos);
}

// Nothing loads this body: its step is converged at its first evaluation. (Without pair forces,
// whose round-off of coordinates would be all there is to converge against.)
TEST(Programme, WithoutAnyLoadIsConvergedAtOnce) {
  const std::string scene = R"(
[geometry]
dimension = 2
min = [0.0, -1.0]
max = [1.0, 0.0]
spacing = 0.1
[hourglass]
control = "none"
[[material]]
name = "soil"
model = "von_mises"
youngs_modulus = 50e6
poissons_ratio = 0.3
cohesion = 2.5e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
)";
  PlaneRun run(verification::scene_of(scene));
  const auto result = run.stepper.advance();
  ASSERT_EQ(result.outcome, stepping::StepOutcome::converged);
  EXPECT_EQ(result.record.max_displacement, 0.0);
  EXPECT_EQ(result.record.newton_iterations, 0);
  // The one of the first step's predictor, on the prescribed displacements.
  EXPECT_EQ(result.record.jacobian_actions, 1);
  expect_finite(run);
}

// Pulled up, the soil below the plate tears at the cone's apex.
TEST(Apex, HoldsAPullAtTheTensileStrength) {
  PlaneRun run(
      verification::shipped_scene("footing.toml", footing_with({"drive.direction=[0.0, 1.0]"})));
  const Steps steps = run.complete();
  ASSERT_FALSE(steps.empty());
  // Isotropic tension stops at c cot(phi) = 6.87 kPa; weight and geostatic stress of the mobilised
  // soil, of depth up to B, add rho g B at most, and the shear around it its cohesion.
  const double apex = 2.5e3 / std::tan(20.0 * M_PI / 180.0);
  const double weight = 1850.0 * 9.81 * 0.22;
  report("pull_over_apex", steps.back().mean_pressure / apex);
  EXPECT_GT(steps.back().mean_pressure, 0.5 * apex);
  EXPECT_LT(steps.back().mean_pressure, apex + weight + 2.5e3);
  double highest = 0.0;
  for (Eigen::Index a = 0; a < run.model.size(); ++a) {
    highest = std::max(highest, run.state.stress.col(a).head<3>().sum() / 3.0);
  }
  report("highest_mean_stress_over_apex", highest / apex);
  constexpr double round_off = 1e-12;
  EXPECT_LT(highest, apex * (1.0 + round_off));
  expect_finite(run);
}

}  // namespace
}  // namespace extremes

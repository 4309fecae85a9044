// A smooth wall before level sand, against Rankine.

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <string>

#include "measure.hpp"
#include "run.hpp"
#include "stepping/settle.hpp"

namespace verification {
namespace {

// Two metres of sand of 20 kN/m3 on a smooth base, phi = 30: K_a = 1/3, K_p = 3.
const std::string sand = R"(
[geometry]
min = [0, 0]
max = [8, 2]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "sand"
model = "mohr_coulomb"
youngs_modulus = 2e7
poissons_ratio = 0.3
cohesion = 0.0
friction_angle = 30
dilation_angle = 30
unit_weight = 20e3
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "far side"
side = "right"
directions = ["x"]
[initial_stress]
kind = "geostatic"
K0 = 0.5
[drive]
kind = "displacement"
side = "left"
direction = [-1.0, 0.0]
lateral = "free"
target = 0.02
width = 2.0
[programme]
steps = 20
)";
constexpr double dry = 20e3, height = 2.0;

double pressure_on_wall(const Settings& settings) {
  const TestScene scene = scene_of(sand, settings);
  const model::Model<2> model = stepping::model_at_rest<2>(scene);
  model::State<2> state = model::initial_state(model);
  stepping::LoadStepper<2> stepper(scene, model, state);
  double pressure = 0.0;
  while (!stepper.finished()) {
    const stepping::StepResult result = stepper.advance();
    EXPECT_EQ(result.outcome, stepping::StepOutcome::converged) << result.reason;
    if (result.outcome != stepping::StepOutcome::converged) break;
    pressure = result.record.mean_pressure;
  }
  return pressure;
}

struct Wall {
  const char* name;
  double coefficient, unit_weight;  // of the mean pressure, < 0 against the drive
  double tolerance;                 // what the linear stress is off, 16 particles to the height
  Settings settings;
  friend std::ostream& operator<<(std::ostream& out, const Wall& wall) { return out << wall.name; }
};

class WallBeforeSand : public testing::TestWithParam<Wall> {};

TEST_P(WallBeforeSand, BearsWhatRankineSays) {
  const Wall& wall = GetParam();
  const double exact = wall.coefficient * wall.unit_weight * 0.5 * height;
  const double found = pressure_on_wall(wall.settings);
  report("over_exact", found / exact);
  EXPECT_NEAR(found / exact, 1.0, wall.tolerance);
}

// A wall that has hardly moved, by 1e-6 of the height, bears K0: E / (gamma H) times that is off.
const Settings at_rest{"drive.target=2e-6", "programme.steps=1"};
const Settings pushed{"drive.direction=[1.0,0.0]", "drive.target=0.15"};

Settings with(Settings settings, const char* more) {
  settings.emplace_back(more);
  return settings;
}

INSTANTIATE_TEST_SUITE_P(
    All, WallBeforeSand,
    testing::Values(
        Wall{"AtRest", -0.5, dry, 1e-3, at_rest},
        Wall{"AtRestOnceSettled", -0.5, dry, 1e-3, with(at_rest, "initial_stress.kind=gravity")},
        Wall{"ThatGivesWay", -1.0 / 3.0, dry, 0.003, {}},
        Wall{"ThatGivesWayOnceSettled", -1.0 / 3.0, dry, 0.003, {"initial_stress.kind=gravity"}},
        Wall{"ThatGivesWayBeforeACone", -1.0 / 3.0, dry, 0.01, {"material.0.model=drucker_prager"}},
        // The water presses besides.
        Wall{"ThatGivesWayUnderWater",
             -1.0 / 3.0,
             dry - 10e3,
             0.003,
             {"water.table=[[0,2],[8,2]]", "water.unit_weight=10e3"}},
        Wall{"ThatIsPushed", 3.0, dry, 0.003, pushed},
        Wall{"ThatOnlyTouches", -1.0 / 3.0, dry, 0.003, {"drive.method=contact"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace verification

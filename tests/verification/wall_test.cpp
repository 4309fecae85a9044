// A smooth wall before level sand, against Rankine.

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <string>

#include "measure.hpp"
#include "model/measures.hpp"
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

double pressure_on_plate(const TestScene& scene) {
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
  const double found = pressure_on_plate(scene_of(sand, wall.settings));
  report("over_exact", found / exact);
  EXPECT_NEAR(found / exact, 1.0, wall.tolerance);
}

// A wall that has hardly moved, by 1e-6 of the height, bears K0: E / (gamma H) times that is off.
const Settings at_rest{"drive.target=2e-6", "programme.steps=1"};
const Settings pushed{"drive.direction=[1.0,0.0]", "drive.target=0.15"};

constexpr const char* direct = "drive.method=direct";

Settings with(Settings settings, const char* more) {
  settings.emplace_back(more);
  return settings;
}

INSTANTIATE_TEST_SUITE_P(
    All, WallBeforeSand,
    testing::Values(
        Wall{"AtRest", -0.5, dry, 1e-3, at_rest},
        Wall{"AtRestOnceSettled", -0.5, dry, 1e-3, with(at_rest, "initial_stress.kind=gravity")},
        Wall{"AtRestOnceSettledAlongAllOfItsSide", -0.5, dry, 1e-3,
             with(with(with(at_rest, "initial_stress.kind=gravity"), "drive.range_min=[0]"),
                  "drive.range_max=[2]")},
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
        // Whose particles are moved themselves.
        Wall{"AtRestByParticles", -0.5, dry, 1e-3, with(at_rest, direct)},
        Wall{"AtRestByParticlesOnceSettled", -0.5, dry, 1e-3,
             with(with(at_rest, direct), "initial_stress.kind=gravity")},
        Wall{"ByParticlesThatGivesWay", -1.0 / 3.0, dry, 0.003, {direct}},
        Wall{"ByParticlesThatGivesWayOnceSettled",
             -1.0 / 3.0,
             dry,
             0.003,
             {direct, "initial_stress.kind=gravity"}},
        Wall{"ByParticlesThatGivesWayAsAVertexLattice",
             -1.0 / 3.0,
             dry,
             0.003,
             {direct, "geometry.layout=vertex"}},
        Wall{"ByParticlesThatIsPushed", 3.0, dry, 0.003, with(pushed, direct)},
        Wall{"ThatOnlyTouches", -1.0 / 3.0, dry, 0.003, {"drive.method=contact"}}),
    [](const auto& info) { return info.param.name; });

// Before the first step: K0 on the wall, the weight on the base, to round-off.
TEST(Wall, BearsGroundAtRestInTheFirstRow) {
  for (const char* method : {"drive.method=ghosts", direct}) {
    const TestScene scene = scene_of(sand, {method});
    const model::Model<2> model = stepping::model_at_rest<2>(scene);
    model::State<2> state = model::initial_state(model);
    stepping::LoadStepper<2> stepper(scene, model, state);
    const double found = stepper.at_rest().mean_pressure;
    EXPECT_NEAR(found, -0.5 * dry * 0.5 * height, 1e-9 * dry * height) << method;
    EXPECT_NEAR(state.reaction.col(1).sum(), dry * height * 8.0, 1e-9 * dry * height * 8.0);
  }
}

// Of a wall that slides along the ground, and is held across, by its particles as by its images.
TEST(Wall, ThatMovesAlongItselfIsPressedByGroundAtRest) {
  const auto pressed = [](const std::string& method) {
    const TestScene scene =
        scene_of(sand + "[[measure]]\nname = \"wall\"\nkind = \"resultant\"\nside = \"left\"\n",
                 {method, "drive.direction=[0,-1]", "drive.lateral=fixed", "drive.target=1e-4",
                  "drive.range_min=[0.25]", "drive.range_max=[2]", "drive.width=1.75",
                  "material.0.cohesion=1e6"});
    const model::Model<2> model = stepping::model_at_rest<2>(scene);
    model::State<2> state = model::initial_state(model);
    stepping::LoadStepper<2> stepper(scene, model, state);
    EXPECT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged);
    const model::Measures<2> measures(scene, model);
    EXPECT_EQ(measures.columns().front(), "wall_Fx_N_per_m");
    return measures.of(state).front();
  };
  const double by_particles = pressed(direct), by_images = pressed("drive.method=ghosts");
  report("over_images", by_particles / by_images);
  EXPECT_NEAR(by_particles, by_images, 0.1 * by_images);  // they end half a spacing apart
}

// A support that holds along the wall alone leaves it to the wall to bear what presses across: on a
// smooth base as much as the far side does. The ground is too strong to yield.
TEST(Wall, ThatIsRoughBearsSandThatHasSettled) {
  const std::string more = R"(
[[support]]
name = "rough"
side = "left"
directions = ["y"]
method = "direct"
[[measure]]
name = "far"
kind = "reaction"
support = "far side"
)";
  std::string text = sand + more;
  text.erase(text.find("K0 = 0.5\n"), 9);
  const TestScene scene = scene_of(
      text, with(with(with(with(at_rest, "initial_stress.kind=gravity"), "drive.method=ghosts"),
                      "material.0.cohesion=1e6"),
                 "geometry.spacing=0.25"));
  const model::Model<2> model = stepping::model_at_rest<2>(scene);
  model::State<2> state = model::initial_state(model);
  stepping::LoadStepper<2> stepper(scene, model, state);
  const stepping::StepResult result = stepper.advance();
  ASSERT_EQ(result.outcome, stepping::StepOutcome::converged) << result.reason;
  const model::Measures<2> measures(scene, model);
  ASSERT_EQ(measures.columns().front(), "far_Rx_N_per_m");
  const double far = measures.of(state).front() / height;
  const double found = result.record.mean_pressure;
  EXPECT_LT(far, -0.3 * dry * 0.5 * height);
  report("over_far_side", found / far);
  EXPECT_NEAR(found / far, 1.0, 1e-3);
}

TEST(Wall, AlongPartOfItsSideDoesNotHoldSandThatSettles) {
  try {
    (void)stepping::model_at_rest<2>(
        scene_of(sand, {"initial_stress.kind=gravity", "drive.range_min=[0]", "drive.range_max=[1]",
                        "drive.width=1"}));
    FAIL();
  } catch (const stepping::DoesNotSettle& failure) {
    EXPECT_NE(std::string(failure.what())
                  .find("while the plate of the drive does not hold its side, the left"),
              std::string::npos)
        << failure.what();
  }
}

// Rock without weight between rollers, under 100 kPa from above and from the side that is driven.
const std::string cell = R"(
[geometry]
min = [0, 0]
max = [2, 1]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "far"
side = "left"
directions = ["x"]
[[traction]]
name = "above"
side = "top"
value = [0, -100e3]
[[traction]]
name = "beside"
side = "right"
value = [-100e3, 0]
[initial_stress]
kind = "gravity"
[drive]
kind = "displacement"
side = "right"
direction = [-1.0, 0.0]
lateral = "free"
target = 0.002
width = 1.0
[programme]
steps = 2
[solver]
tolerance = 1e-6
)";

// It begins under what presses on it, and resists with E / (1 - nu^2) times the strain: what a
// linear field is on particles, exact but for the solver's tolerance.
TEST(Wall, ThatIsPressedFromTheStartBearsNothingAtFirst) {
  const TestScene scene = scene_of(cell);
  const model::Model<2> model = stepping::model_at_rest<2>(scene);
  EXPECT_NEAR(model.initial_stress.row(0).minCoeff(), -100e3, 1.0);
  EXPECT_NEAR(model.initial_stress.row(0).maxCoeff(), -100e3, 1.0);
  EXPECT_NEAR(model.initial_stress.row(1).minCoeff(), -100e3, 1.0);
  const double exact = 1e7 / (1.0 - 0.3 * 0.3) * 0.002 / 2.0;
  const double found = pressure_on_plate(scene);
  report("over_exact", found / exact);
  EXPECT_NEAR(found / exact, 1.0, 1e-3);
}

// Nor does ground without weight press on one that it settles beside.
TEST(Wall, BesideGroundWithoutWeightBearsNothingAtFirst) {
  std::string text = cell;
  const std::string pressed =
      "[[traction]]\nname = \"beside\"\nside = \"right\"\nvalue = [-100e3, 0]\n";
  text.erase(text.find(pressed), pressed.size());
  const model::Model<2> model = stepping::model_at_rest<2>(scene_of(text));
  EXPECT_NEAR(model.initial_stress.row(0).cwiseAbs().maxCoeff(), 0.0, 1.0);
}

// Two metres of 20 kN/m3 on a base that moves up by next to nothing.
TEST(Wall, ThatIsABaseBearsTheWeight) {
  const std::string text = R"(
[geometry]
min = [0, 0]
max = [4, 2]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
unit_weight = 20e3
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "right"
side = "right"
directions = ["x"]
[initial_stress]
kind = "geostatic"
[drive]
kind = "displacement"
side = "bottom"
direction = [0, 1]
lateral = "free"
target = 1e-7
width = 4.0
[programme]
steps = 1
)";
  const double found = pressure_on_plate(scene_of(text)), exact = 20e3 * 2.0;
  report("over_exact", found / exact);
  EXPECT_NEAR(found / exact, 1.0, 1e-3);
}

}  // namespace
}  // namespace verification

// Ground under water in space: the table, and what is told of the pressure, is the same along z.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "measure.hpp"
#include "run.hpp"
#include "solid_column.hpp"
#include "staged_run.hpp"
#include "stepping/settle.hpp"

namespace verification {
namespace {

std::string sand(double unit_weight, double saturated) {
  return fmt::format(
      "[[material]]\nname = \"sand\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = 1e7\n"
      "poissons_ratio = 0.3\ncohesion = 2e3\nfriction_angle = 30\ndilation_angle = 10\n"
      "unit_weight = {}\n{}",
      unit_weight, saturated > 0.0 ? fmt::format("saturated_unit_weight = {}\n", saturated) : "");
}

// A quarter of a square footing on level ground.
const std::string quarter = R"([geometry]
dimension = 3
min = [0.0, -1.0, 0.0]
max = [1.5, 0.0, 1.5]
spacing = 0.25
[[symmetry]]
axis = "x"
position = 0.0
[[symmetry]]
axis = "z"
position = 0.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y", "z"]
[[support]]
name = "right"
side = "right"
directions = ["x"]
[[support]]
name = "back"
side = "back"
directions = ["z"]
[approximation]
kinematics = "small_strain"
[initial_stress]
kind = "geostatic"
[drive]
kind = "displacement"
side = "top"
range_min = [0.0, 0.0]
range_max = [0.5, 0.5]
direction = [0.0, -1.0, 0.0]
target = 0.01
width = 0.25
[programme]
steps = 4
[solver]
tolerance = 1e-6
)";

// Level ground under water, however deep, is ground of the buoyant weight: the same curve, to the
// tolerance, as in the plane.
TEST(SolidGroundUnderWater, BearsWhatGroundAsLightAsThatDoes) {
  const auto curve = [](const std::string& text) {
    verification::Run<3> run(scene_of(quarter + text));
    return run.complete();
  };
  const auto dry = curve(sand(10e3, 0.0));
  for (const char* water : {"table = [[0, 0], [1.5, 0]]", "table = [[0, 9], [1.5, 9]]",
                            "pore_pressure = { at = [0, 0], value = 0, gradient = [0, -10e3] }"}) {
    const auto wet = curve(sand(17e3, 20e3) + "[water]\n" + water +
                           (water[0] == 't' ? "\nunit_weight = 10e3\n" : "\n"));
    ASSERT_EQ(wet.size(), dry.size()) << water;
    for (std::size_t i = 0; i < dry.size(); ++i) {
      EXPECT_NEAR(wet[i].mean_pressure, dry[i].mean_pressure, 1e-6 * dry[i].mean_pressure) << water;
    }
  }
}

// A prism of a slope of 1 : 2 between smooth ends.
const std::string slope = R"([geometry]
dimension = 3
depth = [0, 1]
spacing = 0.25
[[region]]
material = "sand"
outline = [[0, 0], [6, 0], [6, 1], [5, 1], [2, 2.5], [0, 2.5]]
[[side]]
name = "left"
kind = "roller"
along = [[0, 2.5], [0, 0]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [6, 0]]
[[side]]
name = "right"
kind = "roller"
along = [[6, 0], [6, 1]]
[[side]]
name = "surface"
kind = "free"
along = [[6, 1], [5, 1], [2, 2.5], [0, 2.5]]
[[support]]
name = "front"
side = "front"
directions = ["z"]
[[support]]
name = "back"
side = "back"
directions = ["z"]
[approximation]
kinematics = "small_strain"
[initial_stress]
kind = "gravity"
)";

TEST(SolidGroundUnderWater, IsAtRestOnceItHasSettled) {
  for (const char* water :
       {"table = [[0, 2], [5, 1], [6, 1]]\nunit_weight = 10e3\n", "r_u = 0.2\n"}) {
    for (const std::string grading :
         {"", "[grading]\nenabled = true\ngrowth = 0.5\ncoarsest = 0.5\n"}) {
      const TestScene scene = scene_of(slope + sand(17e3, 0.0) + "[water]\n" + water + grading);
      const model::Model<3> model = stepping::model_at_rest<3>(scene);
      model::State<3> state = model::initial_state(model);
      stepping::LoadStepper<3> stepper(scene, model, state);
      EXPECT_EQ(model.cells.graded(), !grading.empty());
      EXPECT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged) << water;
      EXPECT_LT(state.displacement.cwiseAbs().maxCoeff(), 1e-9) << water;
    }
  }
}

// Under water to its top.
const std::string column = solid_column::scene + R"(
[water]
unit_weight = 10e3
table = [[0, 6], [1, 6]]
[solver]
tolerance = 1e-6
[[stage]]
name = "drain"
water_table = [[0, 0], [1, 0]]
steps = 2
)";

// The stress that water bore, gamma_w (h - y), goes to the grains: the column settles by
// gamma_w (h^2 - (h - y)^2) / (2 E_oed). Lumps of weight are so to second order (of them no
// more than half a cell's is missing anywhere).
TEST(SolidGroundUnderWater, SettlesByTheWeightThatItNoLongerDisplaces) {
  constexpr double water = 10e3, h = 6.0;
  constexpr double most = water * h * h / (2.0 * solid_column::oedometric);
  std::vector<double> errors;
  for (const double spacing : {0.25, 0.125}) {
    StagedRunIn<3> run(scene_of(column, {fmt::format("geometry.spacing={}", spacing)}));
    ASSERT_TRUE(run.complete_stage());
    double displacement = 0.0, stress = 0.0;
    for (Eigen::Index a = 0; a < run.state.displacement.rows(); ++a) {
      const double left = h - run.stages.model().particles.position(a, 1);
      const double exact = -water * (h * h - left * left) / (2.0 * solid_column::oedometric);
      displacement = std::max(displacement, std::abs(run.state.displacement(a, 1) - exact));
      stress = std::max(stress, std::abs(run.state.stress(1, a) + solid_column::weight * left));
    }
    errors.push_back(displacement / most);
    report(fmt::format("error_over_settlement_at_{}", spacing), errors.back());
    EXPECT_LT(errors.back(), 0.5 * spacing / h);
    EXPECT_LT(stress, 0.5 * spacing * solid_column::weight);
  }
  EXPECT_LT(errors[1], 0.3 * errors[0]);
}

}  // namespace
}  // namespace verification

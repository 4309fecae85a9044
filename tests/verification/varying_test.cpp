// Strength, stiffness and weight that change from place to place.

#include <cmath>
#include <numbers>

#include "limit_load.hpp"
#include "stepping/settle.hpp"

namespace verification {
namespace {

// Between smooth platens every fibre is strained alike, and bears by itself what it can.
const std::string platens = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 2.0]
spacing = 0.125
layout = "vertex"
[approximation]
kinematics = "small_strain"
consistency = "on"
[[material]]
name = "block"
model = "von_mises"
youngs_modulus = { at = [0.5, 7], value = 1e6, gradient = [0, 0] }
poissons_ratio = 0.0
cohesion = { at = [0.5, 7], value = 1e3, gradient = [0, 0] }
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
method = "direct"
[[support]]
name = "middle"
at = [0.5, 0.0]
directions = ["x"]
method = "direct"
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
lateral = "free"
method = "direct"
target = 1e-3
width = 1.0
[programme]
steps = 4
[solver]
tolerance = 1e-9
max_evaluations_per_step = 4000
)";

// Without Poisson's ratio, which would bend it, sigma_yy = E(x) strain. A stress that is linear is
// not quite in balance on the particles beside the faces, which they make up for at first order.
TEST(ABlockOfVaryingStiffness, BearsByItsFibres) {
  const auto departure = [](double spacing) {
    verification::Run<2> run(scene_of(
        platens,
        {"geometry.spacing=" + std::to_string(spacing),
         "material.0.youngs_modulus={ at = [0.5, 7], value = 1e6, gradient = [1.2e6, 0] }"}));
    constexpr double strain = 1e-3 / 2.0;
    // The mean modulus is that of the middle.
    EXPECT_NEAR(run.complete().back().mean_pressure, 1e6 * strain, 0.01 * 1e6 * strain);
    double most = 0.0;
    for (Eigen::Index a = 0; a < run.model.size(); ++a) {
      const double modulus = 1e6 + 1.2e6 * (run.model.particles.position(a, 0) - 0.5);
      most = std::max(most, std::abs(run.state.stress(1, a) / (modulus * strain) + 1.0));
    }
    return most;
  };
  const double coarse = departure(0.125), fine = departure(0.0625);
  report("largest_departure_at_8", coarse);
  report("largest_departure_at_16", fine);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.7 * coarse);
}

// 2 c in plane strain.
TEST(ABlockOfVaryingStrength, BearsItsMeanBetweenPlatens) {
  verification::Run<2> run(scene_of(
      platens, {"material.0.cohesion={ at = [0.5, 7], value = 1e3, gradient = [800, 0] }",
                "material.0.poissons_ratio=0.49", "drive.target=0.02", "solver.tolerance=1e-6"}));
  EXPECT_NEAR(run.complete().back().mean_pressure, 2e3, 1e-4 * 2e3);
}

// Both programs read the file: fpm-limit certifies 90.8 and 91.7 kPa (`--gap 1%`); the load at the
// end is within that but for 2 %, half as fine as the scene.
TEST(StripOnStrengthThatGrowsWithDepth, BearsWhatFpmLimitBrackets) {
  verification::Run<2> run(shipped_scene("strength_with_depth.toml", {"geometry.spacing=0.125"}));
  const double pressure = run.complete().back().mean_pressure;
  report("pressure_Pa", pressure);
  EXPECT_GT(pressure, 0.98 * 90.8e3);
  EXPECT_LT(pressure, 1.02 * 91.7e3);
}

// A friction angle that changes across: each fibre bears 2 c tan(45 + phi / 2) and spreads by
// itself; the mean of the tangent over angles from one to other is the difference of
// -2 ln(cos(45 + phi / 2)) over that of the angles.
TEST(ABlockOfVaryingFriction, BearsTheMeanOfItsFibresBetweenPlatens) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double one = 15.0 * degree, other = 25.0 * degree;
  const auto primitive = [](double phi) {
    return -2.0 * std::log(std::cos(std::numbers::pi / 4.0 + phi / 2.0));
  };
  const double exact = 2.0 * 1e3 * (primitive(other) - primitive(one)) / (other - one);
  const std::string friction = "{ at = [0, 0], value = 15, gradient = [10, 0] }";
  verification::Run<2> run(
      scene_of(platens, {"material.0.model=mohr_coulomb", "material.0.friction_angle=" + friction,
                         "material.0.dilation_angle=" + friction, "material.0.poissons_ratio=0.3",
                         "drive.target=0.03", "programme.steps=8", "solver.tolerance=1e-6"}));
  const double pressure = run.complete().back().mean_pressure;
  report("pressure_over_exact", pressure / exact);
  // Particles on the faces count half, which a convex mean over eight spacings feels by 1e-4.
  EXPECT_NEAR(pressure, exact, 1e-3 * exact);
}

const std::string column = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 4.0]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.25
unit_weight = { at = [0, 4], value = 10e3, gradient = [0, -3e3] }
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "right"
side = "right"
directions = ["x"]
[programme]
steps = 2
[solver]
tolerance = 1e-8
)";

double weight_above(double y) {
  const double depth = 4.0 - y;
  return 10e3 * depth + 0.5 * 3e3 * depth * depth;
}

// Weight is in lumps, which beside a face is off by half a cell.
TEST(AColumn, WhoseWeightGrowsWithDepthIsPressedByItsQuadratic) {
  for (const char* weight : {"{ at = [0, 4], value = 10e3, gradient = [0, -3e3] }",
                             "{ below = 4.0, table = [[0, 10e3], [1.3, 13.9e3], [4, 22e3]] }",
                             "{ raster = [[10e3], [22e3]], lower = [0.5, 0], step = [1, 4] }"}) {
    verification::Run<2> run(scene_of(column + "[drive]\nkind = \"load\"\nscales = [\"gravity\"]\n",
                                      {std::string("material.0.unit_weight=") + weight}));
    run.complete();
    double worst = 0.0, off = 0.0;
    for (Eigen::Index a = 0; a < run.model.size(); ++a) {
      const double y = run.model.particles.position(a, 1);
      const double error = std::abs(run.state.stress(1, a) + weight_above(y));
      worst = std::max(worst, error);
      if (y > 0.5 && y < 3.5) off = std::max(off, error / weight_above(y));
    }
    report("worst_error_Pa", worst);
    report("worst_relative_error_inside", off);
    EXPECT_LT(worst, 0.5 * 0.25 * 22e3);
  }
}

TEST(AColumn, WhoseWeightGrowsWithDepthIsAtRestUnderItsGeostaticStress) {
  const TestScene scene = scene_of(column + "[initial_stress]\nkind = \"geostatic\"\n");
  const model::Model<2> model = stepping::model_at_rest<2>(scene);
  model::State<2> state = model::initial_state(model);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double y = model.particles.position(a, 1);
    EXPECT_NEAR(state.stress(1, a), -weight_above(y), 1e-9 * weight_above(y));
  }
  stepping::LoadStepper<2> stepper(scene, model, state);
  EXPECT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged);
  EXPECT_LT(state.displacement.cwiseAbs().maxCoeff(), 1e-9);
}

// A strength that is told by a table or a raster, and linear, is the linear one: particles have the
// same laws, to rounding.
TEST(StripOnStrengthThatGrowsWithDepth, BearsTheSameByATableAndByARaster) {
  const auto pressure = [](const std::string& cohesion) {
    Settings settings{"geometry.spacing=0.25", "programme.steps=10"};
    if (!cohesion.empty()) settings.push_back("material.0.cohesion=" + cohesion);
    verification::Run<2> run(shipped_scene("strength_with_depth.toml", settings));
    return run.complete().back().mean_pressure;
  };
  const double linear = pressure("");
  // Of laws to 1e-15, by a solver with a tolerance of 1e-3 whose steps hand on what they learn in
  // single precision, 6e-8 each of ten steps: 1.1e-6 measured.
  constexpr double rounding = 1e-5;
  for (const char* cohesion :
       {"{ below = 0.0, table = [[0, 10e3], [0.37, 17.4e3], [1.1, 32e3], [2, 50e3]] }",
        "{ raster = [[10e3, 10e3], [30e3, 30e3], [50e3, 50e3]], lower = [-1, -2], step = [5, 1] "
        "}"}) {
    EXPECT_NEAR(pressure(cohesion) / linear, 1.0, rounding) << cohesion;
  }
}

// A raster of a random field. Both programs read the file: fpm-limit certifies 1.298 and 1.323
// (`--gap 2%`); the slope, twice as coarse as the scene, stands up to a factor within that but for
// 2 % below, and 3 % above: narrow bands are borne too well.
TEST(SlopeOfRandomClay, FailsWhereFpmLimitBracketsIt) {
  const TestScene scene = shipped_scene("random_clay.toml", {"geometry.spacing=0.5"});
  const model::Model<2> model = stepping::model_at_rest<2>(scene);
  model::State<2> state = model::initial_state(model);
  stepping::LoadStepper<2> stepper(scene, model, state);
  double stands = 1.0;
  while (stands < 2.0 && stepper.advance().outcome == stepping::StepOutcome::converged) {
    stands = 1.0 + state.programme.load;  // of a target of 2
  }
  report("factor", stands);
  EXPECT_GT(stands, 0.98 * 1.298);
  EXPECT_LT(stands, 1.03 * 1.323);
}

}  // namespace
}  // namespace verification

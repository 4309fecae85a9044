// Strength and stiffness that change linearly from place to place.

#include "limit_load.hpp"

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

}  // namespace
}  // namespace verification

// Bodies thinner than images reach: opposite sides hold the same particles, and bear each its own.
#include <gtest/gtest.h>

#include <cmath>

#include "measure.hpp"
#include "model/measures.hpp"
#include "run.hpp"

namespace verification {
namespace {

// A strip of 1 m by three particles, pressed or sheared between two rough or smooth plates.
constexpr double E = 1e6, nu = 0.25, height = 0.375, width = 1.0, moved = 1e-3;

std::string strip(const std::string& rest) {
  return R"(
[geometry]
min = [0.0, 0.0]
max = [1.0, 0.375]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.25
density = 2e3
[[measure]]
name = "under"
kind = "reaction"
support = "base"
[[measure]]
name = "below"
kind = "resultant"
side = "bottom"
[[measure]]
name = "above"
kind = "resultant"
side = "top"
[programme]
steps = 1
[solver]
tolerance = 1e-10
[drive]
kind = "displacement"
side = "top"
width = 1.0
target = 1e-3
)" + rest;
}

struct Forces {
  double under_x, under_y, below_x, below_y, above_x, above_y;  // on the body [N/m]
};

Forces forces_of(const std::string& text) {
  Run<2> run(scene_of(text));
  run.complete();
  const std::vector<double> f = model::Measures<2>(run.scene, run.model).of(run.state);
  return {f.at(0), f.at(1), f.at(2), f.at(3), f.at(4), f.at(5)};
}

// A constant stress, which the approximation has exactly, but for what the solver leaves.
constexpr double of_solver = 1e-8;

TEST(ThinBody, IsHeldFromBelowByWhatPressesItFromAbove) {
  const Forces f =
      forces_of(strip("direction = [0.0, -1.0]\nlateral = \"free\"\n[[support]]\n"
                      "name = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\n"));
  const double force = E / (1.0 - nu * nu) * moved / height * width;
  EXPECT_NEAR(f.above_y, -force, of_solver * force);
  EXPECT_NEAR(f.below_y, force, of_solver * force);
  EXPECT_NEAR(f.under_y, force, of_solver * force);
}

// The ends are free, so that the stress is not that of simple shear; but the plates are all that
// holds the strip.
TEST(ThinBody, IsHeldAlongItsSidesByOppositeForces) {
  const Forces f =
      forces_of(strip("direction = [1.0, 0.0]\n[[support]]\nname = \"base\"\n"
                      "side = \"bottom\"\ndirections = [\"x\", \"y\"]\n"));
  const double simple_shear = E / (2.0 * (1.0 + nu)) * moved / height * width;
  EXPECT_GT(f.above_x, 0.5 * simple_shear);
  EXPECT_LT(f.above_x, simple_shear);
  EXPECT_NEAR(f.below_x, -f.above_x, of_solver * simple_shear);
  EXPECT_NEAR(f.under_x, -f.above_x, of_solver * simple_shear);
  EXPECT_NEAR(f.below_y, -f.above_y, of_solver * simple_shear);
}

// At rest the base bears the weight, and the plate nothing.
TEST(ThinBody, OfWeightRestsOnItsBaseAlone) {
  const Forces f = forces_of(
      strip("direction = [0.0, -1.0]\n[gravity]\nacceleration = [0.0, -10.0]\n[initial_stress]\n"
            "kind = \"geostatic\"\n[[support]]\nname = \"sides\"\nside = \"left\"\ndirections = "
            "[\"x\"]\n[[support]]\nname = \"far\"\nside = \"right\"\ndirections = [\"x\"]\n"
            "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"));
  const double weight = 2e3 * 10.0 * height * width;
  const double force = E * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) * moved / height * width;
  EXPECT_NEAR(f.above_y, -force, of_solver * force);
  EXPECT_NEAR(f.below_y, force + weight, of_solver * force);
}

}  // namespace
}  // namespace verification

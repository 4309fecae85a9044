// Blocks of rock and soil with curved envelopes between smooth faces, whose strength is exact.

#include <cmath>

#include "constitutive/curved_envelope.hpp"
#include "constitutive/material.hpp"
#include "measure.hpp"

namespace verification {
namespace {

// Pressed between smooth faces: all sides are free in the plane.
std::string pressed_block(const std::string& model) {
  return R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 2.0]
spacing = 0.25
layout = "vertex"
[approximation]
kinematics = "small_strain"
consistency = "on"
[[material]]
name = "block"
youngs_modulus = 1e9
poissons_ratio = 0.3
)" + model +
         R"(
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
target = 0.01
width = 1.0
[programme]
steps = 10
[solver]
tolerance = 1e-8
max_evaluations_per_step = 4000
)";
}

// sigma_ci s^a without a cell pressure, whatever the dilation. With consistent rows the block stays
// homogeneous; what is left is the solver's tolerance.
TEST(ABlockOfRock, BearsItsUnconfinedStrength) {
  constexpr double tolerance = 1e-6;
  const double s = std::exp(-50.0 / 9.0),
               a = 0.5 + (std::exp(-50.0 / 15.0) - std::exp(-20.0 / 3.0)) / 6.0;
  const double exact = 20e6 * std::pow(s, a);
  for (const char* ratio : {"0.0", "0.5", "1.0"}) {
    verification::Run<2> run(scene_of(
        pressed_block(std::string("model = \"hoek_brown\"\nintact_strength = 20e6\nm_i = 10.0\n"
                                  "gsi = 50.0\ndilation_ratio = ") +
                      ratio),
        {}));
    const auto last = run.complete().back();
    EXPECT_EQ(last.plastic_particles, run.model.size()) << ratio;
    EXPECT_NEAR(last.mean_pressure, exact, tolerance * exact) << ratio;
  }
}

// Of a power law that of the circle about sigma_3 = 0 which touches: a parabola, b = 1/2, has it in
// closed form. With x = sigma_n + T and A^2 p_r = 4 k, tau^2 = 4 k x is touched by the circle of
// centre x + 2 k and radius 2 sqrt(k x + k^2), so that sigma_3 = 0 at sqrt(x + k) = sqrt(k) +
// sqrt(T), and sigma_1 = 4 sqrt(k) (sqrt(k) + sqrt(T)).
TEST(ABlockOfSoilOfAPowerLaw, BearsItsUnconfinedStrength) {
  constexpr double tolerance = 1e-6;
  const double k = 0.8 * 0.8 * 500e3 / 4.0, tension = 100e3;
  const double exact = 4.0 * std::sqrt(k) * (std::sqrt(k) + std::sqrt(tension));
  verification::Run<2> run(
      scene_of(pressed_block("model = \"power_law\"\npower_coefficient = 0.8\npower_exponent = "
                             "0.5\npower_tension = 100e3\nreference_stress = 500e3\n"
                             "dilation_ratio = 0.3"),
               {}));
  const auto last = run.complete().back();
  EXPECT_EQ(last.plastic_particles, run.model.size());
  EXPECT_NEAR(last.mean_pressure, exact, tolerance * exact);
}

}  // namespace
}  // namespace verification

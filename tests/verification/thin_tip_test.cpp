// A layer that runs out into a tip, against a constant stress.

#include <fmt/format.h>

#include <cmath>

#include "run.hpp"

namespace verification {
namespace {

// Pressed everywhere by the same pressure, materials of the same (1 + nu) (1 - 2 nu) / E are
// strained alike: stress is constant whatever their regions and moduli, 1 : 10 here.
std::string pressed(const std::string& regions) {
  return fmt::format(
      R"([geometry]
spacing = 0.1
[approximation]
kinematics = "small_strain"
[[material]]
name = "soft"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = {}
[[material]]
name = "stiff"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.0
{}
[[side]]
name = "bottom"
kind = "roller"
along = [[0, 0], [2, 0]]
[[side]]
name = "rest"
kind = "loaded"
live_pressure = 1e3
along = [[2, 0], [2, 1], [0, 1], [0, 0]]
[[support]]
name = "point"
at = [0.05, 0.05]
directions = ["x"]
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 1
[solver]
tolerance = 1e-11
method = "newton_krylov"
max_evaluations_per_step = 20000
)",
      (std::sqrt(8.2) - 1.0) / 4.0, regions);
}

// The largest departure from that stress, over it.
double departure(const std::string& regions) {
  Run<2> run(scene_of(pressed(regions)));
  run.complete();
  EXPECT_GT(run.state.displacement.cwiseAbs().maxCoeff(), 1e-5);
  const Eigen::Array4d pressure(-1e3, -1e3, 0.0, 0.0);
  double most = 0.0;
  for (const int component : {0, 1, 3}) {
    const Eigen::ArrayXd stress = run.state.stress.row(component).transpose().array();
    most = std::max(most, (stress - pressure[component]).abs().maxCoeff());
  }
  return most / 1e3;
}

std::string region(const std::string& material, const std::string& outline) {
  return fmt::format("[[region]]\nmaterial = \"{}\"\noutline = {}\n", material, outline);
}

// At 4 to 30 degrees from the surface: the tip is less than particles wide, goes to those of its
// neighbour, or, where no rows of its own see it, takes the face with it: which of them it is,
// tests/model/thin_tips_test.cpp says.
TEST(ThinTip, BearsConstantStress) {
  for (const double out : {0.5, 0.53}) {
    for (const double end : {0.2, 0.6, 0.8, 0.9}) {
      EXPECT_LT(departure(region("soft", fmt::format("[[0, 0], [2, 0], [2, {}], [{}, 1], [0, 1]]",
                                                     end, out)) +
                          region("stiff", fmt::format("[[{}, 1], [2, {}], [2, 1]]", out, end))),
                1e-8)
          << out << ' ' << end;
    }
  }
}

}  // namespace
}  // namespace verification

// Strips on layers against the certified bounds of fpm-limit, of the same scenes with --gap 2%.

#include <fmt/format.h>

#include <algorithm>

#include "measure.hpp"

namespace verification {
namespace {

struct Layer {
  double cohesion = 0.0;        // over 1 kPa
  double top = 0.0;             // [m]
  double friction_angle = 0.0;  // [deg] and of dilation
};

struct Ground {
  std::string name;
  std::vector<Layer> layers;  // from above
  double width = 5.0;         // [m]
  double target = 0.24;       // [m] beyond which the load rises no more
  double lower = 0.0;         // bounds over 1 kPa
  double upper = 0.0;
};

// Weightless and associated, as layered_clay.toml, under half of a rough strip of 2 m.
std::string scene_text(const Ground& ground) {
  std::string text = fmt::format(
      "[geometry]\ndimension = 2\nmin = [0.0, -3.0]\nmax = [{:.1f}, 0.0]\nspacing = 0.0625\n"
      "[approximation]\nkinematics = \"small_strain\"\n",
      ground.width);
  for (const Layer& layer : ground.layers) {
    text += fmt::format(
        "[[material]]\nname = \"{:g} m\"\nmodel = \"drucker_prager\"\nyoungs_modulus = 1e6\n"
        "poissons_ratio = 0.4\ncohesion = {}\nfriction_angle = {:.1f}\ndilation_angle = {:.1f}\n",
        -layer.top, 1e3 * layer.cohesion, layer.friction_angle, layer.friction_angle);
    if (layer.top < 0.0) {
      text += fmt::format("region_min = [0.0, -3.0]\nregion_max = [{:.1f}, {:.1f}]\n", ground.width,
                          layer.top);
    }
  }
  return text +
         "[[symmetry]]\naxis = \"x\"\nposition = 0.0\n"
         "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
         "[[support]]\nname = \"far side\"\nside = \"right\"\ndirections = [\"x\"]\n" +
         fmt::format(
             "[drive]\nkind = \"displacement\"\nside = \"top\"\nrange_min = 0.0\nrange_max = 1.0\n"
             "direction = [0.0, -1.0]\ntarget = {}\nreference_length = 1.0\nwidth = 1.0\n"
             "[programme]\nsteps = 40\n",
             ground.target);
}

double load_of(const Ground& ground, int particles) {
  Run<2> run(scene_of(scene_text(ground), {"geometry.spacing=" + std::to_string(1.0 / particles)}));
  const double load = run.complete().back().mean_pressure / 1e3;
  report(fmt::format("{}_at_{}", ground.name, particles), load);
  return load;
}

class Layers : public testing::TestWithParam<Ground> {};

TEST_P(Layers, CarryWhatTheirBoundsSay) {
  const Ground& ground = GetParam();
  const auto beyond = [&](double load) {
    return std::max({0.0, 1.0 - load / ground.lower, load / ground.upper - 1.0});
  };
  const double coarse = beyond(load_of(ground, 8)), fine = beyond(load_of(ground, 16));
  EXPECT_LT(fine, 0.02);
  EXPECT_LE(fine, coarse);
}

INSTANTIATE_TEST_SUITE_P(
    All, Layers,
    testing::Values(
        Ground{"soft_band", {{3.0}, {1.0, -0.5}, {3.0, -1.0}}, 5.0, 0.24, 8.747, 8.919},
        Ground{"crust", {{5.0}, {1.0, -0.5}}, 5.0, 0.24, 8.097, 8.242},
        Ground{"three", {{1.0}, {2.0, -0.5}, {4.0, -1.0}}, 5.0, 0.24, 6.161, 6.273},
        Ground{
            "frictional_crust", {{5.0, 0.0, 20.0}, {1.0, -0.5, 20.0}}, 7.0, 1.2, 21.251, 21.627}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace verification

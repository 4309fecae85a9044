// Slopes under growing weight, on finer and finer particles.
#include <fmt/format.h>

#include "run.hpp"

namespace verification {
namespace {

// Of a height, cohesion and unit weight of one, between rollers, on rigid ground.
std::string slope(double spacing, double run_out, double friction_angle, double weight) {
  return fmt::format(
      "[geometry]\nspacing = {0}\n[approximation]\nkinematics = \"small_strain\"\n"
      "[[material]]\nname = \"soil\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = 1e4\n"
      "poissons_ratio = {4}\ncohesion = 1.0\nfriction_angle = {2}\ndilation_angle = {2}\n"
      "unit_weight = {3}\n"
      "[[region]]\nmaterial = \"soil\"\n"
      "outline = [[-1, -0.5], [2.2, -0.5], [2.2, 1], [{1}, 1], [0, 0], [-1, 0]]\n"
      "[[side]]\nname = \"surface\"\nkind = \"free\"\n"
      "along = [[2.2, 1], [{1}, 1], [0, 0], [-1, 0]]\n"
      "[[side]]\nname = \"base\"\nkind = \"fixed\"\nalong = [[-1, -0.5], [2.2, -0.5]]\n"
      "[[side]]\nname = \"left\"\nkind = \"roller\"\nalong = [[-1, 0], [-1, -0.5]]\n"
      "[[side]]\nname = \"right\"\nkind = \"roller\"\nalong = [[2.2, -0.5], [2.2, 1]]\n"
      "[drive]\nkind = \"load\"\nscales = [\"gravity\"]\n[programme]\nsteps = 48\n",
      spacing, run_out, friction_angle, weight, friction_angle > 0.0 ? 0.3 : 0.49);
}

// The unit weight that is borne.
double borne(const std::string& text, double weight) {
  Run<2> run(scene_of(text));
  while (run.stepper.advance().outcome == stepping::StepOutcome::converged) {
    EXPECT_LT(run.state.programme.load, 1.0);
    if (run.state.programme.load >= 1.0) break;
  }
  return run.state.programme.load * weight;
}

// 60 degrees, phi = 20: Chen's 10.39; the error falls with the spacing, below 1 % at 80 cells.
TEST(SlopeOf60Degrees, BearsWhatChenSays) {
  const double exact = 10.39, weight = 12.0;
  std::vector<double> error;
  for (const double spacing : {0.05, 0.025, 0.0125}) {
    error.push_back(borne(slope(spacing, 1.0 / std::sqrt(3.0), 20.0, weight), weight) / exact -
                    1.0);
    testing::Test::RecordProperty(fmt::format("error_at_{}", spacing),
                                  fmt::format("{}", error.back()));
  }
  EXPECT_GT(error[2], -0.01);  // within what a load can be told apart, 48 steps to 12
  EXPECT_LT(error[1], error[0]);
  EXPECT_LT(error[2], error[1]);
  EXPECT_LT(error[2], 0.01);
}

// A vertical cut in clay, between 3.776 (Lyamin & Sloan 2002) and 3.778 (Pastor et al. 2000).
TEST(VerticalCut, BearsWhatItsBoundsSay) {
  const double exact = 3.777, weight = 5.0;
  const double coarse = borne(slope(0.05, 0.0, 0.0, weight), weight) / exact - 1.0;
  const double fine = borne(slope(0.025, 0.0, 0.0, weight), weight) / exact - 1.0;
  testing::Test::RecordProperty("error_at_0.05", fmt::format("{}", coarse));
  testing::Test::RecordProperty("error_at_0.025", fmt::format("{}", fine));
  EXPECT_LT(fine, coarse);
  EXPECT_LT(std::abs(fine), 0.02);
}

}  // namespace
}  // namespace verification

// A body under a pressure that follows it all round: no support bears any of the load, and the
// solution is a uniform compression.
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <stdexcept>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "stepping/settle.hpp"
#include "stepping/stepper.hpp"

namespace stepping {
namespace {

constexpr double youngs_modulus = 1e7, poissons_ratio = 0.3, pressure = 1e5;
constexpr double tolerance = 1e-9;
// What is left of the load, as a force at the worst place, bends a body of up to eight particles
// along a side (8^2 times softer than one particle is) that is held at points (ten times softer).
constexpr double softness = 10.0 * 8.0 * 8.0;
constexpr double displacement_error = softness * tolerance * pressure / youngs_modulus;

std::string side(const std::string& name, const std::string& value) {
  return "[[traction]]\nname = \"" + name + "\"\nside = \"" + name + "\"\nvalue = " + value +
         "\nfollower = true\n";
}

// Supports that hold the body as a whole, and no more.
std::string held(const std::string& name, const std::string& at, const std::string& directions) {
  return "[[support]]\nname = \"" + name + "\"\nat = " + at + "\ndirections = " + directions + "\n";
}

std::string common(const std::string& layout) {
  return "layout = \"" + layout + "\"\n" + R"([approximation]
consistency = "on"
[[material]]
name = "a"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 1
[solver]
tolerance = 1e-9
)";
}

std::string square(const std::string& layout) {
  return "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.125\n" +
         common(layout) + side("left", "[1e5, 0.0]") + side("right", "[-1e5, 0.0]") +
         side("bottom", "[0.0, 1e5]") + side("top", "[0.0, -1e5]") +
         held("origin", "[0.0, 0.0]", "[\"x\", \"y\"]") + held("level", "[1.0, 0.0]", "\"y\"");
}

std::string cube(const std::string& layout) {
  return "[geometry]\ndimension = 3\nmin = [0.0, 0.0, 0.0]\nmax = [1.0, 1.0, 1.0]\n"
         "spacing = 0.25\n" +
         common(layout) + side("left", "[1e5, 0.0, 0.0]") + side("right", "[-1e5, 0.0, 0.0]") +
         side("bottom", "[0.0, 1e5, 0.0]") + side("top", "[0.0, -1e5, 0.0]") +
         side("front", "[0.0, 0.0, 1e5]") + side("back", "[0.0, 0.0, -1e5]") +
         held("origin", "[0.0, 0.0, 0.0]", "[\"x\", \"y\", \"z\"]") +
         held("along x", "[1.0, 0.0, 0.0]", "[\"y\", \"z\"]") +
         held("along y", "[0.0, 1.0, 0.0]", "\"z\"");
}

// The stretch of one step: its strain is that of the midpoint, 2 (s - 1) / (s + 1), and the stress
// of it, of Hooke's law in the plane or in space, is -p.
double stretch(int dimension) {
  const double plane = dimension == 2 ? 1.0 + poissons_ratio : 1.0;
  const double strain = -pressure / youngs_modulus * plane * (1.0 - 2.0 * poissons_ratio);
  return (2.0 + strain) / (2.0 - strain);
}

template <int Dim>
void expect_uniform_compression(const std::string& text) {
  const auto reading = scene::parse_scene(text, "body");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  const auto model = model::build_model<Dim>(*reading.scene);
  auto state = model::initial_state(model);
  omp_set_num_threads(1);
  LoadStepper<Dim> stepper(*reading.scene, model, state);
  const StepResult result = stepper.advance();
  ASSERT_EQ(result.outcome, StepOutcome::converged) << result.reason;
  EXPECT_LE(result.record.residual_ratio, tolerance) << "of the load, which follows";

  const double s = stretch(Dim);
  const auto first = model.particles.position.row(0);  // the one next to the origin
  const fpm::Field<Dim> exact = (s - 1.0) * (model.particles.position.rowwise() - first);
  EXPECT_LT((state.displacement - exact).cwiseAbs().maxCoeff(), displacement_error);
  // The force of the pressure at the end of the step on the motion of the faces.
  EXPECT_NEAR(state.programme.external_work, pressure * Dim * std::pow(s, Dim - 1) * (1.0 - s),
              displacement_error * pressure * Dim);
}

class FollowingPressure : public ::testing::TestWithParam<const char*> {};

TEST_P(FollowingPressure, AllRoundASquareCompressesIt) {
  expect_uniform_compression<2>(square(GetParam()));
}

TEST_P(FollowingPressure, AllRoundACubeCompressesIt) {
  expect_uniform_compression<3>(cube(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Layouts, FollowingPressure, ::testing::Values("vertex", "cell"),
                         [](const auto& info) { return info.param; });

// Ground that has settled under what follows its boundary is at rest there: it is not pressed on
// twice.
TEST(FollowingPressure, OfTheGroundAtRestHasDoneItsWork) {
  const std::string text =
      "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.25\n"
      "[[material]]\nname = \"a\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\n"
      "poissons_ratio = 0.3\n[[support]]\nname = \"base\"\nside = \"bottom\"\n"
      "directions = [\"x\", \"y\"]\n" +
      side("top", "[0.0, -1e5]") +
      "[[traction]]\nname = \"more\"\nside = \"top\"\nvalue = [0.0, -1.0]\n"
      "[initial_stress]\nkind = \"gravity\"\n"
      "[drive]\nkind = \"load\"\nscales = [\"traction\"]\nloads = [\"more\"]\n"
      "[programme]\nsteps = 1\n[solver]\ntolerance = 1e-9\n";
  const auto reading = scene::parse_scene(text, "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  model::Model<2> model = model_at_rest<2>(*reading.scene);
  model::State<2> state = model::initial_state(model);
  LoadStepper<2> stepper(*reading.scene, model, state);
  ASSERT_EQ(stepper.advance().outcome, StepOutcome::converged);
  // Settled under 1 Pa of 1e5 Pa: at most by its height over Young's modulus, and the solver's
  // part.
  EXPECT_LT(state.displacement.cwiseAbs().maxCoeff(),
            2.0 * 1.0 / youngs_modulus + displacement_error);
}

}  // namespace
}  // namespace stepping

// Bodies whose solution is known though no force is left to measure a residual by.
#include <gtest/gtest.h>
#include <omp.h>

#include <stdexcept>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "stepping/stepper.hpp"

namespace stepping {
namespace {

std::string square(const std::string& kinematics, const std::string& layout) {
  return "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.1\n"
         "layout = \"" +
         layout + "\"\n[approximation]\nkinematics = \"" + kinematics + "\"\n" +
         R"([[material]]
name = "a"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[solver]
tolerance = 1e-6
)";
}

const std::string base = R"([[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
)";
const std::string no_load = base;
// Turns freely about one particle.
const std::string hardly_held = R"([[support]]
name = "one"
at = [0.43, 0.37]
directions = ["x", "y"]
method = "penalty"
)";
const std::string cancelling = base + R"([[traction]]
name = "down"
side = "top"
value = [0.0, -1000.0]
[[traction]]
name = "up"
side = "top"
value = [0.0, 1000.0]
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 1
)";
// The side that is moved holds the body, and nothing else does.
const std::string translation = R"([drive]
kind = "displacement"
side = "left"
direction = [1.0, 0.0]
target = 0.5
width = 1.0
[programme]
steps = 2
)";

/// The largest difference of a displacement from that of a rigid body, after the whole programme.
double error_of(const std::string& text, double along_x) {
  const auto reading = scene::parse_scene(text, "square");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  const auto model = model::build_model<2>(*reading.scene);
  auto state = model::initial_state(model);
  omp_set_num_threads(1);
  LoadStepper<2> stepper(*reading.scene, model, state);
  while (!stepper.finished()) {
    const StepResult result = stepper.advance();
    if (result.outcome != StepOutcome::converged) throw std::runtime_error(result.reason);
  }
  return (state.displacement.rowwise() - Eigen::RowVector2d(along_x, 0.0)).cwiseAbs().maxCoeff();
}

// A residual of some epsilon of E moves a point by some epsilon of the body's size, times the
// condition of the body, of the order of its particles along a side.
constexpr double rounding = 1e-12;

class Floor : public ::testing::TestWithParam<std::pair<std::string, std::string>> {
 protected:
  [[nodiscard]] static std::string body() { return square(GetParam().first, GetParam().second); }
};

TEST_P(Floor, OfABodyWithoutLoadIsRest) {
  EXPECT_LT(error_of(body() + no_load, 0.0), rounding);
}

TEST_P(Floor, OfABodyWithoutLoadIsRestHoweverItIsHeld) {
  EXPECT_LT(error_of(body() + hardly_held, 0.0), rounding);
}

TEST_P(Floor, OfLoadsThatCancelIsRest) {
  EXPECT_LT(error_of(body() + cancelling, 0.0), rounding);
}

TEST_P(Floor, OfABodyThatIsMovedAsAWholeIsItsTranslation) {
  EXPECT_LT(error_of(body() + translation, 0.5), rounding);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Floor,
    ::testing::Values(std::pair<std::string, std::string>{"small_strain", "vertex"},
                      std::pair<std::string, std::string>{"finite_strain", "vertex"},
                      std::pair<std::string, std::string>{"small_strain", "cell"},
                      std::pair<std::string, std::string>{"finite_strain", "cell"}),
    [](const auto& info) { return info.param.first + "_" + info.param.second; });

}  // namespace
}  // namespace stepping

// Steps whose equilibrium is linear: which are, what they cost, and that their solve is that of the
// others.
#include "stepping/linear_solve.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "scene/reader.hpp"
#include "stepping/stepper.hpp"

namespace stepping {
namespace {

using Settings = std::vector<std::string>;

// Held at its base, with rollers at one side; loads and drives as the tables say.
std::string body(bool plane, const std::string& tables) {
  const std::string corners = plane ? "min = [0.0, 0.0]\nmax = [1.0, 0.8]\n"
                                    : "min = [0.0, 0.0, 0.0]\nmax = [0.6, 0.6, 0.6]\n";
  const std::string all = plane ? "[\"x\", \"y\"]" : "[\"x\", \"y\", \"z\"]";
  return std::string("[geometry]\ndimension = ") + (plane ? "2\n" : "3\n") + corners +
         "spacing = 0.1\n[approximation]\nkinematics = \"small_strain\"\n"
         "[[material]]\nname = \"a\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\n"
         "poissons_ratio = 0.3\ndensity = 2000.0\n"
         "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = " +
         all + "\n[[support]]\nname = \"left\"\nside = \"left\"\ndirections = [\"x\"]\n" + tables;
}

const std::string pressed = R"([[traction]]
name = "down"
side = "top"
value = [1000.0, -5000.0]
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 4
)";
const std::string pressed_in_space = R"([[traction]]
name = "down"
side = "top"
value = [1000.0, 500.0, -5000.0]
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 2
)";
const std::string pulled = R"([gravity]
acceleration = [0.0, -9.81]
[drive]
kind = "displacement"
side = "top"
direction = [0.0, 1.0]
target = 0.01
width = 1.0
[programme]
steps = 2
)";

template <int Dim>
struct Body {
  explicit Body(const std::string& text, const Settings& settings = {})
      : checked(read(text, settings)),
        model(model::build_model<Dim>(*checked)),
        state(model::initial_state(model)),
        stepper(*checked, model, state) {
    omp_set_num_threads(1);
  }
  static std::shared_ptr<const scene::Scene> read(const std::string& text,
                                                  const Settings& settings) {
    const auto reading = scene::parse_scene(text, "body", settings);
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return reading.scene;
  }
  std::vector<StepRecord> run() {
    std::vector<StepRecord> records;
    while (!stepper.finished()) {
      const StepResult result = stepper.advance();
      if (result.outcome != StepOutcome::converged) throw std::runtime_error(result.reason);
      records.push_back(result.record);
    }
    return records;
  }
  bool is_linear() { return equilibrium::Equilibrium<Dim>(model, state).is_linear(); }

  std::shared_ptr<const scene::Scene> checked;
  model::Model<Dim> model;
  model::State<Dim> state;
  LoadStepper<Dim> stepper;
};

// Both residuals are below 1e-10 of the loads: what that leaves of displacements is that times the
// condition of the body, of the order of the square of its particles along a side.
template <int Dim>
void expect_the_solution_of_newton(const std::string& text, const Settings& more = {}) {
  Settings settings{"solver.tolerance=1e-10"};
  settings.insert(settings.end(), more.begin(), more.end());
  Body<Dim> linear(text, settings);
  ASSERT_TRUE(linear.is_linear());
  linear.run();
  settings.emplace_back("solver.method=newton_krylov");
  Body<Dim> newton(text, settings);
  newton.run();
  const double largest = newton.state.displacement.cwiseAbs().maxCoeff();
  EXPECT_LE((linear.state.displacement - newton.state.displacement).cwiseAbs().maxCoeff(),
            1e-8 * largest);
  EXPECT_LE((linear.state.stress - newton.state.stress).cwiseAbs().maxCoeff(),
            1e-8 * newton.state.stress.cwiseAbs().maxCoeff());
}

TEST(LinearSolve, IsTheSolutionOfNewton) {
  expect_the_solution_of_newton<2>(body(true, pressed));
  expect_the_solution_of_newton<2>(body(true, pressed), {"geometry.jitter=0.2"});
  expect_the_solution_of_newton<2>(body(true, pressed), {"hourglass.stiffness_ratio=0.5"});
  expect_the_solution_of_newton<2>(body(true, pressed), {"solver.preconditioner=factors"});
  expect_the_solution_of_newton<2>(body(true, pressed), {"solver.preconditioner=block_jacobi"});
  expect_the_solution_of_newton<2>(body(true, pulled));
  expect_the_solution_of_newton<3>(body(false, pressed_in_space));
}

// Springs of tied faces, of penalties and of sides aslant are in the residual and its action alike.
TEST(LinearSolve, OfSpringsIsTheSolutionOfNewton) {
  const std::string layer =
      "[[material]]\nname = \"b\"\nmodel = \"elastic\"\nyoungs_modulus = 1e8\n"
      "poissons_ratio = 0.2\ndensity = 2000.0\nregion_min = [0.0, 0.4]\nregion_max = [1.0, 0.8]\n";
  expect_the_solution_of_newton<2>(body(true, pressed) + layer);
  expect_the_solution_of_newton<2>(body(true, pressed) + layer,
                                   {"approximation.interfaces=through"});
  expect_the_solution_of_newton<2>(body(true, pressed), {"support.1.method=penalty"});
  expect_the_solution_of_newton<2>(
      body(true, pressed) +
      "[[cutout]]\nname = \"corner\"\nkind = \"fixed\"\noutline = [[0.6, 0], [1, 0], [1, 0.3]]\n");
}

TEST(LinearSolve, IsForResidualsThatAreLinear) {
  const auto is_linear = [](const Settings& settings, const std::string& more = "") {
    return Body<2>(body(true, pressed) + more, settings).is_linear();
  };
  EXPECT_TRUE(is_linear({}));
  EXPECT_FALSE(is_linear({"approximation.kinematics=finite_strain"}));
  EXPECT_FALSE(is_linear({"hourglass.control=viscosity"}));
  EXPECT_FALSE(is_linear({}, R"([[material]]
name = "clay"
model = "von_mises"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 1e4
region_min = [0.5, 0.0]
region_max = [1.0, 0.8]
)"));
}

// Who names an algorithm gets it.
TEST(LinearSolve, LeavesOtherMethodsToWhoeverAsksForThem) {
  for (const char* setting : {"solver.method=newton_krylov", "solver.method=multisecant"}) {
    Body<2> other(body(true, pressed), {setting, "programme.steps=1"});
    Body<2> plain(body(true, pressed), {"programme.steps=1"});
    EXPECT_NE(other.run().front().residual_evaluations, plain.run().front().residual_evaluations);
    EXPECT_GT(other.stepper.bytes(), plain.stepper.bytes()) << setting;
  }
}

// The first step is solved for, and the others are like it.
TEST(LinearSolve, OfALoadThatGrowsIsNeededOnce) {
  const auto records = Body<2>(body(true, pressed)).run();
  ASSERT_EQ(records.size(), 4U);
  EXPECT_GT(records.front().jacobian_actions, 5);
  for (std::size_t step = 1; step < records.size(); ++step) {
    EXPECT_EQ(records[step].jacobian_actions, 0) << step;
    EXPECT_EQ(records[step].residual_evaluations, 1) << step;
  }
}

// A weight that is next to nothing is no measure of what supports that move leave.
TEST(LinearSolve, OfAMovedSideDoesNotDependOnALoadThatIsNothing) {
  const auto actions = [](const std::string& gravity) {
    const std::string tables = gravity + pulled.substr(pulled.find("[drive]"));
    const auto records = Body<2>(body(true, tables)).run();
    EXPECT_LE(records.front().residual_ratio, 1e-3);
    return records.front().jacobian_actions;
  };
  const auto without = actions("");
  EXPECT_LE(actions("[gravity]\nacceleration = [0.0, -1e-6]\n"), without + 2);
}

TEST(LinearSolve, StopsWhenAskedTo) {
  Body<2> run(body(true, pressed));
  int asked = 0;
  const StepResult result = run.stepper.advance([&](const auto&) { return ++asked < 3; });
  EXPECT_EQ(result.outcome, StepOutcome::stopped);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(run.state.displacement.norm(), 0.0);
  EXPECT_EQ(run.stepper.advance().outcome, StepOutcome::converged);
}

// What conjugate gradients do not come to is left to the others.
TEST(LinearSolve, ThatIsNotGivenEnoughIsGoneOnWith) {
  Body<2> plain(body(true, pressed), {"programme.steps=1"});
  Body<2> short_of_breath(body(true, pressed),
                          {"programme.steps=1", "solver.max_evaluations_per_step=10"});
  const StepRecord record = short_of_breath.run().front();
  EXPECT_GT(record.residual_evaluations, plain.run().front().residual_evaluations);
  EXPECT_LE(record.residual_ratio, 1e-3);  // the tolerance
}

}  // namespace
}  // namespace stepping

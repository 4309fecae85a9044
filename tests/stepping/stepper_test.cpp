#include "stepping/stepper.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "small_footing.hpp"

namespace stepping {
namespace {

/// All numbers of a state.
std::vector<double> numbers_of(model::State<2> state) {
  std::vector<double> numbers;
  state.for_each_particle_field([&](const char*, const char*, const auto& field) {
    numbers.insert(numbers.end(), field.data(), field.data() + field.size());
  });
  state.for_each_secant_field([&](const char*, const char*, const auto& field) {
    numbers.insert(numbers.end(), field.data(), field.data() + field.size());
  });
  state.programme.for_each_field([&](const char*, const char*, const auto& number) {
    numbers.push_back(static_cast<double>(number));
  });
  return numbers;
}

// Steps of a fifth of the width, ten evaluations each.
const std::vector<std::string> without_hope{"drive.target=0.8", "programme.steps=4",
                                            "solver.max_evaluations_per_step=10",
                                            "programme.minimum_increment_ratio=0.2"};

TEST(LoadStepper, LeavesTheStateAsItWasWhenAStepFailsAtTheSmallestIncrement) {
  SmallFooting run(without_hope);
  const auto before = numbers_of(run.state);
  const StepResult result = run.stepper.advance();
  ASSERT_EQ(result.outcome, StepOutcome::minimum_increment);
  ASSERT_GT(result.record.cuts, 0);
  EXPECT_EQ(numbers_of(run.state), before);
}

TEST(LoadStepper, LeavesTheSecantPairsOfTheStepBeforeAFailedOne) {
  SmallFooting run({"re_search.enabled=false", "programme.minimum_increment_ratio=0.2"});
  for (int step = 0; step < 5; ++step) {
    ASSERT_EQ(run.stepper.advance().outcome, StepOutcome::converged);
  }
  ASSERT_GT(run.state.secant_step.cols(), 0);
  const auto before = numbers_of(run.state);
  EXPECT_EQ(run.stepper.advance([](const jfnk::Iteration& line) { return line.index < 2; }).outcome,
            StepOutcome::stopped);
  EXPECT_EQ(numbers_of(run.state), before);
}

// Not in the solver's, whose options no scene has.
TEST(LoadStepper, SaysInTheScenesWordsWhyAStepFailed) {
  SmallFooting run(without_hope);
  EXPECT_THAT(run.stepper.advance().reason,
              ::testing::MatchesRegex("solver.max_evaluations_per_step = 10 is used up: unbalanced "
                                      "are .* N/m, solver.tolerance = 0.001 allows .*"));
}

TEST(LoadStepper, LeavesTheStateAsItWasWhenItHasLostPatience) {
  auto settings = without_hope;
  settings.back() = "programme.minimum_increment_ratio=1e-30";
  settings.emplace_back("programme.patience=4");
  SmallFooting run(settings);
  const auto before = numbers_of(run.state);
  const StepResult result = run.stepper.advance();
  ASSERT_EQ(result.outcome, StepOutcome::hopeless);
  ASSERT_GT(result.record.cuts, 0);
  EXPECT_EQ(numbers_of(run.state), before);
}

// A particle in the far corner, of the same stiffness, that cannot yield where next to nothing
// does: the load under the plate is that of the ground's own control, not of another.
TEST(LoadStepper, CarriesTheSameLoadWithAFarElasticCorner) {
  constexpr double hardly = 0.05;  // of what another control would change
  SmallFooting plain, other({"hourglass.control=incremental"});
  SmallFooting corner({}, R"([[material]]
name = "corner"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.3
density = 1800.0
region_min = [2.75, -2.0]
region_max = [3.0, -1.75]
)");
  StepResult result;
  for (SmallFooting* run : {&plain, &other, &corner}) {
    for (int step = 0; step < 5; ++step) {
      result = run->stepper.advance();
      ASSERT_EQ(result.outcome, StepOutcome::converged);
    }
    run->load = result.record.reaction;
  }
  ASSERT_GT(result.record.plastic_particles, 0);
  EXPECT_LT(std::abs(corner.load - plain.load), hardly * std::abs(other.load - plain.load));
}

// A step that is cut before it is stopped: its halved increment must not stay behind.
TEST(LoadStepper, StoppedInACutStepGoesOnAsIfItHadNotBeen) {
  const std::vector<std::string> hard{"programme.steps=6", "solver.max_evaluations_per_step=10"};
  SmallFooting whole(hard), stopped(hard);
  StepResult last;
  while (last.record.cuts == 0) {
    ASSERT_FALSE(whole.stepper.finished()) << "no step is cut: the test is of no use";
    last = whole.stepper.advance();
    ASSERT_EQ(last.outcome, StepOutcome::converged);
  }
  while (stopped.state.programme.step + 1 < whole.state.programme.step) {
    ASSERT_EQ(stopped.stepper.advance().outcome, StepOutcome::converged);
  }
  const auto before = numbers_of(stopped.state);
  int iterations = 0;
  StepResult result;
  do {  // ever later, until it is stopped after a cut
    ASSERT_EQ(numbers_of(stopped.state), before);
    int left = ++iterations;
    result = stopped.stepper.advance([&left](const jfnk::Iteration&) { return --left > 0; });
    ASSERT_EQ(result.outcome, StepOutcome::stopped);
  } while (result.record.cuts == 0);
  EXPECT_EQ(numbers_of(stopped.state), before);
  ASSERT_EQ(stopped.stepper.advance().outcome, StepOutcome::converged);
  EXPECT_EQ(numbers_of(stopped.state), numbers_of(whole.state));
}

}  // namespace
}  // namespace stepping

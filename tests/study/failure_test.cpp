// How well a failure is known, and what a run is expected to take.
#include "study/failure.hpp"

#include <gtest/gtest.h>

#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "study/expense.hpp"
#include "study/quantity.hpp"
#include "support/sample_scene.hpp"

namespace study {
namespace {

double resolution(const std::string& programme) {
  const auto reading =
      scene::parse_scene(std::string(support::pressed_block) + "steps = 8\n" + programme, "s.toml");
  return failure_resolution(*reading.scene, parse_quantity("load_parameter"));
}

// Steps are halved as long as they are no smaller than the smallest.
TEST(FailureResolution, IsTheLastStepThatIsTried) {
  EXPECT_DOUBLE_EQ(resolution("minimum_increment_ratio = 0.25\n"), 1.0 / 32.0);
  EXPECT_DOUBLE_EQ(resolution("minimum_increment_ratio = 0.26\n"), 1.0 / 16.0);
  EXPECT_DOUBLE_EQ(resolution("minimum_increment_ratio = 0.51\n"), 1.0 / 8.0);
}

TEST(Expense, KnowsNothingByRunsThatWereRefused) {
  const std::vector<double> spacings{1.0, 0.5};
  Expense expense(spacings, 3.0);
  Fineness coarse, fine;
  coarse.level = 0;
  fine.level = 1;
  expense.note(coarse, 2.0);
  Fineness refused = fine;
  refused.box = 1.5;
  expense.note(refused, 0.0);
  EXPECT_DOUBLE_EQ(expense.expected(fine), 2.0 * 8.0);
}

}  // namespace
}  // namespace study

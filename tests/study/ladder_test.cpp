#include "study/ladder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace study {
namespace {

using ::testing::HasSubstr;

const std::vector<double> spacings{0.25,       1.0 / 6.0,  1.0 / 9.0, 1.0 / 14.0,
                                   1.0 / 21.0, 1.0 / 32.0, 1.0 / 48.0};

/// A made problem: exact value 1, an error of each source.
struct Problem {
  double of_spacing = 0.3, order = 1.0;  // a h^p
  double of_steps = 0.0;                 // over how many times as many steps
  double of_tolerance = 0.0;             // times how many times the tolerance
  std::size_t finest = 0;                // asked for so far
  double seconds = 0.0;

  double value(const Fineness& f) const {
    return 1.0 + of_spacing * std::pow(spacings[f.level], order) + of_steps / f.steps +
           of_tolerance * f.tolerance;
  }
  Answer climbed(double accuracy, std::optional<double> budget = std::nullopt) {
    std::vector<Fineness> asked;
    const Wish wish{accuracy, budget, spacings, 2.0, 3.0};
    return climb(wish, [&](const Fineness& one, double /*allowance*/) {
      const double cost = 0.01 * std::pow(spacings[one.level], -3.0) * one.steps;
      finest = std::max(finest, one.level);
      if (std::ranges::find(asked, one) == asked.end()) seconds += cost;
      asked.push_back(one);
      return Reply{value(one), cost};
    });
  }
};

TEST(TheLadder, EndsAtTheCoarsestSpacingThatIsGoodEnough) {
  Problem problem;
  // 1.25 a h is what is left of an error of first order: 2 % of 1 + a h from h = 1/21 on.
  const Answer answer = problem.climbed(0.02);
  EXPECT_TRUE(answer.reached);
  EXPECT_EQ(answer.fineness.level, 4U);
  EXPECT_EQ(problem.finest, 4U) << "nothing finer is run";
  EXPECT_NEAR(answer.bar, 1.25 * 0.3 / 21.0, 1e-6);
  EXPECT_DOUBLE_EQ(answer.value, problem.value(answer.fineness));
  EXPECT_NEAR(answer.seconds, problem.seconds, 1e-9) << "each run is paid once";
}

TEST(TheLadder, MakesStepsAndToleranceFineEnoughFirst) {
  Problem problem;
  problem.of_steps = 0.04;
  problem.of_tolerance = 0.03;
  const Answer answer = problem.climbed(0.02);
  ASSERT_TRUE(answer.reached);
  EXPECT_GT(answer.fineness.steps, 1.0);
  EXPECT_LT(answer.fineness.tolerance, 1.0);
  EXPECT_LE(std::abs(answer.value - 1.0), answer.bar);
  double sum = 0.0;
  for (const Part& part : answer.parts) sum += part.error;
  EXPECT_DOUBLE_EQ(sum, answer.bar);
}

// A tenth of the tolerance may change nothing on coarse particles, and what a step leaves matter
// all the same: a bar in plane strain that localises stays even on coarse ones.
TEST(TheLadder, CountsWhatAStepMayLeaveWhereATighterToleranceChangesNothing) {
  Wish wish{0.02, std::nullopt, spacings, 2.0, 3.0};
  wish.unbalanced = 1e-3;
  const Problem problem;
  const auto run = [&](const Fineness& one, double /*allowance*/) {
    return Reply{problem.value(one), 1.0};
  };
  const auto tolerance_of = [](const Answer& answer) {
    const auto part = std::ranges::find(answer.parts, "tolerance", &Part::source);
    return part == answer.parts.end() ? 0.0 : part->error / answer.value;
  };
  EXPECT_NEAR(tolerance_of(climb(wish, run)), 1e-3, 1e-12);
  wish.accuracy = 0.002;  // a quarter of it is less
  const Answer sharper = climb(wish, run);
  EXPECT_DOUBLE_EQ(sharper.fineness.tolerance, 0.1);
  EXPECT_NEAR(tolerance_of(sharper), 1e-4, 1e-12);
}

// Honest on what it is made for: errors that are powers of each source, of any size and sign; and
// the bar is not much wider than it must be.
TEST(TheLadder, HasTheTrueErrorWithinItsBar) {
  std::mt19937_64 engine(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    Problem problem;
    problem.order = 1.25 + 0.75 * share(engine);
    problem.of_spacing = 0.5 * share(engine);
    problem.of_steps = 0.02 * share(engine);
    problem.of_tolerance = 0.005 * share(engine);
    const Answer answer = problem.climbed(0.02);
    const double error = std::abs(answer.value - 1.0);
    ASSERT_LE(error, answer.bar) << "order " << problem.order << " of spacing "
                                 << problem.of_spacing;
    EXPECT_TRUE(!answer.reached || answer.bar <= 0.02 * std::abs(answer.value));
  }
}

// A value of the box that falls with its width: that of a load in the plane.
TEST(TheLadder, WidensTheBoxWhereSidesAreFar) {
  const auto value = [](const Fineness& f) { return 1.0 + 0.06 / f.box + 0.1 * spacings[f.level]; };
  const auto climbed = [&](bool box) {
    Wish wish{0.05, std::nullopt, spacings, 2.0, 3.0};
    wish.box = box;
    return climb(wish, [&](const Fineness& one, double /*allowance*/) {
      return Reply{value(one), 1.0};
    });
  };
  const Answer far = climbed(true);
  ASSERT_TRUE(far.reached);
  EXPECT_GT(far.fineness.box, 1.0);
  EXPECT_LE(std::abs(far.value - 1.0), far.bar);
  ASSERT_EQ(far.parts.size(), 4U);
  EXPECT_EQ(far.parts.back().source, "box");
  const Answer fixed = climbed(false);
  EXPECT_EQ(fixed.fineness.box, 1.0);
  EXPECT_EQ(fixed.parts.size(), 3U);
  EXPECT_GT(std::abs(fixed.value - 1.0), fixed.bar) << "what is not looked at is not in the bar";
}

TEST(TheLadder, SaysWhatTheBudgetDoesNotAllow) {
  Problem problem;
  Problem free = problem;
  (void)free.climbed(0.001);
  const Answer answer = problem.climbed(0.001, 0.02 * free.seconds);
  EXPECT_FALSE(answer.reached);
  EXPECT_LE(problem.seconds, 0.02 * free.seconds);
  EXPECT_THAT(answer.obstacle, HasSubstr("the budget of"));
  EXPECT_GT(answer.bar, 0.001) << "with what was reached";
  EXPECT_LE(std::abs(answer.value - 1.0), answer.bar);
}

TEST(TheLadder, TrustsNoSpacingsThatOscillate) {
  const Wish wish{0.02, std::nullopt, spacings, 2.0, 3.0};
  const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
    const double sign = one.level % 2 == 0 ? 1.0 : -1.0;
    return Reply{1.0 + sign * 0.05 * spacings[one.level], 1.0};
  });
  ASSERT_TRUE(answer.reached);
  EXPECT_LE(std::abs(answer.value - 1.0), answer.bar);
  EXPECT_THAT(answer.parts[0].words, HasSubstr("oscillating"));
}

// Values of a body that parts into bands somewhere on its way, as they were measured on the
// compression of share/scenes at a strain of 1.5 %: the three finest lie near each other, and say
// nothing of where the others went.
TEST(TheLadder, CountsAllThatStepsHaveChangedWhereTheyDoNotSettle) {
  const std::vector<double> measured{42687.27, 42564.71, 42468.18, 42396.57, 42460.80,
                                     42455.25, 42310.77, 42202.17, 42277.24};
  const Wish wish{0.01, std::nullopt, {0.25, 0.2, 0.15}, 2.0, 3.0};
  const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
    return Reply{measured.at(static_cast<std::size_t>(std::log2(one.steps))), 1.0};
  });
  EXPECT_FALSE(answer.reached);
  ASSERT_GE(answer.parts.size(), 2U);
  EXPECT_EQ(answer.parts[1].source, "steps");
  EXPECT_GE(answer.parts[1].error, 42687.27 - 42202.17);
}

// The first lies near the last, but those between do not: it is not as good as the last by that.
TEST(TheLadder, CountsAllThatLiesBetweenStepsAndTheFinest) {
  const std::vector<double> made{1.0, 0.95, 0.96, 0.99, 1.0, 1.004, 1.0045, 1.0045, 1.0045};
  const Wish wish{0.02, std::nullopt, {0.25, 0.2, 0.15}, 2.0, 3.0};
  const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
    return Reply{made.at(static_cast<std::size_t>(std::log2(one.steps))), 1.0};
  });
  ASSERT_GE(answer.parts.size(), 2U);
  EXPECT_GE(answer.fineness.steps, 8.0);
  EXPECT_LE(std::abs(answer.value - made.back()), answer.parts[1].error);
}

// Three values of order 0.3 tell less than a third of the way that is left.
TEST(TheLadder, BelievesNoThreeSpacingsThatDoNotSettle) {
  std::size_t finest = 0;
  const auto value = [](std::size_t level) { return 1.0 + 0.01 * std::pow(spacings[level], 0.3); };
  const Wish wish{0.05, std::nullopt, spacings, 1.0, 3.0};
  const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
    finest = std::max(finest, one.level);
    return Reply{value(one.level), 1.0};
  });
  EXPECT_TRUE(answer.reached);
  EXPECT_EQ(finest, 3U);
  // Nor where the budget ends after them: 0.64 s, 2.2 s and 7.3 s are had, but not 27 s as well.
  const Wish short_one{0.05, 30.0, spacings, 1.0, 3.0};
  const Answer cut = climb(short_one, [&](const Fineness& one, double /*allowance*/) {
    return Reply{value(one.level), 0.01 * std::pow(spacings[one.level], -3.0)};
  });
  EXPECT_FALSE(cut.reached);
  EXPECT_EQ(cut.fineness.level, 2U);
  EXPECT_LE(cut.bar, 0.05 * cut.value);
  EXPECT_THAT(cut.obstacle, HasSubstr("the bar is as small as asked for, but"));
}

TEST(TheLadder, EndsWhereARunHasNoValue) {
  const Wish wish{0.02, std::nullopt, spacings, 2.0, 3.0};
  std::size_t runs = 0;
  const auto none = [&](bool of_any_run) {
    runs = 0;
    return climb(wish, [&](const Fineness& /*one*/, double /*allowance*/) {
      ++runs;
      Reply reply{std::nullopt, 1.0};
      reply.obstacle = "there is no column u";
      reply.of_any_run = of_any_run;
      return reply;
    });
  };
  const Answer answer = none(false);
  EXPECT_FALSE(answer.reached);
  EXPECT_THAT(answer.obstacle, HasSubstr("there is no column u"));
  EXPECT_EQ(runs, spacings.size() - 1) << "a finer one may have it";
  EXPECT_THAT(none(true).obstacle, HasSubstr("there is no column u"));
  EXPECT_EQ(runs, 1U);
}

// Spacings that a body is too narrow for have no value, and tell nothing.
TEST(TheLadder, BeginsWithTheCoarsestSpacingThatHasAValue) {
  for (const auto& budget : {std::optional<double>(), std::optional(1e6)}) {
    for (const std::size_t first : {1U, 2U}) {
      const Wish wish{0.05, budget, spacings, 2.0, 3.0};
      const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
        if (one.level < first) return Reply{std::nullopt, 1.0};
        return Reply{1.0 + 0.1 * spacings[one.level], 1.0};
      });
      EXPECT_TRUE(answer.reached);
      EXPECT_EQ(answer.fineness.level, first + 2);
      EXPECT_LE(std::abs(answer.value - 1.0), answer.bar);
    }
  }
}

// Steps that are far from fine enough, with a budget for some of them only: there is an answer, its
// bar holds, and the budget is kept.
TEST(TheLadder, AnswersWithinABudgetThatIsTooShortForTheSteps) {
  int answers = 0;
  for (const double budget : {60.0, 150.0, 300.0, 600.0, 1200.0}) {
    Problem problem;
    problem.of_spacing = 0.1;
    problem.of_steps = 0.1;
    const Answer answer = problem.climbed(0.001, budget);
    EXPECT_LE(problem.seconds, budget);
    EXPECT_FALSE(answer.reached);
    EXPECT_THAT(answer.obstacle, HasSubstr("the budget of"));
    if (answer.parts.empty()) continue;
    ++answers;
    EXPECT_LE(std::abs(answer.value - 1.0), answer.bar) << budget;
    EXPECT_LE(answer.bar, 5.0 * std::abs(answer.value - 1.0)) << budget;
    EXPECT_THAT(answer.obstacle, HasSubstr("more steps"));
  }
  EXPECT_GE(answers, 4);
}

// A run that is not what others have let expect: it is stopped, and what it took is all there is.
TEST(TheLadder, StopsARunThatTakesLongerThanTheBudget) {
  const double budget = 100.0;
  double spent = 0.0;
  std::vector<Fineness> made;
  const Wish wish{0.001, budget, spacings, 2.0, 3.0};
  const Answer answer = climb(wish, [&](const Fineness& one, double allowance) {
    const double seconds = one.level < 3 ? 1.0 : 1000.0;
    Reply reply{1.0 + 0.1 * spacings[one.level], std::min(seconds, allowance)};
    reply.out_of_time = seconds > allowance;
    if (reply.out_of_time) reply.value.reset();
    if (std::ranges::find(made, one) == made.end()) spent += reply.seconds;
    made.push_back(one);
    return reply;
  });
  EXPECT_LE(spent, budget);
  EXPECT_EQ(answer.fineness.level, 2U);
  EXPECT_LE(std::abs(answer.value - 1.0), answer.bar);
  EXPECT_THAT(answer.obstacle, HasSubstr("was spent in the run with spacing 0.07143"));
}

// Three numbers of steps tell of each of them: none is doubled that is fine enough already.
TEST(TheLadder, TakesTheCoarsestOfThreeNumbersOfSteps) {
  for (const auto& [of_steps, wanted] : {std::pair(0.004, 1.0), {0.008, 2.0}, {0.015, 4.0}}) {
    double most = 0.0;
    const Wish wish{0.02, std::nullopt, spacings, 2.0, 3.0};
    const Answer answer = climb(wish, [&](const Fineness& one, double /*allowance*/) {
      most = std::max(most, one.steps);
      return Reply{1.0 + of_steps / one.steps + 0.01 * spacings[one.level], 1.0};
    });
    EXPECT_EQ(answer.fineness.steps, wanted);
    EXPECT_EQ(most, 4.0) << "no more than the three are made";
    // 1.25 of what is left of the finest, and the way there, of what there is: 1.06 to 1.25 times.
    EXPECT_GE(answer.parts[1].error, of_steps / wanted);
    EXPECT_LE(answer.parts[1].error, 1.26 * of_steps / wanted);
  }
}

}  // namespace
}  // namespace study

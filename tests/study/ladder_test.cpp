#include "study/ladder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "program/command_line.hpp"
#include "scene/derived.hpp"
#include "scene/grading.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "study/accuracy.hpp"
#include "study/levels.hpp"
#include "study/quality.hpp"

namespace study {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

std::vector<double> offered(const std::string& name) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  return spacings_on_offer(*scene::read_scene(file).scene);
}

scene::Scene shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  const auto reading = scene::read_scene(file, settings);
  EXPECT_TRUE(reading.scene) << reading.errors.front().text();
  return *reading.scene;
}

// A body of elements has the spacing of its mesh.
TEST(Spacings, OfElementsAreNotOnOffer) {
  EXPECT_THROW((void)offered("circle.toml"), program::UsageError);
}

// B/spacing = 16 of 64 x 32 cells: B keeps whole numbers of cells, from 6 on.
TEST(SpacingsOnOffer, KeepTheFootingAWholeNumberOfCells) {
  const auto all = offered("prandtl_phi0.toml");
  ASSERT_GE(all.size(), 5U);
  for (const double spacing : all) {
    EXPECT_THAT(1.0 / spacing, DoubleNear(std::round(1.0 / spacing), 1e-9));
  }
  EXPECT_DOUBLE_EQ(all[0], 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(all[1], 1.0 / 9.0);
  EXPECT_DOUBLE_EQ(all[2], 1.0 / 14.0);
}

// Its radii are 1 and 2 m: the box is whole, the bore is resolved by six cells.
TEST(SpacingsOnOffer, ResolveACircleFromTheFirst) {
  EXPECT_DOUBLE_EQ(offered("cylinder.toml")[0], 1.0 / 6.0);
}

TEST(SpacingsOnOffer, MakeScenesThatAreAccepted) {
  for (const char* name : {"beam.toml", "block3d.toml", "compression.toml", "cylinder.toml",
                           "footing.toml", "prandtl_phi20.toml"}) {
    const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
    const auto all = offered(name);
    ASSERT_GE(all.size(), 3U) << name;
    for (const double spacing : {all[0], all[1], all[2]}) {
      std::ostringstream setting;
      setting.precision(17);
      setting << "geometry.spacing=" << spacing;
      const auto one = scene::read_scene(file, std::vector<std::string>{setting.str()});
      EXPECT_TRUE(one.errors.empty()) << name << ": " << one.errors.front().text();
    }
  }
}

// Six particles across a region, a hole, or what is pressed on: the footing of half width 1.
TEST(SpacingsOnOffer, ResolveWhatABodyOfRegionsIsMadeOf) {
  for (const char* name : {"crest.toml", "tunnel.toml", "strength_with_depth.toml"}) {
    EXPECT_LE(spacings_of_a_ladder(shipped(name), false)[0], 1.0 / 6.0) << name;
  }
}

TEST(SpacingsOnOffer, EndWithABudgetAndElseAtAnEighth) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  const auto without = spacings_of_a_ladder(strip, false), with = spacings_of_a_ladder(strip, true);
  EXPECT_EQ(without, spacings_on_offer(strip));
  EXPECT_GE(without.back(), strip.geometry.spacing / 8.0);
  EXPECT_LT(with.back(), strip.geometry.spacing / 32.0);
}

// Where only the finest of graded particles became finer, what the others leave would stay unseen.
TEST(ASpacing, MakesAllGradedParticlesAsMuchFiner) {
  const scene::Scene crest = shipped("crest.toml");
  const double half = crest.geometry.spacing / 2.0;
  const scene::Scene fine = shipped("crest.toml", settings_of_spacing(crest, half));
  ASSERT_TRUE(fine.grading.enabled);
  EXPECT_DOUBLE_EQ(fine.geometry.spacing, half);
  EXPECT_DOUBLE_EQ(fine.grading.growth, crest.grading.growth / 2.0);
  EXPECT_DOUBLE_EQ(scene::resolve_coarsest(fine), scene::resolve_coarsest(crest) / 2.0);
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  EXPECT_THAT(settings_of_spacing(strip, 0.125), ElementsAre("geometry.spacing=0.125"));
}

// The number of a stage goes before that of the programme.
TEST(MoreSteps, AreTakenInEachStage) {
  for (const char* name : {"footing_cycle.toml", "footing_stages.toml", "excavation.toml",
                           "prandtl_phi0.toml", "footing.toml"}) {
    const scene::Scene scene = shipped(name);
    const scene::Scene more = shipped(name, settings_of_steps(scene, 2.0));
    EXPECT_EQ(scene::planned_steps(more), 2 * scene::planned_steps(scene)) << name;
  }
}

// The strip's box is 4 x 2 of its half width, which stays a whole number of cells.
TEST(FarSides, MoveAwayAndMaterialsWithThem) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  const auto far = parse_far("right,bottom", strip);
  EXPECT_THAT(widened(strip, far, 1.0), IsEmpty());
  EXPECT_THAT(widened(strip, far, 1.5), ElementsAre("geometry.min=[0, -3]", "geometry.max=[6, 0]"));
  EXPECT_THAT(widened(strip, far, 1.1), ElementsAre("geometry.min=[0, -3]", "geometry.max=[5, 0]"))
      << "by whole cells of every spacing";
  const scene::Scene layered = shipped("layered_clay.toml");
  const auto settings = widened(layered, parse_far("right,bottom", layered), 1.5);
  const scene::Scene wide = shipped("layered_clay.toml", settings);
  for (std::size_t m = 1; m < layered.material.size(); ++m) {
    EXPECT_EQ(wide.material[m].region_max[0] >= wide.geometry.max[0],
              layered.material[m].region_max[0] >= layered.geometry.max[0]);
    EXPECT_EQ(wide.material[m].region_min[1] <= wide.geometry.min[1],
              layered.material[m].region_min[1] <= layered.geometry.min[1]);
  }
}

TEST(FarSides, AreRefusedWhereNoGroundLiesBeyond) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  for (const char* text : {"left", "top", "back", "middle", "", "right,left"}) {
    EXPECT_THROW((void)parse_far(text, strip), program::UsageError) << text;
  }
}

TEST(AQuality, IsTwiceOrHalfTheSpacingAsNearlyAsWholeCellsAllow) {
  for (const char* name : {"prandtl_phi0.toml", "footing.toml", "cylinder.toml", "beam.toml"}) {
    const scene::Scene scene = shipped(name);
    EXPECT_THAT(settings_of(Quality::normal, scene), IsEmpty());
    const double own = scene.geometry.spacing;
    const double fine = shipped(name, settings_of(Quality::fine, scene)).geometry.spacing;
    // Spacings on offer are 1.5 apart.
    EXPECT_GE(own / fine, 2.0 / 1.5) << name;
    EXPECT_LE(own / fine, 2.0 * 1.5) << name;
    const double draft = shipped(name, settings_of(Quality::draft, scene)).geometry.spacing;
    EXPECT_GT(draft, own) << name;
    EXPECT_LE(draft, 2.0 * 1.5 * own) << name;
    const auto tolerance = [](const scene::Scene& of) {
      return scene::resolve_solver(of).tolerance;
    };
    EXPECT_DOUBLE_EQ(tolerance(shipped(name, settings_of(Quality::draft, scene))),
                     std::min(10.0 * tolerance(scene), 0.01))
        << name;
  }
  EXPECT_EQ(parse_quality("draft"), Quality::draft);
  EXPECT_THROW((void)parse_quality("good"), program::UsageError);
}

// Measured: a slope bears 11 % more of its weight with a tolerance of 0.01 than with 0.001.
TEST(AQuality, LoosensNoToleranceThatDecidesWhenARunFails) {
  for (const char* name :
       {"slope.toml", "slope_safety.toml", "excavation.toml", "embankment.toml"}) {
    const scene::Scene scene = shipped(name);
    const scene::Scene draft = shipped(name, settings_of(Quality::draft, scene));
    EXPECT_GT(draft.geometry.spacing, scene.geometry.spacing) << name;
    EXPECT_EQ(scene::resolve_solver(draft).tolerance, scene::resolve_solver(scene).tolerance)
        << name;
  }
}

TEST(TheFormalOrder, IsTheFirstWhereAPlaceIsKnownToHalfASpacing) {
  const Quantity moved = parse_quantity("displacement_x@1,0");
  EXPECT_EQ(formal_order(shipped("block3d.toml"), moved), 2.0);
  EXPECT_EQ(formal_order(shipped("prandtl_phi0.toml"), moved), 1.0) << "the edge of its plate";
  EXPECT_EQ(formal_order(shipped("strength_with_depth.toml"), moved), 1.0) << "of a side";
  EXPECT_EQ(formal_order(shipped("compression.toml"), moved), 1.5) << "a plate without an edge";
  EXPECT_EQ(formal_order(shipped("slope.toml"), moved), 1.5);
  scene::Scene held = shipped("cylinder.toml");
  EXPECT_EQ(formal_order(held, moved), 2.0);
  held.support.emplace_back().at = {1.5, 0.0};
  EXPECT_EQ(formal_order(held, moved), 1.0) << "a particle near by is held";
  held.geometry.layout = scene::Layout::vertex;
  EXPECT_EQ(formal_order(held, moved), 2.0) << "one is there";
  EXPECT_EQ(formal_order(held, parse_quantity("stress_xx@1,0")), 1.0) << "of a particle near by";
  held.measure.front().kind = scene::MeasureKind::stress;
  EXPECT_EQ(formal_order(held, parse_quantity("bore_sxx_Pa")), 1.0);
}

TEST(AnAccuracy, IsAPartOrAPercentage) {
  EXPECT_DOUBLE_EQ(parse_accuracy("2%"), 0.02);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.005"), 0.005);
  for (const char* text : {"", "0", "2", "-1%", "100%", "2 %", "x", "nan"}) {
    EXPECT_THROW((void)parse_accuracy(text), program::UsageError) << text;
  }
}

TEST(ABudget, IsATime) {
  EXPECT_DOUBLE_EQ(parse_budget("10min"), 600.0);
  EXPECT_DOUBLE_EQ(parse_budget("1h30m"), 5400.0);
  EXPECT_DOUBLE_EQ(parse_budget("2.5s"), 2.5);
  for (const char* text : {"", "10", "min", "30m1h", "0s", "-5s", "10 min", "infs"}) {
    EXPECT_THROW((void)parse_budget(text), program::UsageError) << text;
  }
}

TEST(TheQuantity, OfASceneIsWhatItIsRunFor) {
  const auto of = [](const char* name) {
    const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
    return quantity_of(*scene::read_scene(file).scene).column;
  };
  EXPECT_EQ(of("footing.toml"), "mean_pressure_Pa");
  EXPECT_EQ(of("beam.toml"), "body_max_displacement_m");
  EXPECT_EQ(of("slope_safety.toml"), "strength_reduction");
  try {
    (void)of("cylinder.toml");
    FAIL() << "it measures the bore";
  } catch (const program::UsageError& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("displacement of its measure bore; load_parameter"));
  }
}

}  // namespace
}  // namespace study

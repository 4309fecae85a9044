#include "study/ladder.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "program/command_line.hpp"
#include "scene/derived.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
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
    return climb(wish, [&](const std::vector<Fineness>& all) {
      std::vector<std::optional<Reply>> replies;
      for (const Fineness& one : all) {
        const double cost = 0.01 * std::pow(spacings[one.level], -3.0) * one.steps;
        replies.push_back(Reply{value(one), cost});
        finest = std::max(finest, one.level);
        if (std::ranges::find(asked, one) == asked.end()) seconds += cost;
        asked.push_back(one);
      }
      return replies;
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
    return climb(wish, [&](const std::vector<Fineness>& all) {
      std::vector<std::optional<Reply>> replies;
      for (const Fineness& one : all) replies.push_back(Reply{value(one), 1.0});
      return replies;
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
  const Answer answer = climb(wish, [&](const std::vector<Fineness>& all) {
    std::vector<std::optional<Reply>> replies;
    for (const Fineness& one : all) {
      const double sign = one.level % 2 == 0 ? 1.0 : -1.0;
      replies.push_back(Reply{1.0 + sign * 0.05 * spacings[one.level], 1.0});
    }
    return replies;
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
  const Answer answer = climb(wish, [&](const std::vector<Fineness>& all) {
    std::vector<std::optional<Reply>> replies;
    for (const Fineness& one : all) {
      replies.push_back(Reply{measured.at(static_cast<std::size_t>(std::log2(one.steps))), 1.0});
    }
    return replies;
  });
  EXPECT_FALSE(answer.reached);
  ASSERT_GE(answer.parts.size(), 2U);
  EXPECT_EQ(answer.parts[1].source, "steps");
  EXPECT_GE(answer.parts[1].error, 42687.27 - 42202.17);
}

// Three values of order 0.3 tell less than a third of the way that is left.
TEST(TheLadder, BelievesNoThreeSpacingsThatDoNotSettle) {
  std::size_t finest = 0;
  const auto value = [](std::size_t level) { return 1.0 + 0.01 * std::pow(spacings[level], 0.3); };
  const Wish wish{0.05, std::nullopt, spacings, 1.0, 3.0};
  const Answer answer = climb(wish, [&](const std::vector<Fineness>& all) {
    std::vector<std::optional<Reply>> replies;
    for (const Fineness& one : all) {
      finest = std::max(finest, one.level);
      replies.push_back(Reply{value(one.level), 1.0});
    }
    return replies;
  });
  EXPECT_TRUE(answer.reached);
  EXPECT_EQ(finest, 3U);
  // Nor where the budget ends after them.
  const Wish short_one{0.05, 8.0, spacings, 1.0, 3.0};
  const Answer cut = climb(short_one, [&](const std::vector<Fineness>& all) {
    std::vector<std::optional<Reply>> replies;
    for (const Fineness& one : all) replies.push_back(Reply{value(one.level), 1.0});
    return replies;
  });
  EXPECT_FALSE(cut.reached);
  EXPECT_EQ(cut.fineness.level, 2U);
  EXPECT_LE(cut.bar, 0.05 * cut.value);
  EXPECT_THAT(cut.obstacle, HasSubstr("the bar is as small as asked for, but"));
}

TEST(TheLadder, EndsWhereARunHasNoValue) {
  const Wish wish{0.02, std::nullopt, spacings, 2.0, 3.0};
  const Answer answer = climb(wish, [&](const std::vector<Fineness>& all) {
    return std::vector<std::optional<Reply>>(all.size());
  });
  EXPECT_FALSE(answer.reached);
  EXPECT_THAT(answer.obstacle, HasSubstr("no such value"));
}

std::vector<double> offered(const std::string& name) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  return spacings_on_offer(*scene::read_scene(file).scene);
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

scene::Scene shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  const auto reading = scene::read_scene(file, settings);
  EXPECT_TRUE(reading.scene) << reading.errors.front().text();
  return *reading.scene;
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
  EXPECT_EQ(formal_order(shipped("block3d.toml")), 2.0);
  EXPECT_EQ(formal_order(shipped("prandtl_phi0.toml")), 1.0) << "the edge of its plate";
  scene::Scene held = shipped("cylinder.toml");
  EXPECT_EQ(formal_order(held), 2.0);
  held.support.emplace_back().at = {1.5, 0.0};
  EXPECT_EQ(formal_order(held), 1.0) << "a particle near by is held";
  held.geometry.layout = scene::Layout::vertex;
  EXPECT_EQ(formal_order(held), 2.0) << "one is there";
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
  EXPECT_THROW((void)of("cylinder.toml"), program::UsageError) << "it measures the bore";
}

}  // namespace
}  // namespace study

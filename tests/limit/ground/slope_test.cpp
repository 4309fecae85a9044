// Slopes of which friction alone holds more than the weight takes.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "limit/bracket/flank.hpp"
#include "limit/bracket/side.hpp"
#include "limit/bracket/strength_reduction.hpp"
#include "limit/bracket/weakened.hpp"
#include "limit/ground/ground_cases.hpp"

namespace {

using namespace limit;

// A logarithmic spiral through the toe: with the strength divided by this, c / (gamma H) = 0.025
// fails.
constexpr double spiral = 1.3540;

bracket::BracketOptions options() {
  bracket::BracketOptions options;
  options.gap = 0.04;
  return options;
}

TEST(Slope, ThatNoMultipleOfItsWeightBringsDownHasItsFactorInTheBracket) {
  // Without end up to tan(50) / tan(26.57) = 2.38.
  const double friction = 2.0 * std::tan(50.0 * std::numbers::pi / 180.0);
  const auto problem = shipped("slope_gentle", {"material.soil.friction_angle=50"});
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.bracket.reached);
  EXPECT_LT(*found.lower, *found.upper);
  // Cohesion adds to what friction carries alone.
  EXPECT_GT(*found.upper, friction);
  // Each bound is proved by its own field.
  const double one = 1.0 / problem->associated.units.multiplier();
  EXPECT_GE(found.bracket.lower_bound(), one);
  ASSERT_TRUE(found.block || found.bracket.upper);
  EXPECT_LT(found.block ? found.block->certificate.multiplier : found.bracket.upper_bound(), one);
}

TEST(Slope, ThatIsGentleHasTheSpiralsFactorAboveItsLowerBound) {
  const auto problem = shipped("slope_gentle");
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.bracket.reached);
  EXPECT_LT(*found.lower, spiral);
  // The collapse is between the lower bound and the spiral, and the upper bound above the collapse.
  EXPECT_GT(*found.upper, *found.lower);
  EXPECT_GT(*found.lower, spiral * (1.0 - 2.0 * options().gap));
}

// What next to no cohesion carries beside friction is all or nothing: the multiplier of the weights
// falls from no end to next to nothing within a few hundredths of the factor.
TEST(Slope, OfNextToNoCohesionIsCertifiedOnBothSides) {
  const auto problem = shipped("slope_gentle", {"material.soil.cohesion=50"});
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.bracket.reached);
  // From a start at all of the load, centring does not end at many of the factors.
  for (const bracket::Attempt& attempt : found.bracket.attempts) {
    EXPECT_NE(attempt.status, solver::SolverStatus::capped);
  }
  // Friction alone holds a skin of the face.
  EXPECT_GT(*found.upper, 2.0 * std::tan(25.0 * std::numbers::pi / 180.0));
  EXPECT_LT(*found.lower, *found.upper);
}

// Without friction the factor is in proportion to the cohesion, and no harder to find.
TEST(Slope, OfSoftClayIsAsEasyAsOneOfHardClay) {
  std::vector<bracket::Solution> found;
  for (const char* cohesion : {"material.soil.cohesion=20e3", "material.soil.cohesion=20"}) {
    const auto problem = shipped("slope_gentle", {"material.soil.friction_angle=0", cohesion});
    ASSERT_TRUE(problem);
    found.push_back(bracket::solution_of(problem->associated, options(), {}));
    ASSERT_TRUE(found.back().bracket.reached);
  }
  EXPECT_LT(*found[1].lower, *found[0].upper / 1e3);
  EXPECT_GT(*found[1].upper, *found[0].lower / 1e3);
  const auto iterations = [](const bracket::Solution& solution) {
    int sum = 0;
    for (const bracket::Attempt& attempt : solution.bracket.attempts) sum += attempt.iterations;
    return sum;
  };
  EXPECT_LT(iterations(found[1]), 2 * iterations(found[0]));
}

// A cut of 5 m in soft clay over 5 m of sand, or over ground that is rigid.
std::string soft_clay(bool on_sand) {
  std::string text =
      "[load]\nsought = \"strength\"\n"
      "[[material]]\nname = \"clay\"\ncohesion = 500\nfriction_angle = 0\nunit_weight = 18e3\n"
      "[[region]]\nmaterial = \"clay\"\noutline = [[-15, 0], [5, 0], [0, 5], [-15, 5]]\n"
      "[[side]]\nname = \"face\"\nkind = \"free\"\nalong = [[-15, 5], [0, 5], [5, 0]";
  text += on_sand ? ", [20, 0]" : "";
  text += "]\n[[side]]\nname = \"ground\"\nkind = \"fixed\"\n";
  if (!on_sand) return text + "along = [[-15, 5], [-15, 0], [5, 0]]\n";
  return text +
         "along = [[-15, 5], [-15, -5], [20, -5], [20, 0]]\n"
         "[[material]]\nname = \"sand\"\ncohesion = 100\nfriction_angle = 33\nunit_weight = 18e3\n"
         "[[region]]\nmaterial = \"sand\"\n"
         "outline = [[-15, -5], [20, -5], [20, 0], [5, 0], [-15, 0]]\n";
}

// The factor of the clay, some 0.03, leaves the sand a friction of 87 degrees: rigid ground in all
// but name. Its own would be 0.6 and more.
TEST(Slope, OfSoftClayOnSandIsThatOfTheClayOnRigidGround) {
  std::vector<bracket::Solution> found;
  for (const bool on_sand : {false, true}) {
    const auto problem = case_of(soft_clay(on_sand));
    ASSERT_TRUE(problem);
    found.push_back(bracket::solution_of(problem->associated, options(), {}));
    ASSERT_TRUE(found.back().lower && found.back().upper);
    EXPECT_TRUE(found.back().bracket.reached);
  }
  EXPECT_LT(*found[1].lower, *found[0].upper);  // sand is no stronger than rigid ground
  EXPECT_GT(*found[1].upper, *found[0].lower);
  // What has failed in the sand is not tried again in it.
  const auto& attempts = found[1].bracket.attempts;
  EXPECT_LE(std::count_if(attempts.begin(), attempts.end(),
                          [](const bracket::Attempt& attempt) {
                            return attempt.status != solver::SolverStatus::solved;
                          }),
            2);  // one below, one above
}

TEST(Slope, KeepsToItsBudgetAndSaysWhatWasCertified) {
  const auto problem = shipped("slope_gentle");
  ASSERT_TRUE(problem);
  bracket::BracketOptions narrow;
  narrow.gap = 1e-6;
  narrow.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(problem->associated, narrow, {});
  EXPECT_FALSE(found.bracket.reached);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, *found.upper);
  // No time at all: nothing is begun, and nothing is said.
  narrow.max_seconds = 1e-9;
  const bracket::Solution nothing = bracket::solution_of(problem->associated, narrow, {});
  EXPECT_FALSE(nothing.lower || nothing.upper);
  EXPECT_LE(nothing.bracket.attempts.size(), 1U);
}

// tan(phi) / tan(beta), exact for a face without cohesion: nothing needs to be solved.
TEST(Slope, OfDrySandIsThatOfASkinOfIt) {
  const auto problem =
      shipped("slope_gentle", {"material.soil.cohesion=0", "material.soil.friction_angle=40"});
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  const double exact = 2.0 * std::tan(40.0 * std::numbers::pi / 180.0);
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(*found.lower, exact, rounding);
  EXPECT_NEAR(*found.upper, exact, rounding);
  EXPECT_TRUE(found.bracket.reached);
}

// Off a face that hangs over the weight draws a skin, which no friction holds, nor cohesion where
// there is no tension: the weight's share across it would have to be borne as one. Any tension is
// enough for a skin.
TEST(Slope, ThatHangsOverHasNoSkinWithoutTension) {
  const auto hanging = [](const std::string& cohesion, const std::vector<std::string>& more) {
    std::vector<std::string> settings{
        "material.soil.cohesion=" + cohesion,
        "region.0.outline=[[-5,-4],[14,-4],[14,6],[-2,6],[0,0],[-5,0]]",
        "side.slope.along=[[-5,0],[0,0],[-2,6],[14,6]]"};
    settings.insert(settings.end(), more.begin(), more.end());
    return shipped("slope_safety", settings);
  };
  for (const auto& problem :
       {hanging("0", {}), hanging("15e3", {"material.soil.tension_cutoff=0"})}) {
    ASSERT_TRUE(problem);
    const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
    ASSERT_TRUE(found.lower && found.upper);
    EXPECT_EQ(*found.lower, 0.0);
    EXPECT_EQ(*found.upper, 0.0);
    EXPECT_THAT(problem->associated.notes,
                ::testing::Contains(::testing::HasSubstr("bears nothing")));
  }
  const auto held = hanging("15e3", {"material.soil.tension_cutoff=1"});
  ASSERT_TRUE(held);
  EXPECT_FALSE(held->associated.known_upper);
}

// Nothing known in closed form, stresses of sand come as close to its skin as they are asked to.
TEST(Slope, OfDrySandBearsByCertifiedStressesWhatItsSkinDoes) {
  auto problem =
      shipped("slope_gentle", {"material.soil.cohesion=0", "material.soil.friction_angle=40"});
  ASSERT_TRUE(problem);
  problem->associated.known_lower.reset();
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.bracket.lower);
  const double exact = 2.0 * std::tan(40.0 * std::numbers::pi / 180.0);
  EXPECT_LT(*found.lower, exact);
  EXPECT_LE(found.gap(), options().gap);
  EXPECT_GE(found.bracket.lower_bound(), 1.0 / problem->associated.units.multiplier());
}

// Sand over two soils with cohesion: a mechanism through all of them is weaker than the sand's
// skin.
TEST(Slope, OfSandOverClaysHasBothBounds) {
  const auto problem = shipped("acads_layers");
  ASSERT_TRUE(problem);
  bracket::BracketOptions roughly;
  roughly.gap = 0.1;
  const bracket::Solution found = bracket::solution_of(problem->associated, roughly, {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(found.gap(), roughly.gap);
  EXPECT_LT(*found.upper, *problem->associated.known_upper);
  // Methods of slices, 1.357 (Janbu) to 1.405 (Bishop).
  EXPECT_LT(*found.lower, 1.405);
  EXPECT_GT(*found.upper, 1.357);
}

// At a factor that clay does not have the loads are not carried, but stresses under less of them,
// enlarged, are within a strength that is divided by less.
TEST(Slope, HasALowerBoundFromStressesThatCarryLess) {
  const auto problem = shipped("vertical_cut", {"load.sought=strength"});
  ASSERT_TRUE(problem);
  const problem::Case& cut = problem->associated;
  problem::Problem scaled = problem::in_units(cut.lower, cut.units);
  const double one = 1.0 / cut.units.multiplier();
  const bracket::Means means;
  bracket::Flank flank(scaled, true, one, means);
  std::vector<bracket::Attempt> attempts;
  flank.solve_at(6.0, {}, {}, attempts);
  EXPECT_FALSE(flank.factor());
  ASSERT_TRUE(flank.enlarged_factor());
  const double factor = *flank.enlarged_factor();
  // gamma H / c is one here.
  EXPECT_LT(factor, 3.778);
  EXPECT_GT(factor, 3.0);
  bracket::Bracket found;
  flank.give(found);
  ASSERT_TRUE(found.lower);
  scaled.mesh = found.lower->mesh;
  scaled.soils = bracket::weakened(scaled.soils, factor);
  const auto certificate = certificate::certify_lower(scaled, found.lower->certificate.field, one);
  EXPECT_TRUE(certificate.holds);
  EXPECT_EQ(certificate.kept, 1.0);
}

// What a mesh will not give is not sought on it: the next one is.
TEST(Slope, IsNotFollowedOnAMeshThatGivesNoMoreThanIsKnown) {
  const auto problem = shipped("vertical_cut", {"load.sought=strength"});
  ASSERT_TRUE(problem);
  const problem::Case& cut = problem->associated;
  const problem::Problem scaled = problem::in_units(cut.upper, cut.units);
  const bracket::Means means;
  const auto solves = [&](std::optional<double> known) {
    bracket::Flank flank(scaled, false, 1.0 / cut.units.multiplier(), means);
    flank.start_from(3.5, 1.3);
    std::vector<bracket::Attempt> attempts;
    flank.settle([] { return 0.02; }, [&] { return known; },
                 [&](bracket::Flank& of, double factor) {
                   of.solve_at(factor, {}, {}, attempts);
                   return true;
                 });
    return attempts.size();
  };
  // The factor is 3.776 to 3.778, below what the first mesh has.
  EXPECT_GT(solves(std::nullopt), 1U);
  EXPECT_EQ(solves(3.5), 1U);
}

TEST(Slope, OfSandWhoseWeightAloneGrowsIsRefused) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / "limit" / "slope_gentle.toml";
  const std::vector<std::string> settings{"material.soil.cohesion=0", "load.sought=gravity"};
  const auto scene = ground::read_ground_scene(std::get<std::string>(scene::text_of(file)),
                                               settings, diagnosis, unreadable);
  ASSERT_TRUE(scene);
  EXPECT_FALSE(ground::ground_case(*scene, diagnosis));
  ASSERT_EQ(diagnosis.errors().size(), 1U);
  EXPECT_THAT(diagnosis.errors()[0].text(),
              ::testing::AllOf(::testing::HasSubstr("load.sought"),
                               ::testing::HasSubstr("in proportion to the load that grows"),
                               ::testing::HasSubstr("strength")));
}

// Soft clay under strong ground.
constexpr const char* squeezed_clay = R"([load]
sought = "strength"
[[material]]
name = "top"
cohesion = 37e3
friction_angle = 46
unit_weight = 13e3
[[material]]
name = "middle"
cohesion = 98e3
friction_angle = 15
unit_weight = 13e3
[[material]]
name = "clay"
cohesion = 250
friction_angle = 0
unit_weight = 21e3
[[region]]
material = "top"
outline = [[-50, 6], [4.8, 6], [0, 15], [-50, 15]]
[[region]]
material = "middle"
outline = [[-50, -2], [58, -2], [58, 0], [8, 0], [4.8, 6], [-50, 6]]
[[region]]
material = "clay"
outline = [[-50, -10], [58, -10], [58, -2], [-50, -2]]
[[side]]
name = "surface"
kind = "free"
along = [[-50, 15], [0, 15], [8, 0], [58, 0]]
[[side]]
name = "walls"
kind = "roller"
along = [[-50, 15], [-50, -10]]
[[side]]
name = "base"
kind = "fixed"
along = [[-50, -10], [58, -10]]
[[side]]
name = "right"
kind = "roller"
along = [[58, -10], [58, 0]]
)";

// Soft clay is squeezed out under strong ground, whose friction is 80 degrees and more at such a
// factor: it bends like a plate, squeezed along itself by next to nothing as it grows across.
// Triangles as long as they are high do not show that, nor the thrust in it.
TEST(SteepSoil, IsBorneBetterByLongTriangles) {
  const auto cases = case_of(squeezed_clay);
  ASSERT_TRUE(cases);
  const problem::Case& of = cases->associated;
  ASSERT_EQ(of.long_lower.size(), 2U);
  std::vector<double> carried;
  for (const mesh::Mesh& mesh : {of.lower.mesh, of.long_lower.back()}) {
    problem::Problem lower = of.lower;
    lower.mesh = mesh;
    lower = problem::in_units(lower, of.units);
    lower.soils = bracket::weakened(lower.soils, 0.05);
    bracket::Side side(lower, true);
    bracket::Bracket found;
    side.attempt(found, {}, {});
    ASSERT_TRUE(found.lower);
    carried.push_back(found.lower_bound());
  }
  EXPECT_LE(of.long_lower.back().triangles.size(), of.lower.mesh.triangles.size());
  EXPECT_GT(carried[1], 2.0 * carried[0]);
}

// The means of such soils, and blocks, are off by a factor of ten and more; it costs next to
// nothing to see that on few triangles, and a second for each look on the first meshes.
TEST(SteepSoil, IsLookedAtRoughlyFirst) {
  const auto cases = case_of(squeezed_clay);
  ASSERT_TRUE(cases);
  const problem::Case& of = cases->associated;
  const auto few = static_cast<int>(of.rough_upper.triangles.size());
  ASSERT_LT(3 * few, static_cast<int>(of.upper.mesh.triangles.size()));
  // A clock that ticks by solves: it ends after six.
  double solves = 0.0;
  bracket::Means means;
  means.seconds = [&] { return solves; };
  means.solve = [&](const auto& program, const auto& options) {
    ++solves;
    return solver::solve(program, options);
  };
  bracket::BracketOptions options;
  options.max_seconds = 6.0;
  const bracket::Solution found = bracket::reduce_strength(of, options, {}, means);
  ASSERT_TRUE(found.upper);
  int rough = 0, finer = 0;
  for (const bracket::Attempt& attempt : found.bracket.attempts) {
    const bool is_rough = attempt.triangles <= few;
    ++(is_rough ? rough : finer);
    EXPECT_TRUE(is_rough || *attempt.factor < *found.upper);
  }
  EXPECT_GT(rough, 0);
  EXPECT_GT(finer, 0);
}

}  // namespace

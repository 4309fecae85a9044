// Blocks that turn along spirals: the known ones are found, and what is none proves nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "limit/block/block_search.hpp"
#include "limit/bracket/strength_reduction.hpp"
#include "limit/certificate/block_certificate.hpp"
#include "limit/ground/ground_cases.hpp"

namespace {

using namespace limit;

// In units of order one, the height of what is free being two.
problem::Problem scaled(const problem::Case& problem) {
  return problem::in_units(problem.upper, problem.units);
}

block::Weakest weakest_of(const problem::Problem& problem) {
  constexpr double height = 2.0;
  const auto found = block::BlockSearch(problem, height).weakest(problem.soils);
  EXPECT_TRUE(found);
  return found.value_or(block::Weakest{});
}

// A slope of 1:1, 10 m high, of two or three layers over a stiff one.
std::string layers(double upper_weight, double lower_weight) {
  return "[load]\nsought = \"gravity\"\n"
         "[[material]]\nname = \"upper\"\ncohesion = 20e3\nfriction_angle = 15\nunit_weight = " +
         std::to_string(upper_weight) +
         "\n[[material]]\nname = \"lower\"\ncohesion = 20e3\nfriction_angle = 15\nunit_weight = " +
         std::to_string(lower_weight) +
         "\n[[region]]\nmaterial = \"upper\"\n"
         "outline = [[-30, 4], [6, 4], [0, 10], [-30, 10]]\n"
         "[[region]]\nmaterial = \"lower\"\n"
         "outline = [[-30, -10], [40, -10], [40, 0], [10, 0], [6, 4], [-30, 4]]\n"
         "[[side]]\nname = \"surface\"\nkind = \"free\"\n"
         "along = [[-30, 10], [0, 10], [10, 0], [40, 0]]\n"
         "[[side]]\nname = \"rigid\"\nkind = \"fixed\"\n"
         "along = [[-30, 10], [-30, -10], [40, -10], [40, 0]]\n";
}

TEST(TurningBlock, OfAnUprightCutInClayIsFelleniusCircle) {
  const auto problem = shipped("vertical_cut");
  ASSERT_TRUE(problem);
  const problem::Case& cut = problem->associated;
  const double multiplier = weakest_of(scaled(cut)).multiplier * cut.units.multiplier();
  // gamma H / c = 3.83 to three digits (Fellenius 1927; Chen 1975), of a weight of one times that.
  const problem::Soil& clay = cut.lower.soils[0];
  constexpr double height = 1.0;
  EXPECT_NEAR(multiplier * clay.live_unit_weight * height / clay.cohesion, 3.83, 0.005);
}

TEST(TurningBlock, OfAFrictionalSlopeIsChensSpiral) {
  const auto problem = shipped("slope");
  ASSERT_TRUE(problem);
  const problem::Case& slope = problem->associated;
  const problem::Soil& soil = slope.lower.soils[0];
  const double multiplier = weakest_of(scaled(slope)).multiplier * slope.units.multiplier();
  double low = 0.0, high = 0.0;
  for (const mesh::BoundaryEdge& edge : slope.lower.mesh.boundary) {
    if (slope.lower.boundaries[static_cast<std::size_t>(edge.boundary)].normal !=
        problem::Known::traction) {
      continue;
    }
    const double y = slope.lower.mesh.nodes[static_cast<std::size_t>(edge.first)].y();
    low = std::min(low, y);
    high = std::max(high, y);
  }
  const double number = multiplier * soil.live_unit_weight * (high - low) / soil.cohesion;
  // 10.3907, the same as the table of the document has it.
  EXPECT_NEAR(number, 10.3907, 10.3907 * 1e-4);
}

TEST(TurningBlock, TurnsTheOtherWayInAMirror) {
  const auto problem = shipped("slope");
  ASSERT_TRUE(problem);
  const block::Weakest one = weakest_of(scaled(problem->associated));
  const problem::Problem mirrored = block::mirrored(scaled(problem->associated));
  const block::Weakest other = weakest_of(mirrored);
  EXPECT_NE(one.block.clockwise, other.block.clockwise);
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(one.multiplier, other.multiplier, rounding * one.multiplier);
  // And is proved in the ground that it is in, not in the mirror.
  EXPECT_TRUE(certificate::certify_block(mirrored, other.block).holds());
  EXPECT_FALSE(certificate::certify_block(mirrored, one.block).holds());
}

// A seam between layers of one weight says nothing, one of two weights is counted: the search by
// wedges under the outline, the certificate by rays.
TEST(TurningBlock, CountsTheWeightOfEachLayer) {
  const auto even = case_of(layers(20e3, 20e3)), mixed = case_of(layers(14e3, 22e3));
  ASSERT_TRUE(even && mixed);
  double before = 0.0;
  for (const problem::Cases* cases : {&*even, &*mixed}) {
    const problem::Problem problem = scaled(cases->associated);
    const block::Weakest found = weakest_of(problem);
    const auto certificate = certificate::certify_block(problem, found.block);
    EXPECT_EQ(certificate.objection, "");
    constexpr double rounding = 1e-9;
    EXPECT_NEAR(certificate.multiplier, found.multiplier, rounding * found.multiplier);
    const double multiplier = found.multiplier * cases->associated.units.multiplier();
    if (before > 0.0) {
      // Between those of the same block under either weight alone.
      EXPECT_GT(multiplier, before * 20.0 / 22.0);
      EXPECT_LT(multiplier, before * 20.0 / 14.0);
    }
    before = multiplier;
  }
}

// A slope of 1:1 with tractions on its crest and on the rest of what is free.
std::string loaded(double friction, const char* crest, const char* rest) {
  return "[load]\nsought = \"gravity\"\n[[material]]\nname = \"soil\"\ncohesion = 20e3\n"
         "unit_weight = 18e3\nfriction_angle = " +
         std::to_string(friction) +
         "\n[[region]]\nmaterial = \"soil\"\n"
         "outline = [[-30, -10], [40, -10], [40, 0], [10, 0], [0, 10], [-30, 10]]\n"
         "[[side]]\nname = \"crest\"\nkind = \"loaded\"\nalong = [[-30, 10], [0, 10]]\n" +
         crest +
         "\n[[side]]\nname = \"face\"\nkind = \"loaded\"\n"
         "along = [[0, 10], [10, 0], [40, 0]]\n" +
         rest +
         "\n[[side]]\nname = \"rigid\"\nkind = \"fixed\"\n"
         "along = [[-30, 10], [-30, -10], [40, -10], [40, 0]]\n";
}

// Tractions on the outline, given by the search piece by piece and by the certificate along rays,
// in a mirror, too. A pressure on the crest drives, one of a fluid all round does no work on clay,
// whose block turns on a circle: the same normal stress there would have no moment either.
TEST(TurningBlock, CountsTheTractionsOnTheGround) {
  constexpr double rounding = 1e-9;
  const auto proved = [](const problem::Problem& ground) {
    const block::Weakest found = weakest_of(ground);
    const auto certificate = certificate::certify_block(ground, found.block);
    EXPECT_EQ(certificate.objection, "");
    EXPECT_NEAR(certificate.multiplier, found.multiplier, rounding * found.multiplier);
    return found.multiplier;
  };
  const auto of = [&](double friction, const char* crest, const char* rest) {
    const auto problem = case_of(loaded(friction, crest, rest));
    EXPECT_TRUE(problem);
    const problem::Case& slope = problem->associated;
    return proved(scaled(slope)) * slope.units.multiplier();
  };
  const double clay = of(0.0, "", "");
  constexpr double found_again = 1e-6;
  EXPECT_NEAR(of(0.0, "pressure = 8e3", "pressure = 8e3"), clay, found_again * clay);
  EXPECT_LT(of(0.0, "pressure = 8e3", ""), 0.99 * clay);
  // Towards the face, and away from it.
  const double one = of(20.0, "shear = 4e3", ""), other = of(20.0, "shear = -4e3", "");
  EXPECT_GT(std::abs(std::log(one / other)), 0.02);
  const auto problem = case_of(loaded(20.0, "shear = 4e3", ""));
  ASSERT_TRUE(problem);
  const double in_mirror = proved(block::mirrored(scaled(problem->associated)));
  EXPECT_NEAR(in_mirror * problem->associated.units.multiplier(), one, rounding * one);
}

TEST(BlockCertificate, HoldsForNothingButAMechanism) {
  const auto problem = case_of(layers(14e3, 22e3));
  ASSERT_TRUE(problem);
  const problem::Problem ground = scaled(problem->associated);
  const problem::TurningBlock good = weakest_of(ground).block;
  ASSERT_TRUE(certificate::certify_block(ground, good).holds());
  const auto objection = [&](const auto& spoil) {
    problem::TurningBlock bad = good;
    spoil(bad);
    return certificate::certify_block(ground, bad).objection;
  };
  EXPECT_EQ(objection([](auto& block) { block.arcs.clear(); }), "no curve");
  EXPECT_EQ(objection([](auto& block) { block.arcs[0].growth *= 1.001; }),
            good.arcs.size() > 1 ? "arcs that do not meet"
                                 : "the curve is not at the friction angle of its soil");
  EXPECT_EQ(objection([](auto& block) {
              block.pole = {-1.0, -1.0};
            }),
            "the pole lies in the ground");
  EXPECT_NE(objection([](auto& block) { block.arcs[0].upper += 7.0; }), "");
  // The curve ends in the ground.
  EXPECT_EQ(objection([](auto& block) { block.arcs.back().lower += 0.2; }),
            "ground between the pole and an end of the curve");
  // Where the toe is held it does not fail that way.
  problem::Problem held = ground;
  for (problem::Boundary& side : held.boundaries) {
    side.normal = side.tangential = problem::Known::support;
  }
  EXPECT_EQ(certificate::certify_block(held, good).objection, "side surface does not let it move");
}

// Along the face, less is sought than a mesh could find.
TEST(TurningBlock, BoundsSteepSlopesOfNextToNoCohesion) {
  // c / (gamma H), gamma H being one: some 5 % by mechanisms of a mesh in ten times the time.
  const auto problem = shipped("slope", {"load.sought=strength", "material.soil.cohesion=1e-3"});
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 4000;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.block && found.lower);
  EXPECT_TRUE(found.bracket.reached);
  EXPECT_EQ(found.upper, found.block->factor);
  // Friction alone holds nothing steeper.
  EXPECT_GT(*found.upper, std::tan(problem->associated.lower.soils[0].friction_angle) /
                              std::tan(60.0 * std::numbers::pi / 180.0));
}

TEST(TurningBlock, LeavesTheMechanismOfAMeshToThoseWhoWantItsPicture) {
  const auto problem = shipped("slope_gentle");
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.gap = 0.05;
  const bracket::Solution without = bracket::solution_of(problem->associated, options, {});
  EXPECT_FALSE(without.bracket.upper);
  options.wants_mechanism = true;
  const bracket::Solution with = bracket::solution_of(problem->associated, options, {});
  EXPECT_TRUE(with.bracket.upper);
  EXPECT_LE(*with.upper, *without.upper);
}

}  // namespace

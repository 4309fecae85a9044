// Ground that an earthquake shakes: weights aslant, and how far aslant they may be.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limit/block/block_search.hpp"
#include "limit/certificate/block_certificate.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scenes.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;

bracket::BracketOptions options() {
  bracket::BracketOptions options;
  options.gap = 0.04;
  return options;
}

// A slope of 1:2, turned as a whole: points by `turn` about the origin, counterclockwise, and as
// its mirror image if `mirror` is -1.
std::string slope(const std::string& load, double unit_weight, double turn, double mirror) {
  const auto at = [&](double x, double y) {
    const double c = std::cos(turn), s = std::sin(turn);
    return fmt::format("[{:.17g}, {:.17g}]", mirror * (c * x - s * y), s * x + c * y);
  };
  std::string text = "[load]\n" + load;
  text += fmt::format(
      "[[material]]\nname = \"soil\"\ncohesion = 10e3\nfriction_angle = 20\nunit_weight = "
      "{:.17g}\n",
      unit_weight);
  text += "[[region]]\nmaterial = \"soil\"\noutline = [" + at(-15, -5) + ", " + at(25, -5) + ", " +
          at(25, 0) + ", " + at(10, 0) + ", " + at(0, 5) + ", " + at(-15, 5) + "]\n";
  text += "[[side]]\nname = \"surface\"\nkind = \"free\"\nalong = [" + at(-15, 5) + ", " +
          at(0, 5) + ", " + at(10, 0) + ", " + at(25, 0) + "]\n";
  return text + "[[side]]\nname = \"rigid\"\nkind = \"fixed\"\nalong = [" + at(-15, 5) + ", " +
         at(-15, -5) + ", " + at(25, -5) + ", " + at(25, 0) + "]\n";
}

constexpr double kh = 0.2, weight = 18e3;

std::string shaken(const char* sought, double mirror) {
  return slope(fmt::format("sought = \"{}\"\nkh = {:.17g}\n", sought, mirror * kh), weight, 0.0,
               mirror);
}

// The same slope at rest, turned until its weight points down.
std::string turned(const char* sought, double mirror) {
  return slope(fmt::format("sought = \"{}\"\n", sought), weight * std::sqrt(1.0 + kh * kh),
               -std::atan(kh), mirror);
}

bracket::Solution solution(const std::string& text) {
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  return problem ? bracket::solution_of(problem->associated, options(), {}) : bracket::Solution{};
}

// Both brackets hold the same collapse.
void expect_one_answer(const bracket::Solution& one, const bracket::Solution& other) {
  ASSERT_TRUE(one.lower && one.upper && other.lower && other.upper);
  EXPECT_TRUE(one.bracket.reached);
  EXPECT_TRUE(other.bracket.reached);
  EXPECT_LE(*one.lower, *other.upper);
  EXPECT_LE(*other.lower, *one.upper);
}

// Weight and shaking together are a weight aslant; turned round, ground does not know of it.
TEST(Earthquake, IsAWeightThatIsAslant) {
  for (const char* sought : {"gravity", "strength"}) {
    SCOPED_TRACE(sought);
    expect_one_answer(solution(shaken(sought, 1.0)), solution(turned(sought, 1.0)));
  }
}

// A programme's optimum is what it makes of the loads, a certificate's bound is counted anew: where
// the one shakes the ground as the other does, they agree to the solver's digits, on either side.
// With gravity, kh is live; where kh is sought, the weight is dead, and where a shear is, both are.
TEST(Earthquake, IsTheSameToProgrammesAndCertificates) {
  for (const char* sought : {"gravity", "earthquake", "traction"}) {
    std::string text = shaken(sought, 1.0);
    const std::string free = "kind = \"free\"";
    if (sought == std::string("traction")) {
      text.replace(text.find(free), free.size(), "kind = \"loaded\"\nlive_shear = 1e3");
    }
    const auto problem = case_of(text);
    ASSERT_TRUE(problem);
    bracket::BracketOptions once;
    once.max_triangles = 1;
    once.fall_back = false;
    const bracket::Solution found = bracket::solution_of(problem->associated, once, {});
    ASSERT_TRUE(found.lower && found.upper);
    ASSERT_EQ(found.bracket.attempts.size(), 2U);
    for (const bracket::Attempt& attempt : found.bracket.attempts) {
      ASSERT_TRUE(attempt.certified);
      constexpr double digits = 1e-4;  // ten times the gap that the solver ends at
      EXPECT_NEAR(*attempt.certified / attempt.proposed, 1.0, digits) << sought;
    }
  }
}

// Spirals turn with the ground. Mirror images turn the other way round, as their earthquakes do.
TEST(Earthquake, TurnsBlocksAsAWeightAslantDoes) {
  constexpr double height = 2.0;
  std::vector<double> multipliers;
  for (const double mirror : {1.0, -1.0}) {
    for (const std::string& text : {shaken("gravity", mirror), turned("gravity", mirror)}) {
      const auto problem = case_of(text);
      ASSERT_TRUE(problem);
      const problem::Case& ground = problem->associated;
      const problem::Problem scaled = problem::in_units(ground.upper, ground.units);
      const auto found = block::BlockSearch(scaled, height).weakest(scaled.soils);
      ASSERT_TRUE(found);
      // Rays and wedges, two ways to the same moments, agree to nine digits.
      const auto certificate = certificate::certify_block(scaled, found->block);
      EXPECT_NEAR(certificate.multiplier / found->multiplier, 1.0, 1e-9);
      multipliers.push_back(found->multiplier * ground.units.multiplier() *
                            ground.lower.soils[0].live_unit_weight * ground.lower.live_pull.norm());
    }
  }
  // At a minimum the multiplier is flat: what the search leaves over is of second order.
  for (const double one : multipliers) EXPECT_NEAR(one / multipliers[0], 1.0, 1e-3);
}

// A slope of 3:1: critical kh 0.43, at which its factor is 1 (Loukidis, Bandini and Salgado 2003).
TEST(Earthquake, HasThePublishedSlopesCriticalAcceleration) {
  const auto problem = shipped("earthquake");
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.bracket.reached);
  constexpr double digits = 0.005;
  EXPECT_LT(*found.lower, 0.43 + digits);
  EXPECT_GT(*found.upper, 0.43 - digits);
}

TEST(Earthquake, LeavesThePublishedSlopeAFactorOfOneAtItsCriticalAcceleration) {
  const auto problem = shipped("earthquake", {"load.sought=strength", "load.kh=0.43"});
  ASSERT_TRUE(problem);
  const bracket::Solution found = bracket::solution_of(problem->associated, options(), {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_TRUE(found.bracket.reached);
  EXPECT_LT(*found.lower, 1.0);
  EXPECT_GT(*found.upper, 0.99);
}

// What is lifted is weight that is not there; what is pressed down is more of it.
TEST(Earthquake, ThatIsVerticalChangesTheWeightAlone) {
  for (const double kv : {0.25, -0.25}) {
    const auto lifted =
        case_of(slope(fmt::format("sought = \"strength\"\nkv = {}\n", kv), weight, 0.0, 1.0));
    const auto lighter = case_of(slope("sought = \"strength\"\n", weight * (1.0 - kv), 0.0, 1.0));
    ASSERT_TRUE(lifted && lighter);
    const bracket::Solution one = bracket::solution_of(lifted->associated, options(), {});
    const bracket::Solution other = bracket::solution_of(lighter->associated, options(), {});
    expect_one_answer(one, other);
  }
}

// In sand a skin of the face is first to slide, under a weight aslant as on a steeper face.
TEST(Earthquake, OfASandyFaceSlidesItsSkin) {
  constexpr double degree = std::numbers::pi / 180.0;
  for (const double kh_here : {0.1, -0.1, -0.3}) {
    const auto problem =
        shipped("slope_gentle", {"material.soil.cohesion=0", "material.soil.friction_angle=40",
                                 fmt::format("load.kh={}", kh_here), "load.kv=0.2"});
    ASSERT_TRUE(problem);
    const problem::Case& slope = problem->associated;
    const double aslant = std::atan(std::abs(kh_here) / 0.8);
    // Downhill on the face of 1:2, and on level ground either way.
    const double steepest = kh_here > 0.0 ? std::atan(0.5) + aslant : std::atan(0.5) - aslant;
    ASSERT_TRUE(slope.known_upper);
    EXPECT_NEAR(*slope.known_upper, std::tan(40.0 * degree) / std::tan(std::max(steepest, aslant)),
                1e-12);
    EXPECT_FALSE(slope.known_lower);
    // Stresses come up to it: nothing else is weaker.
    const bracket::Solution found = bracket::solution_of(slope, options(), {});
    ASSERT_TRUE(found.lower && found.upper);
    EXPECT_LE(*found.lower, *slope.known_upper);
    EXPECT_LE(found.gap(), options().gap);
  }
}

TEST(Earthquake, IsRefusedWhereItCannotBe) {
  const auto with = [](const std::vector<std::string>& settings) {
    return read(cut, settings).errors;
  };
  EXPECT_THAT(with({"load.kv=1"}),
              AllOf(HasSubstr("load.kv"), HasSubstr("found 1"), HasSubstr("-1 <= value < 1")));
  EXPECT_THAT(with({"load.kh=east"}), AllOf(HasSubstr("load.kh"), HasSubstr("a number")));
  EXPECT_THAT(with({"load.sought=earthquake"}),
              AllOf(HasSubstr("load.sought"), HasSubstr("an earthquake wants kh, 1 or -1")));
  EXPECT_THAT(with({"load.sought=earthquake", "load.kh=1", "material.clay.grows=false"}),
              HasSubstr("a unit_weight that grows"));
  EXPECT_THAT(read(layered, {"load.kh=0.1"}).errors,
              AllOf(HasSubstr("side.2.kind"), HasSubstr("found symmetry, and kh = 0.1"),
                    HasSubstr("kind roller")));
  EXPECT_EQ(read(layered, {"load.kv=0.1"}).errors, "");
  // Line 3 of the text.
  std::string text = cut;
  text.insert(text.find("[[material]]"), "kv = 1.5\n");
  EXPECT_THAT(read(text).errors, AllOf(HasSubstr("ground.toml:3"), HasSubstr("load.kv")));
}

}  // namespace

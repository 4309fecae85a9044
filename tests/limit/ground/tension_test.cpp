// Soil whose tension is cut off: Rankine's cone beside Mohr and Coulomb's, in both programmes and
// both certificates. What takes longer is in validation/tension_validation_test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "limit/certificate/lower_certificate.hpp"
#include "limit/ground/tension_scenes.hpp"
#include "limit/problem/bare_corners.hpp"

namespace {

using namespace limit;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

std::string material(double friction, const std::string& cut) {
  return fmt::format(
      "[[material]]\nname = \"soil\"\ncohesion = 1e3\nfriction_angle = {}\nunit_weight = {}\n{}\n",
      friction, 0.0, cut);
}

// A block two wide and three high on a smooth base, pulled or pushed at its top.
std::string block(double friction, const std::string& cut, double push) {
  return "[load]\nsought = \"traction\"\n" + material(friction, cut) +
         fmt::format(R"([[region]]
material = "soil"
outline = [[0, 0], [2, 0], [2, 3], [0, 3]]
[[side]]
name = "faces"
kind = "free"
along = [[2, 0], [2, 3]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, 3]]
[[side]]
name = "top"
kind = "loaded"
along = [[0, 3], [2, 3]]
live_pressure = {}
[[side]]
name = "base"
kind = "roller"
along = [[0, 0], [2, 0]]
)",
                     push);
}

bracket::Solution solution(const std::string& text, double gap = 0.01) {
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  bracket::BracketOptions options;
  options.gap = gap;
  return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
}

// One state of stress is exact: the least of the cut-off and of Mohr and Coulomb's tension.
TEST(TensionCutOff, IsAllThatAPulledBlockBears) {
  for (const double friction : {0.0, 20.0}) {
    const double phi = friction * degree;
    const double uncut = 2e3 * std::cos(phi) / (1.0 + std::sin(phi));
    for (const double tension : {30.0, 0.5 * uncut, 1.1 * uncut}) {
      const bracket::Solution found =
          solution(block(friction, fmt::format("tension_cutoff = {}", tension), -1.0));
      ASSERT_TRUE(found.lower && found.upper) << friction << ' ' << tension;
      const double exact = std::min(tension, uncut);
      constexpr double reserve = 1e-5;  // of the solver and of the lower programme
      EXPECT_LE(*found.lower, exact * (1.0 + 1e-9));
      EXPECT_GE(*found.upper, exact * (1.0 - 1e-9));
      EXPECT_NEAR(*found.lower, exact, 10.0 * reserve * uncut) << friction << ' ' << tension;
      EXPECT_NEAR(*found.upper, exact, 10.0 * reserve * uncut) << friction << ' ' << tension;
    }
  }
}

// In compression it changes nothing.
TEST(TensionCutOff, DoesNotMatterToAPushedBlock) {
  const double phi = 20.0 * degree;
  const double exact = 2e3 * std::cos(phi) / (1.0 - std::sin(phi));
  const bracket::Solution found = solution(block(20.0, "tension_cutoff = 10", 1.0));
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(*found.lower, exact * (1.0 + 1e-9));
  EXPECT_GE(*found.upper, exact * (1.0 - 1e-9));
  EXPECT_LT(found.gap(), 0.01);
}

// The certificate knows the cut-off by itself: a field beyond it is drawn back to it.
TEST(TensionCutOff, IsHeldToByTheCertificateOfStresses) {
  const auto cut = case_of(block(0.0, "tension_cutoff = 500", -1.0));
  ASSERT_TRUE(cut);
  const problem::Problem& problem = cut->associated.lower;
  Eigen::Matrix3d pulled = Eigen::Matrix3d::Zero();
  pulled.row(1).setConstant(1500.0);  // yy, less than 2 c
  const problem::StressField field(problem.mesh.triangles.size(), pulled);
  const auto certificate = certificate::certify_lower(problem, field, 1500.0);
  ASSERT_TRUE(certificate.kept < 1.0);
  EXPECT_NEAR(certificate.multiplier, 500.0, 500.0 * 1e-5);
  EXPECT_LE(certificate.multiplier, 500.0);
}

// Prandtl's field has no tension, and of clay weight changes nothing in it.
TEST(TensionCutOff, OfNothingBearsAStripThatMayLiftOff) {
  const bracket::Solution found = coarse(strip(0.0, 1.0, ""));
  ASSERT_TRUE(found.lower && found.upper);
  const double prandtl = 2.0 + std::numbers::pi;
  EXPECT_LE(*found.lower, prandtl);
  EXPECT_GE(*found.upper, prandtl);
  EXPECT_LT(found.gap(), 0.02);  // 0.9 % on these meshes
  EXPECT_LE(largest_tension(found), 1e-11);
}

// A side that carries nothing of what is sought is as free as a free one.
TEST(TensionCutOff, OfNothingKnowsAFaceWhoseLoadIsNotSought) {
  std::string text = cut(0.0);
  const std::string all = "kind = \"free\"\nalong = [[-2, 0], [0, 0], [0, 1], [2, 1]]";
  text.replace(text.find(all), all.size(),
               "kind = \"free\"\nalong = [[-2, 0], [0, 0]]\n[[side]]\nname = \"top\"\nkind = "
               "\"free\"\nalong = [[0, 1], [2, 1]]\n[[side]]\nname = \"face\"\nkind = \"loaded\"\n"
               "live_pressure = 1\nalong = [[0, 0], [0, 1]]");
  const bracket::Solution found = lower_alone(text);
  ASSERT_TRUE(found.lower);
  EXPECT_LE(*found.lower, 2.0 * (1.0 + 1e-9));
  EXPECT_GT(*found.lower, 1.999);
}

// Where a face turns by more than rounding it is an edge that juts out, which bears nothing.
TEST(TensionCutOff, OfNothingTakesATurnOfAFaceForWhatItIs) {
  for (const double turn : {0.0, 1e-12, 1e-7}) {
    problem::Problem problem;
    problem.mesh.nodes = {{0.0, 0.0}, {1.0, -1.0}, {2.0, 0.0}, {1.0, turn}};
    problem.mesh.triangles = {{{0, 1, 3}, 0}, {{1, 2, 3}, 0}};
    problem.mesh.boundary = {{0, 1, 1}, {1, 2, 1}, {2, 3, 0}, {3, 0, 0}};
    problem::Soil soil;
    soil.cohesion = 1.0;
    soil.tension = 0.0;
    problem.soils = {soil};
    problem.boundaries = {{"face"}, {"rigid", problem::Known::support, problem::Known::support}};
    const auto bare = problem::bare_corners(problem);
    ASSERT_EQ(bare.size(), 2U);
    using Bears = problem::BareCorner::Bears;
    EXPECT_EQ(bare[0][2].bears, turn > 1e-9 ? Bears::nothing : Bears::along) << turn;
    EXPECT_EQ(bare[1][2].bears, bare[0][2].bears) << turn;
  }
}

// Sand without cohesion that reaches a straight face, between clays that bear no tension, empties
// the whole corner: along the face it would bear by friction what nothing presses on.
TEST(TensionCutOff, OfNothingBesideSandBearsNothingAlongTheFace) {
  problem::Problem problem;
  problem.mesh.nodes = {{0.0, 0.0}, {0.5, -1.0}, {1.5, -1.0}, {2.0, 0.0}, {1.0, 0.0}};
  problem.mesh.triangles = {{{0, 1, 4}, 0}, {{1, 2, 4}, 1}, {{2, 3, 4}, 0}};
  problem.mesh.boundary = {{0, 1, 1}, {1, 2, 1}, {2, 3, 1}, {3, 4, 0}, {4, 0, 0}};
  problem::Soil clay, sand;
  clay.cohesion = 1.0;
  clay.tension = 0.0;
  sand.cohesion = 0.0;
  sand.friction_angle = 0.5;
  problem.soils = {clay, sand};
  problem.boundaries = {{"face"}, {"rigid", problem::Known::support, problem::Known::support}};
  const auto bare = problem::bare_corners(problem);
  ASSERT_EQ(bare.size(), 3U);
  for (const auto& triangle : bare) {
    EXPECT_EQ(triangle[2].bears, problem::BareCorner::Bears::nothing);
  }
}

std::string complaint(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

// A slice along an upright face that cannot pull bears nothing that pushes it outwards.
TEST(TensionCutOff, OfNothingIsRefusedWhereAnUprightFaceIsPushedOutwards) {
  std::string shaken = cut(0.0);
  const std::string sought = "sought = \"gravity\"\n";
  shaken.replace(shaken.find(sought), sought.size(), sought + "kh = -0.1\n");
  EXPECT_THAT(complaint(shaken), HasSubstr("load.kh: found -0.1, which pushes the upright face "
                                           "at (0, 1) outwards, where material clay"));
  std::string sheared = cut(0.0);
  const std::string all = "along = [[-2, 0], [0, 0], [0, 1], [2, 1]]\n";
  sheared.replace(sheared.find(all), all.size(),
                  "along = [[-2, 0], [0, 0], [0, 1]]\n[[side]]\nname = \"top\"\nkind = \"loaded\"\n"
                  "shear = 0.1\nalong = [[0, 1], [2, 1]]\n");
  EXPECT_THAT(complaint(sheared), HasSubstr("side.1.shear: found 0.1, which pushes the upright"));
  // Into the ground neither is an error.
  shaken.replace(shaken.find("kh = -0.1"), 9, "kh = 0.1");
  EXPECT_EQ(complaint(shaken), "");
  sheared.replace(sheared.find("shear = 0.1"), 11, "shear = -0.1");
  EXPECT_EQ(complaint(sheared), "");
}

// What grows by the other sign pushes, too, and is named with its value.
TEST(TensionCutOff, OfNothingIsRefusedForTheShearThatPushes) {
  std::string text = cut(0.0);
  const std::string sought = "\"gravity\"", all = "along = [[-2, 0], [0, 0], [0, 1], [2, 1]]\n";
  text.replace(text.find(sought), sought.size(), "\"traction\"");
  text.replace(text.find(all), all.size(),
               "along = [[-2, 0], [0, 0], [0, 1]]\n[[side]]\nname = \"top\"\nkind = \"loaded\"\n"
               "shear = -0.1\nlive_shear = 0.2\nalong = [[0, 1], [2, 1]]\n");
  EXPECT_THAT(complaint(text), HasSubstr("side.1.live_shear: found 0.2, which pushes the upright"));
}

// Water that seeps outwards by 0.15 and an earthquake that pushes inwards by a tenth of the weight:
// 2 in the middle of the ground and 0.5 at the crest.
TEST(TensionCutOff, OfNothingIsRefusedByThePushAtTheFaceItself) {
  std::string text = cut(0.0);
  const std::string sought = "sought = \"gravity\"\n", weight = "unit_weight = 1\n";
  text.replace(text.find(sought), sought.size(),
               sought + "kh = 0.1\n[water]\nunit_weight = 1.0\ntable = [[-2, 2], [2, 2.6]]\n");
  const auto weighing = [&](const char* value) {
    std::string weighed = text;
    return weighed.replace(weighed.find(weight), weight.size(), value);
  };
  EXPECT_THAT(
      complaint(weighing("unit_weight = { at = [0, 0], value = 2, gradient = [0, -1.5] }\n")),
      HasSubstr("material.0.tension_cutoff: found 0, and water that seeps, -0.15 N/m3"));
  EXPECT_EQ(
      complaint(weighing("unit_weight = { at = [0, 0], value = 3.5, gradient = [0, -1.5] }\n")),
      "");
}

// Told before anything is solved.
TEST(TensionCutOff, OfNothingIsWarnedOfUnderALevelTopThatIsLoaded) {
  std::string text = cut(0.0);
  const std::string all = "along = [[-2, 0], [0, 0], [0, 1], [2, 1]]\n";
  text.replace(text.find(all), all.size(),
               "along = [[-2, 0], [0, 0], [0, 1]]\n[[side]]\nname = \"top\"\nkind = \"loaded\"\n"
               "pressure = 0.1\nalong = [[0, 1], [2, 1]]\n");
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  ASSERT_TRUE(scene);
  EXPECT_TRUE(ground::ground_case(*scene, diagnosis));
  ASSERT_EQ(diagnosis.warnings().size(), 1U);
  EXPECT_THAT(diagnosis.warnings().front().text(),
              HasSubstr("side.1.pressure: found 0.1, on top of the upright face at (0, 1), where "
                        "material clay bears no tension; a lower bound may"));
}

TEST(TensionCutOff, ThatLeavesNothingOrIsBesideTheApexIsRefusedInWords) {
  EXPECT_THAT(complaint(block(20.0, "tension_cutoff = 0", 1.0)),
              HasSubstr("material.0.tension_cutoff: found 0, of soil without weight"));
  EXPECT_THAT(complaint(block(20.0, "tension_cutoff = -1", 1.0)),
              HasSubstr("material.0.tension_cutoff"));
  std::string varying = block(45.0, "tension_cutoff = 1000", 1.0);
  varying.replace(varying.find("cohesion = 1e3"), 14,
                  "cohesion = { at = [0, 1.5], value = 1e3, gradient = [0, 100] }");
  EXPECT_THAT(complaint(varying), HasSubstr("bears 850 Pa of tension in one place and 1150"));
}

}  // namespace

// Pore pressures that are told from place to place.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_pressure.hpp"
#include "limit/ground/ground_water.hpp"
#include "limit/ground/water_scenes.hpp"
#include "limit/mesh/bisection.hpp"
#include "shape/outline.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using namespace told;

// What is linear everywhere, or between the lines of a table, is cut along its lines as ground is
// below a water table: the same weight and the same force of water everywhere.
TEST(PorePressure, ThatATableHasIsThatTable) {
  const auto wet = [](const std::string& water) {
    std::string text = footing(2e3, 17e3, "[water]\nunit_weight = 10e3\n" + water + "\n");
    text.insert(text.find("unit_weight = 17000"), "saturated_unit_weight = 20e3\n");
    tables::Diagnosis diagnosis("scene");
    std::optional<tables::Complaint> unreadable;
    auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
    ground::wet(*scene, diagnosis);
    EXPECT_TRUE(diagnosis.errors().empty());
    return *scene;
  };
  const auto soil_at = [](const ground::GroundScene& scene, const mesh::Point& place) {
    for (const ground::GroundRegion& region : scene.regions) {
      if (shape::is_inside(region.outline, place)) return scene.materials[region.material].soil;
    }
    return problem::Soil{};
  };
  const ground::GroundScene table = wet("table = [[0, -0.5], [5, -0.5]]");
  for (const char* told :
       {"pore_pressure = { at = [0, -0.5], value = 0, gradient = [0, -10e3] }",
        "pore_pressure = { along = \"y\", table = [[-2, 15e3], [-0.5, 0], [0, 0]] }"}) {
    const ground::GroundScene same = wet(told);
    for (const mesh::Point& place : {mesh::Point(0.4, -0.3), mesh::Point(4.0, -0.45),
                                     mesh::Point(0.4, -0.55), mesh::Point(3.0, -1.9)}) {
      const problem::Soil one = soil_at(table, place), other = soil_at(same, place);
      EXPECT_EQ(one.unit_weight, other.unit_weight) << told;
      EXPECT_LT((one.seepage - other.seepage).norm(), 1e-9 * 10e3) << told;
      EXPECT_EQ(one.unit_weight, place.y() > -0.5 ? 17e3 : 20e3);
    }
  }
}

// Water that rises with a gradient i leaves ground a weight of gamma' - i gamma_w, 20 - 10 - 5
// kN/m3: the bounds of the first meshes are those of ground as light as that, but for the solver.
TEST(PorePressure, OfWaterThatRisesLightensTheGround) {
  const auto solution = [](std::string text) {
    for (const auto& [from, to] :
         {std::pair("friction_angle = 25", "friction_angle = 10"),
          std::pair("[[0, -2], [5, -2], [5, 0], [1, 0], [0, 0]]",
                    "[[0, -1], [2.5, -1], [2.5, 0], [1, 0], [0, 0]]"),
          std::pair("[[0, 0], [0, -2]]", "[[0, 0], [0, -1]]"),
          std::pair("[[1, 0], [5, 0]]", "[[1, 0], [2.5, 0]]"),
          std::pair("[[0, -2], [5, -2], [5, 0]]", "[[0, -1], [2.5, -1], [2.5, 0]]")}) {
      text.replace(text.find(from), std::string(from).size(), to);
    }
    const auto problem = case_of(text);
    EXPECT_TRUE(problem);
    bracket::BracketOptions options;
    options.gap = 0.4;
    return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
  };
  const bracket::Solution light = solution(footing(2e3, 5e3, ""));
  const bracket::Solution wet = solution(footing(2e3, 20e3,
                                                 "[water]\npore_pressure = { points = [[0, 0, 0], "
                                                 "[5, 0, 0], [0, -2, 30e3], [5, -2, 30e3], "
                                                 "[2, -1, 15e3]] }\n"));
  ASSERT_TRUE(light.lower && light.upper && wet.lower && wet.upper);
  constexpr double solver = 1e-3;
  EXPECT_NEAR(*wet.lower / *light.lower, 1.0, solver);
  EXPECT_NEAR(*wet.upper / *light.upper, 1.0, solver);
}

// A skin of sand slides as the water in it, told by points, lets it: at tan(phi) / tan(beta)
// (1 - r_u / cos(beta)^2) for seepage along the face.
TEST(PorePressure, ThatIsToldByPointsLetsASkinSlide) {
  const auto found = case_of(slope(0.0, points_in_slope([](double d) { return 10e3 * d; })));
  ASSERT_TRUE(found && found->associated.known_upper);
  const double cosine = std::cos(20.0 * degree);
  // Of points written with as many digits as a number has.
  EXPECT_NEAR(*found->associated.known_upper,
              std::tan(35.0 * degree) / std::tan(20.0 * degree) * (1.0 - 0.5 / (cosine * cosine)),
              1e-9);
}

// On a mesh the pressure of a problem is nowhere less than it is told, or nowhere more, and just as
// told along the surface.
// @return  [Pa] how much it is off at most
double most_off(const problem::Problem& problem, problem::Bound bound) {
  std::mt19937 numbers(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto pressure = problem::pressure_on_mesh(problem, bound);
  const auto& nodes = problem.mesh.nodes;
  double most = 0.0;
  for (std::size_t t = 0; t < problem.mesh.triangles.size(); ++t) {
    const auto& corners = problem.mesh.triangles[t].nodes;
    const auto at = [&](int i) {
      return nodes[static_cast<std::size_t>(corners[static_cast<std::size_t>(i)])];
    };
    for (int k = 0; k < 20; ++k) {
      double a = share(numbers), b = share(numbers);
      if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
      const mesh::Point place = at(0) + a * (at(1) - at(0)) + b * (at(2) - at(0));
      const double here = pressure.nodes[static_cast<std::size_t>(corners[0])] -
                          pressure.force(t).dot(place - at(0));
      const double more =
          (bound == problem::Bound::lower ? 1.0 : -1.0) * (here - problem.pore_pressure->at(place));
      EXPECT_GT(more, -1.0) << "Pa, of 20 kPa and more, at " << place.transpose();
      most = std::max(most, more);
    }
  }
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    if (problem.boundaries[static_cast<std::size_t>(edge.boundary)].name != "surface") continue;
    for (const int node : {edge.first, edge.second}) {
      EXPECT_NEAR(pressure.nodes[static_cast<std::size_t>(node)],
                  problem.pore_pressure->at(nodes[static_cast<std::size_t>(node)]), 1e-6);
    }
  }
  return most;
}

TEST(PorePressure, OnAMeshIsNowhereLessOrNowhereMore) {
  const auto found = case_of(slope(
      1e3, points_in_slope([](double depth) { return 10e3 * depth * (1.0 - 0.05 * depth); })));
  ASSERT_TRUE(found);
  for (const auto bound : {problem::Bound::lower, problem::Bound::upper}) {
    const bool is_lower = bound == problem::Bound::lower;
    EXPECT_GT(most_off(is_lower ? found->associated.lower : found->associated.upper, bound), 100.0)
        << "it does bend";
  }
}

// The water of a block bends across its right angles, where the side across from a corner runs from
// one free face to the other; in two layers there are the meshes for steep and layered soils, too.
// All of them, and what bisection makes of them, bound it.
// Of water that is more within it is the lower bound's that has to be raised there, of water that
// stands around it the upper bound's that has to be lowered.
class PorePressureOfABlock : public testing::TestWithParam<bool> {};

TEST_P(PorePressureOfABlock, AtRightAnglesIsBoundedOnEveryMesh) {
  const bool is_more_within = GetParam();
  const auto found = case_of(
      fmt::format(
          "[water]\npore_pressure = {{ points = [[0, 0, {0}], [2, 0, {0}], [2, 4, {0}], [0, "
          "4, {0}], [1, 2, {1}]] }}\n",
          is_more_within ? 0 : 20e3, is_more_within ? 20e3 : 0) +
      R"([load]
sought = "strength"
[[material]]
name = "upper"
cohesion = 30e3
friction_angle = 20
unit_weight = 20e3
[[material]]
name = "lower"
cohesion = 40e3
friction_angle = 20
unit_weight = 20e3
[[region]]
material = "lower"
outline = [[0, 0], [2, 0], [2, 2], [0, 2]]
[[region]]
material = "upper"
outline = [[0, 2], [2, 2], [2, 4], [0, 4]]
[[side]]
name = "surface"
kind = "free"
along = [[2, 0], [2, 4], [0, 4], [0, 0]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [2, 0]]
)");
  ASSERT_TRUE(found);
  const problem::Case& block = found->associated;
  const auto look_at = [](problem::Problem problem, problem::Bound bound) {
    EXPECT_NO_THROW(static_cast<void>(mesh::edges_of(problem.mesh)));
    static_cast<void>(most_off(problem, bound));
    for (const std::size_t every : {3U, 2U}) {
      std::vector<bool> marked(problem.mesh.triangles.size(), false);
      for (std::size_t t = 0; t < marked.size(); t += every) marked[t] = true;
      problem.mesh = mesh::bisected(problem.mesh, marked);
    }
    static_cast<void>(most_off(problem, bound));
  };
  look_at(block.lower, problem::Bound::lower);
  look_at(block.upper, problem::Bound::upper);
  problem::Problem other = block.upper;
  other.mesh = block.rough_upper;
  look_at(other, problem::Bound::upper);
  for (const mesh::Mesh& mesh : block.long_upper) {
    other.mesh = mesh;
    look_at(other, problem::Bound::upper);
  }
  other = block.lower;
  for (const mesh::Mesh& mesh : block.long_lower) {
    other.mesh = mesh;
    look_at(other, problem::Bound::lower);
  }
}

INSTANTIATE_TEST_SUITE_P(Waters, PorePressureOfABlock, testing::Bool());

std::string complaint_of(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

TEST(PorePressure, ThatIsNoneIsRefusedInWords) {
  const auto complaint = [](const std::string& water) {
    return complaint_of(footing(0.0, 20e3, "[water]\n" + water + "\n"));
  };
  const std::string points =
      "pore_pressure = { points = [[0, 0, 0], [5, 0, 0], [0, -2, 2e4], [5, -2, 2e4]] }\n";
  EXPECT_THAT(complaint(points), IsEmpty());
  EXPECT_THAT(complaint(points + "table = [[0, 0], [5, 0]]"),
              HasSubstr("water.pore_pressure: found beside a table; the pressure is what one"));
  EXPECT_THAT(complaint(points + "r_u = 0.2"),
              HasSubstr("water.pore_pressure: found beside r_u; the pressure is what one"));
  EXPECT_THAT(complaint("pore_pressure = { points = [[0, 0, 0], [5, 0, 0], [0, -2, 2e4]] }"),
              HasSubstr("told of nothing at (5, -2), a corner of the ground"));
  EXPECT_THAT(complaint("pore_pressure = -2e3"), HasSubstr("found nothing above zero, but -2000"));
  std::string saturated = footing(2e3, 17e3, "[water]\n" + points);
  saturated.insert(saturated.find("unit_weight = 17000"), "saturated_unit_weight = 20e3\n");
  EXPECT_THAT(complaint_of(saturated),
              HasSubstr("material.0.saturated_unit_weight: given with a pressure that is told by "
                        "points or a raster; there it is not known along a line where ground is "
                        "saturated"));
}

// Sand boils where the gradient is more than gamma' / gamma_w, whoever tells it.
TEST(PorePressure, ThatLiftsSandIsRefusedInWords) {
  const auto complaint = [](double gradient, bool by_points) {
    const double bottom = 2.0 * 10e3 * (1.0 + gradient);
    return complaint_of(footing(
        0.0, 20e3,
        by_points ? fmt::format("[water]\npore_pressure = {{ points = [[0, 0, 0], [5, 0, 0], [0, "
                                "-2, {0}], [5, -2, {0}]] }}\n",
                                bottom)
                  : fmt::format("[water]\npore_pressure = {{ below = 0, table = [[0, 0], [2, {}]] "
                                "}}\n",
                                bottom)));
  };
  for (const bool by_points : {false, true}) {
    EXPECT_THAT(complaint(0.99, by_points), IsEmpty());
    EXPECT_THAT(
        complaint(1.01, by_points),
        HasSubstr("water.pore_pressure: water lifts soil, which has no cohesion, off the "
                  "side \"surface\" at (3, 0), with 20100 N/m3 and no more than 20000 on it; "
                  "such ground boils"));
  }
}

// Where the weight grows with depth it is that of the face which counts: 20 kN/m3 at the surface,
// whatever the middle of the ground has.
TEST(PorePressure, ThatLiftsSandIsHeldAgainstTheWeightOfTheFace) {
  const auto complaint = [](double bottom) {
    std::string text =
        footing(0.0, 20e3,
                fmt::format("[water]\npore_pressure = {{ points = [[0, 0, 0], [5, 0, 0], [0, -2, "
                            "{0}], [5, -2, {0}]] }}\n",
                            bottom));
    const std::string even = "unit_weight = 20000";
    text.replace(text.find(even), even.size(),
                 "unit_weight = { at = [0, -2], value = 24e3, gradient = [0, -2e3] }");
    return complaint_of(text);
  };
  EXPECT_THAT(complaint(39.8e3), IsEmpty());
  EXPECT_THAT(complaint(42e3), HasSubstr("with 21000 N/m3 and no more than 20000 on it"));
}

// A skin of sand that grows lighter up the face, 20 kN/m3 at its foot, 17 at its head, slides first
// where seepage along the face, of 10 kN/m3 by depth, has the least weight against it.
TEST(PorePressure, LetsASkinSlideWhereItIsLightest) {
  std::string text = slope(0.0, points_in_slope([](double d) { return 10e3 * d; }));
  const std::string even = "unit_weight = 20e3";
  text.replace(text.find(even), even.size(),
               "unit_weight = { at = [0, 0], value = 20e3, gradient = [0, -0.3e3] }");
  const auto found = case_of(text);
  ASSERT_TRUE(found && found->associated.known_upper);
  const double cosine = std::cos(20.0 * degree);
  EXPECT_NEAR(
      *found->associated.known_upper,
      std::tan(35.0 * degree) / std::tan(20.0 * degree) * (1.0 - 10.0 / 17.0 / (cosine * cosine)),
      1e-9);
}

std::string warnings_of(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  EXPECT_TRUE(diagnosis.errors().empty());
  std::string said;
  for (const tables::Complaint& one : diagnosis.warnings()) said += one.text() + '\n';
  return said;
}

// With the sign of a gradient the wrong way around, the surface is under the most water.
TEST(PorePressure, ThatGrowsUpwardsIsWarnedOf) {
  const auto told = [](const std::string& water) {
    return footing(
        2e3, 20e3,
        "[water]\npore_pressure = { at = [0, -2], value = 0, gradient = [0, " + water + "] }\n");
  };
  EXPECT_THAT(
      warnings_of(told("10e3")),
      HasSubstr("water.pore_pressure: found a pressure that grows upwards wherever there is "
                "any; at rest water presses the more, the deeper it is"));
  std::string right = told("-10e3");
  right.replace(right.find("[0, -2], value = 0"), 18, "[0, -2], value = 9e3");
  EXPECT_THAT(warnings_of(right), IsEmpty());
  right.insert(right.find("pore_pressure"), "unit_weight = 10e3\n");
  EXPECT_THAT(warnings_of(right), HasSubstr("water.unit_weight: found 10000 beside pore_pressure; "
                                            "it has no effect"));
}

// What is told on a free face is water that stands there: 19.62 kPa are 2 m of it.
TEST(PorePressure, OnAFreeFaceIsSaidToStandThere) {
  const auto notes = [](double value) {
    const auto found =
        case_of(footing(2e3, 20e3,
                        fmt::format("[water]\npore_pressure = {{ at = [0, 0], value = {}, gradient "
                                    "= [1e3, -10e3] }}\n",
                                    value)));
    EXPECT_TRUE(found);
    return found ? found->associated.notes : std::vector<std::string>{};
  };
  EXPECT_THAT(notes(14.62e3),
              ElementsAre("water stands on the side \"surface\", as told: with up to 19620 Pa, at "
                          "(5, 0), 2 m deep"));
  EXPECT_THAT(notes(-6e3), IsEmpty());
}

// Artesian water of 30 kPa below 1 m of sand of 20 kN/m3 lifts it with 10 kPa, 6 kPa of them left
// below 4 kPa of pressure or under water that stands on it with 4; where no bound is found, that is
// the reason. Of ground that is heavy enough nothing is said.
TEST(PorePressure, AboveTheWeightOnItIsTheReasonForNoBounds) {
  const auto reasons = [](double surface, double artesian, double pressure) {
    std::string text = footing(0.0, 20e3,
                               fmt::format("[water]\npore_pressure = {{ along = \"y\", table = "
                                           "[[-2, {1}], [-1, {0}], [-0.5, {2}], [0, {3}]] }}\n",
                                           artesian, artesian + 10e3, surface + 5e3, surface));
    text.replace(text.find("kind = \"free\""), 13,
                 fmt::format("kind = \"loaded\"\npressure = {}", pressure));
    const auto found = case_of(text);
    EXPECT_TRUE(found);
    return found ? found->associated.reasons : std::vector<std::string>{};
  };
  const auto lifted = [](const char* by) {
    return ElementsAre(AllOf(HasSubstr(", -1) is " + std::string(by) + " Pa above what all that"),
                             HasSubstr("it lifts ground that little else holds down")));
  };
  EXPECT_THAT(reasons(0.0, 30e3, 0.0), lifted("9999.99"));
  EXPECT_THAT(reasons(0.0, 30e3, 4e3), lifted("5999.99"));
  EXPECT_THAT(reasons(4e3, 30e3, 0.0), lifted("5999.99"));
  EXPECT_THAT(reasons(0.0, 19.9e3, 0.0), IsEmpty());
}

}  // namespace

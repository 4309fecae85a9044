// Cohesion that changes linearly from place to place.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "limit/bracket/bracket.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scenes.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double degree = std::numbers::pi / 180.0;

// A block between smooth platens whose cohesion changes across it: every fibre yields by itself, so
// that the exact pressure is 2 tan(45 + phi/2) times the mean cohesion.
class Platens : public ::testing::TestWithParam<double> {};

TEST_P(Platens, BearTheMeanOfACohesionThatChangesAcross) {
  const double phi = GetParam();
  const auto problem =
      shipped("smooth_platens",
              {"material.0.cohesion={ at = [0.02, 7], value = 15e3, gradient = [2e5, 0] }",
               fmt::format("material.0.friction_angle={}", phi)});
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.gap = 1e-3;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  const double mean = 15e3 + 2e5 * (0.025 - 0.02);
  const double exact = 2.0 * mean * std::tan((45.0 + phi / 2.0) * degree);
  EXPECT_LE(*found.lower, exact);
  EXPECT_GE(*found.upper, exact);
  EXPECT_LE(found.gap(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Friction, Platens, ::testing::Values(0.0, 20.0));

// What a frictional soil dissipates is c cot(phi) times its dilation, so that the integrals over
// triangles (a quadratic: by their middles) and sides (a cubic: by Simpson's rule) are exact.
double dissipation(const problem::Problem& problem, const problem::VelocityField& field) {
  const mesh::Mesh& mesh = problem.mesh;
  const problem::Soil& soil = problem.soils.front();
  const auto node = [&](int i) { return mesh.nodes[static_cast<std::size_t>(i)]; };
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& nodes = mesh.triangles[t].nodes;
    const auto at = [&](std::size_t i) { return node(nodes[i % 3]); };
    const double area2 = mesh::twice_area(mesh, mesh.triangles[t]);
    const auto slope = [&](std::size_t i) {
      const mesh::Point across = at(i + 2) - at(i + 1);
      return mesh::Point(-across.y() / area2, across.x() / area2);
    };
    for (std::size_t middle = 0; middle < 3; ++middle) {
      std::array<double, 3> share{0.5, 0.5, 0.5};
      share[(middle + 2) % 3] = 0.0;
      double dilation = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const mesh::Point corner = (4.0 * share[i] - 1.0) * slope(i);
        const mesh::Point between = 4.0 * (share[i] * slope(j) + share[j] * slope(i));
        dilation += corner.dot(field.triangles[t].col(static_cast<Eigen::Index>(i)));
        dilation += between.dot(field.triangles[t].col(static_cast<Eigen::Index>(3 + i)));
      }
      sum += area2 / 6.0 * soil.cohesion_at((at(middle) + at(middle + 1)) / 2.0) * dilation;
    }
  }
  const auto velocities = [&](int triangle, const mesh::Edge& edge) {
    const mesh::Triangle& of = mesh.triangles[static_cast<std::size_t>(triangle)];
    const int first = mesh::corner_of(of, edge.first), second = mesh::corner_of(of, edge.second);
    const auto& all = field.triangles[static_cast<std::size_t>(triangle)];
    Eigen::Matrix<double, 2, 3> along;
    along << all.col(first), all.col(3 + ((first + 1) % 3 == second ? first : second)),
        all.col(second);
    return along;
  };
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    Eigen::Matrix<double, 2, 3> jump = -velocities(edge.left, edge);
    if (edge.right >= 0) {
      jump += velocities(edge.right, edge);
    } else {
      const auto& side = problem.boundaries[static_cast<std::size_t>(edge.boundary)];
      if (side.normal == problem::Known::traction) continue;
      // It is guided, and does not turn.
      if (side.normal == problem::Known::footing) jump.colwise() += field.footing.head<2>();
    }
    const mesh::Point along = node(edge.second) - node(edge.first);
    const Eigen::RowVector3d opens = mesh::Point(along.y(), -along.x()).transpose() * jump;
    const double first = soil.cohesion_at(node(edge.first)),
                 second = soil.cohesion_at(node(edge.second));
    sum += (first * opens[0] + 2.0 * (first + second) * opens[1] + second * opens[2]) / 6.0;
  }
  return sum / std::tan(soil.friction_angle);
}

TEST(Cohesion, IsIntegratedExactlyOverTrianglesAndSides) {
  const auto cases = shipped(
      "smooth_platens", {"material.0.cohesion={ at = [0, 0], value = 10e3, gradient = [2e5, 3e5] }",
                         "side.0.base=rough"});
  ASSERT_TRUE(cases);
  const problem::Case& wanted = cases->associated;
  bracket::BracketOptions options;
  options.gap = 0.1;
  const bracket::Bracket found = bracket::bracket(wanted, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  problem::Problem problem = problem::in_units(wanted.upper, wanted.units);
  problem.mesh = found.upper->mesh;
  const certificate::UpperCertificate& proof = found.upper->certificate;
  constexpr double rounding = 1e-9;
  EXPECT_NEAR(dissipation(problem, proof.field) / proof.dissipation, 1.0, rounding);
  EXPECT_LE(found.lower_bound(), found.upper_bound());
}

// All strengths together are a factor of the answer, wherever the cohesion is told from.
TEST(Cohesion, ThatIsToldFromElsewhereIsTheSame) {
  const auto bearing = [](const std::string& cohesion) {
    const auto problem = case_of(layered, {"material.1.cohesion=" + cohesion});
    EXPECT_TRUE(problem);
    return bracket::solution_of(problem->associated, {}, {});
  };
  const bracket::Solution one = bearing("{ at = [0, -1], value = 1, gradient = [0, -0.5] }");
  const bracket::Solution other = bearing("{ at = [9, -2], value = 1.5, gradient = [0, -0.5] }");
  ASSERT_TRUE(one.lower && one.upper && other.lower && other.upper);
  // The same programme but for rounding, and the solver's share of what it leaves.
  constexpr double solver = 1e-4;
  EXPECT_NEAR(*one.lower / *other.lower, 1.0, solver);
  EXPECT_NEAR(*one.upper / *other.upper, 1.0, solver);
  EXPECT_LE(*one.lower, *one.upper);
  // More than as soft as at the top, less than as strong as at the bottom.
  EXPECT_GT(*one.upper, *bearing("1.0").lower);
  EXPECT_LT(*one.lower, *bearing("1.5").upper);
}

// Without friction the factor of safety is in proportion to the cohesion.
TEST(Cohesion, ThatGrowsWithDepthIsDividedAsAWhole) {
  const auto factor = [](double times) {
    const auto problem = case_of(
        cut, {"load.sought=strength",
              fmt::format("material.0.cohesion={{ at = [0, 0], value = {}, gradient = [0, {}] }}",
                          times, -0.3 * times)});
    EXPECT_TRUE(problem);
    return bracket::solution_of(problem->associated, {}, {});
  };
  const bracket::Solution once = factor(1.0), thrice = factor(3.0);
  ASSERT_TRUE(once.lower && once.upper && thrice.lower && thrice.upper);
  EXPECT_LE(3.0 * *once.lower, *thrice.upper);
  EXPECT_LE(*thrice.lower, 3.0 * *once.upper);
  EXPECT_LE(once.gap(), 0.02);
  EXPECT_LE(thrice.gap(), 0.02);
}

std::string complaint(const std::string& cohesion) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const std::vector<std::string> settings{"material.1.cohesion=" + cohesion};
  static_cast<void>(ground::read_ground_scene(layered, settings, diagnosis, unreadable));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

TEST(Cohesion, ThatIsNoneSomewhereIsRefusedWithThePlace) {
  EXPECT_THAT(complaint("{ at = [0, -1], value = 1, gradient = [0, 2] }"),
              AllOf(HasSubstr("material.1.cohesion"), HasSubstr("-1 at (0, -2)"),
                    HasSubstr("region soft"), HasSubstr("more than zero")));
  EXPECT_THAT(complaint("{ at = [0, -1], value = 1, gradient = [0, 1] }"), HasSubstr("0 at ("));
  EXPECT_EQ(complaint("{ at = [0, -1], value = 1, gradient = [0, 0.99] }"), "");
}

TEST(Cohesion, IsANumberOrValuePlaceAndGradient) {
  const char* allowed = "{ at = [x, y], value = v, gradient = [gx, gy] }";
  EXPECT_THAT(complaint("{ value = 1, gradient = [0, 1] }"), HasSubstr(allowed));
  EXPECT_THAT(complaint("{ at = [0, 0], value = 1, gradent = [0, 1] }"), HasSubstr("gradent"));
  EXPECT_THAT(complaint("{ at = [0], value = 1, gradient = [0, 1] }"), HasSubstr(allowed));
  EXPECT_THAT(complaint("{ at = [0, 0], value = -1, gradient = [0, 1] }"), HasSubstr("found -1"));
  EXPECT_THAT(complaint("[1, 2]"), HasSubstr(allowed));
  EXPECT_THAT(complaint("\"stiff\""), HasSubstr(allowed));
}

}  // namespace

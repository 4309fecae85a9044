#include <gmock/gmock.h>

#include <cmath>
#include <numeric>

#include "limit/mesh/bisection.hpp"
#include "limit/mesh/fan.hpp"
#include "limit/mesh/mesh.hpp"

namespace {

using namespace limit;

double area(const mesh::Mesh& mesh) {
  double twice = 0.0;
  for (const mesh::Triangle& triangle : mesh.triangles) twice += mesh::twice_area(mesh, triangle);
  return twice / 2.0;
}

double outline(const mesh::Mesh& mesh, mesh::FanBoundary which) {
  double length = 0.0;
  for (const mesh::BoundaryEdge& edge : mesh.boundary) {
    if (edge.boundary != static_cast<int>(which)) continue;
    length += (mesh.nodes[static_cast<std::size_t>(edge.first)] -
               mesh.nodes[static_cast<std::size_t>(edge.second)])
                  .norm();
  }
  return length;
}

mesh::Mesh two_triangles() {
  mesh::Mesh mesh;
  mesh.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{{0, 1, 2}, 0}, {{0, 2, 3}, 0}};
  mesh.boundary = {{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {3, 0, 0}};
  return mesh;
}

// Sums of some hundred products of order one.
constexpr double rounding = 1e-12;

TEST(Mesh, FindsEverySideOnce) {
  const auto edges = mesh::edges_of(two_triangles());
  EXPECT_EQ(edges.size(), 5U);
  EXPECT_EQ(
      std::count_if(edges.begin(), edges.end(), [](const mesh::Edge& e) { return e.right < 0; }),
      4);
}

TEST(Mesh, RefusesClockwiseOverlappingAndUnnamedSides) {
  mesh::Mesh clockwise = two_triangles();
  std::swap(clockwise.triangles[0].nodes[0], clockwise.triangles[0].nodes[1]);
  EXPECT_THROW((void)mesh::edges_of(clockwise), std::invalid_argument);
  mesh::Mesh overlapping = two_triangles();
  overlapping.triangles.push_back(overlapping.triangles[0]);
  EXPECT_THROW((void)mesh::edges_of(overlapping), std::invalid_argument);
  mesh::Mesh unnamed = two_triangles();
  unnamed.boundary.pop_back();
  EXPECT_THROW((void)mesh::edges_of(unnamed), std::invalid_argument);
  mesh::Mesh inner = two_triangles();
  inner.boundary.push_back({0, 2, 0});
  EXPECT_THROW((void)mesh::edges_of(inner), std::invalid_argument);
}

TEST(Fan, FillsTheBoxAndNamesItsOutline) {
  const mesh::Mesh mesh = mesh::fan_mesh(mesh::even_fan(4.0, 2.0, 11, 5, 1.5));
  EXPECT_NO_THROW((void)mesh::edges_of(mesh));
  EXPECT_NEAR(area(mesh), 8.0, rounding);
  EXPECT_NEAR(outline(mesh, mesh::FanBoundary::base), 1.0, rounding);
  EXPECT_NEAR(outline(mesh, mesh::FanBoundary::surface), 3.0, rounding);
  EXPECT_NEAR(outline(mesh, mesh::FanBoundary::wall), 2.0, rounding);
  EXPECT_NEAR(outline(mesh, mesh::FanBoundary::floor), 4.0, rounding);
  EXPECT_NEAR(outline(mesh, mesh::FanBoundary::axis), 2.0, rounding);
}

TEST(Fan, HoldsAlsoInVeryWideAndVeryShallowBoxes) {
  for (const auto& [width, depth] : {std::pair{1.001, 0.01}, {100.0, 0.05}, {2.0, 50.0}}) {
    const mesh::Mesh mesh = mesh::fan_mesh(mesh::even_fan(width, depth, 12, 4, 2.0));
    EXPECT_NO_THROW((void)mesh::edges_of(mesh));
    EXPECT_NEAR(area(mesh), width * depth, rounding * width * depth);
  }
  EXPECT_THROW((void)mesh::even_fan(1.0, 1.0, 12, 4, 2.0), std::invalid_argument);
}

TEST(Bisection, KeepsAreaOutlineAndConformity) {
  mesh::Mesh mesh = mesh::fan_mesh(mesh::even_fan(4.0, 2.0, 11, 5, 1.5));
  for (int cycle = 0; cycle < 4; ++cycle) {
    std::vector<bool> marked(mesh.triangles.size(), false);
    for (std::size_t t = 0; t < marked.size(); t += 3) marked[t] = true;
    const std::size_t before = mesh.triangles.size();
    mesh = mesh::bisected(mesh, marked);
    EXPECT_GE(mesh.triangles.size(), before + before / 3);
    EXPECT_NO_THROW((void)mesh::edges_of(mesh));
    EXPECT_NEAR(area(mesh), 8.0, rounding);
    EXPECT_NEAR(outline(mesh, mesh::FanBoundary::base), 1.0, rounding);
  }
}

// Where all of the flow is at one point, a mesh would grow by a handful of triangles at a time.
// Two sides that nearly continue each other in the new node would make equilibrium across them
// nearly the same twice: they continue each other, to rounding. What is far from that stays so.
TEST(Bisection, PutsTheNewNodeInLineWithTheNodesAcrossIfThatIsNextToTheMiddle) {
  for (const double off : {0.0, 1e-5, 0.015, 0.1}) {
    mesh::Mesh mesh = two_triangles();
    mesh.nodes[1] += mesh::Point(off, 0.01);  // the diagonal remains the longest side
    const mesh::Mesh halved = mesh::bisected(mesh, {true, false});
    ASSERT_EQ(halved.nodes.size(), 5U);
    EXPECT_NEAR(area(halved), area(mesh), rounding);
    const mesh::Point middle = halved.nodes.back();
    EXPECT_NEAR(middle.x(), middle.y(), rounding) << "on the diagonal";
    const mesh::Point one = mesh.nodes[1] - middle, other = mesh.nodes[3] - middle;
    const double turn = one.x() * other.y() - one.y() * other.x();
    if (off < 0.05) {
      EXPECT_NEAR(turn, 0.0, rounding) << off;
    } else {
      EXPECT_NEAR(middle.x(), 0.5, rounding) << off;
      EXPECT_GT(std::abs(turn), 0.01) << off;
    }
  }
}

// Of a flat triangle the base is the longest side, unless lengths along it count for less.
TEST(Bisection, TakesSidesAlongAStretchedMeshForShorterThanTheyAre) {
  mesh::Mesh mesh;
  mesh.nodes = {{0.0, 0.0}, {2.0, 0.0}, {1.0, 0.7}};
  mesh.triangles = {{{0, 1, 2}, 0}};
  mesh.boundary = {{0, 1, 0}, {1, 2, 0}, {2, 0, 0}};
  EXPECT_EQ(mesh::bisected(mesh, {true}).nodes.back().y(), 0.0);
  mesh.stretch = 4.0;
  const mesh::Mesh halved = mesh::bisected(mesh, {true});
  EXPECT_EQ(halved.nodes.back().y(), 0.35);
  EXPECT_EQ(halved.stretch, 4.0);
}

TEST(Bisection, GoesOnNearOnePointUntilTheMeshHasGrown) {
  mesh::Mesh mesh = mesh::fan_mesh(mesh::even_fan(4.0, 2.0, 24, 8, 1.5));
  std::vector<double> indicators(mesh.triangles.size(), 0.0);
  indicators[7] = 1.0;
  const std::size_t before = mesh.triangles.size();
  EXPECT_LT(mesh::bisected(mesh, mesh::largest(indicators, 0.7)).triangles.size(),
            before + before / 10);
  const mesh::Mesh grown = mesh::refined(mesh, indicators, 0.7, 1.25);
  EXPECT_GE(grown.triangles.size(), before + before / 4);
  EXPECT_NO_THROW((void)mesh::edges_of(grown));
  constexpr double rounding = 1e-12;
  EXPECT_NEAR(area(grown), area(mesh), rounding * area(mesh));
  // Nothing flows: nothing is to be refined.
  EXPECT_EQ(mesh::refined(mesh, std::vector<double>(before, 0.0), 0.7, 1.25).triangles.size(),
            before);
}

TEST(Bisection, MarksTheFewestThatMakeUpTheShare) {
  using ::testing::ElementsAre;
  EXPECT_THAT(mesh::largest({1.0, 5.0, 0.0, 4.0}, 0.5), ElementsAre(false, true, false, false));
  EXPECT_THAT(mesh::largest({1.0, 5.0, 0.0, 4.0}, 0.6), ElementsAre(false, true, false, true));
  EXPECT_THAT(mesh::largest({0.0, 0.0}, 0.5), ElementsAre(false, false));
}

}  // namespace

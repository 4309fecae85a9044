// Soils that an upper bound leaves where they are.
#include "limit/problem/at_rest.hpp"

#include <gtest/gtest.h>

namespace {

using namespace limit;

// A square of two triangles, and another one beside it, of other soils.
problem::Problem two_squares() {
  problem::Problem problem;
  problem.mesh.nodes = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
  problem.mesh.triangles = {{{0, 1, 4}, 0}, {{0, 4, 3}, 0}, {{1, 2, 5}, 1}, {{1, 5, 4}, 1}};
  problem.mesh.boundary = {{0, 1, 0}, {1, 2, 0}, {2, 5, 0}, {5, 4, 1}, {4, 3, 1}, {3, 0, 0}};
  problem.soils.resize(2);
  problem.boundaries.resize(2);
  return problem;
}

TEST(AtRest, LeavesTheOtherSoilsOnRigidGroundWhereTheyMeetIt) {
  for (const int resting : {0, 1}) {
    const problem::Problem rest =
        problem::with_soils_at_rest(two_squares(), {resting == 0, resting == 1});
    ASSERT_EQ(rest.mesh.triangles.size(), 2U);
    double area = 0.0;
    for (const mesh::Triangle& triangle : rest.mesh.triangles) {
      EXPECT_EQ(triangle.region, 1 - resting);
      area += mesh::twice_area(rest.mesh, triangle) / 2.0;
    }
    EXPECT_EQ(area, 1.0);
    ASSERT_EQ(rest.boundaries.size(), 3U);
    EXPECT_EQ(rest.boundaries[2].normal, problem::Known::support);
    EXPECT_EQ(rest.boundaries[2].tangential, problem::Known::support);
    int rigid = 0;
    const auto edges = mesh::edges_of(rest.mesh);  // throws unless the outline is whole
    for (const mesh::Edge& edge : edges) {
      if (edge.boundary != 2) continue;
      ++rigid;
      EXPECT_EQ(edge.first + edge.second, 1 + 4);  // where the squares meet
    }
    EXPECT_EQ(rigid, 1);
    EXPECT_EQ(edges.size(), 5U);
  }
}

}  // namespace

// Meshes of ground: what they cover and where they have fans.
#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "limit/ground/ground_fan.hpp"
#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_scenes.hpp"

namespace {

using namespace limit;

double area(const mesh::Mesh& mesh) {
  double twice = 0.0;
  for (const mesh::Triangle& triangle : mesh.triangles) twice += mesh::twice_area(mesh, triangle);
  return twice / 2.0;
}

TEST(GroundMesh, CoversTheGroundAndConformsToLayersAndSides) {
  for (const char* text : {layered, cut}) {
    const Read made = read(text);
    ASSERT_TRUE(made.found) << made.errors;
    for (const problem::Problem& problem :
         {made.found->associated.lower, made.found->associated.upper}) {
      const mesh::Mesh& mesh = problem.mesh;
      EXPECT_NO_THROW((void)mesh::edges_of(mesh));
      const double expected = text == layered ? 8.0 : 6.0;
      EXPECT_NEAR(area(mesh), expected, 1e-9 * expected);
      for (const mesh::Triangle& triangle : mesh.triangles) {
        if (text != layered) continue;
        for (const int node : triangle.nodes) {
          const double y = mesh.nodes[static_cast<std::size_t>(node)].y();
          EXPECT_TRUE(triangle.region == 0 ? y >= -1.0 - 1e-9 : y <= -1.0 + 1e-9);
        }
      }
      double footing = 0.0;
      for (const mesh::BoundaryEdge& edge : mesh.boundary) {
        if (text != layered || edge.boundary != 0) continue;
        footing += (mesh.nodes[static_cast<std::size_t>(edge.second)] -
                    mesh.nodes[static_cast<std::size_t>(edge.first)])
                       .norm();
      }
      EXPECT_NEAR(footing, text == layered ? 1.0 : 0.0, 1e-9);
    }
  }
}

TEST(GroundMesh, HasAFanAtEverySingularPointAndNowhereElse) {
  const auto singular = [](const char* text, const std::vector<std::string>& settings = {}) {
    const Read made = read(text, settings);
    tables::Diagnosis diagnosis("ground.toml");
    const ground::GroundOutline outline = ground::ground_outline(*made.scene, diagnosis);
    std::set<std::pair<double, double>> places;
    for (const int point : ground::singular_points(*made.scene, outline)) {
      places.emplace(outline.at(point).x(), outline.at(point).y());
    }
    return places;
  };
  using Places = std::set<std::pair<double, double>>;
  EXPECT_EQ(singular(layered), (Places{{1.0, 0.0}}));
  EXPECT_EQ(singular(cut), (Places{{0.0, 0.0}}));
  // Where one stress cannot have both sides' tractions: a shear beside a side without, and a
  // pressure up to the crest of a slope, but not up to an upright cut.
  EXPECT_EQ(singular(sheared), (Places{{0.0, 1.0}, {4.0, 1.0}}));
  EXPECT_EQ(singular(sheared, {"side.left.kind=roller", "side.right.kind=fixed"}),
            (Places{{0.0, 1.0}}));
  const std::vector<std::string> pressed{"side.top.live_shear=0", "side.top.live_pressure=1"};
  EXPECT_EQ(singular(sheared, pressed), Places{});
  std::vector<std::string> crest = pressed;
  for (const char* setting :
       {"region.0.outline=[[-1, 0], [4, 0], [4, 1], [0, 1]]", "side.left.along=[[-1, 0], [0, 1]]",
        "side.floor.along=[[-1, 0], [4, 0]]"}) {
    crest.emplace_back(setting);
  }
  EXPECT_EQ(singular(sheared, crest), (Places{{0.0, 1.0}}));
  // Where faces of soil that leans on friction meet, and where it crops out beside another one.
  EXPECT_EQ(singular(cut, {"material.0.cohesion=0.1", "material.0.friction_angle=30",
                           "material.0.unit_weight=18"}),
            (Places{{0.0, 0.0}, {0.0, 1.0}}));
  // As many triangles meet there as rays have been asked for: 1.5 x 24 over 270 degrees.
  const mesh::Mesh mesh = read(cut).found->associated.lower.mesh;
  int at_toe = 0;
  for (const mesh::Triangle& triangle : mesh.triangles) {
    for (const int node : triangle.nodes) {
      if (mesh.nodes[static_cast<std::size_t>(node)] == mesh::Point(0, 0)) ++at_toe;
    }
  }
  EXPECT_EQ(at_toe, 36);
}

}  // namespace

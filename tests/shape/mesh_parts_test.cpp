// Elements of meshes: what they stand for, where they meet, and what is refused.
#include "shape/mesh_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shape/gmsh.hpp"
#include "shape/mesh_solids.hpp"
#include "support/box_mesh.hpp"

namespace shape {
namespace {

using support::BoxMesh;
using ::testing::HasSubstr;
using Kind = BoxMesh::Kind;

std::vector<int> regions_of(const GmshMesh& mesh) {
  std::vector<int> region;
  for (const auto& element : mesh.elements) {
    region.push_back(mesh.dimension_of(element) == mesh.dimension ? element.group : -1);
  }
  return region;
}

class Elements : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Elements,
                         testing::Values(Kind::triangles, Kind::quadrilaterals, Kind::tetrahedra,
                                         Kind::hexahedra, Kind::prisms),
                         [](const auto& info) { return support::name_of(info.param); });

// Whatever nodes within are moved by, elements fill the box, and Gauss's theorem holds for each
// with the pieces of its surface: sum of areas is zero, sum of area x place its volume.
TEST_P(Elements, FillTheirBoxAndCloseTheirSurfaces) {
  const BoxMesh box{.kind = GetParam(), .cells = {3, 4, 5}, .size = {1.5, 2.0, 0.7}, .jitter = 0.2};
  const GmshMesh mesh = read_gmsh(text_of(box));
  const bool plane = box.is_plane();
  ASSERT_EQ(mesh.dimension, plane ? 2 : 3);
  const MeshBody body = join_elements(mesh, regions_of(mesh));
  const double whole = 1.5 * 2.0 * (plane ? 1.0 : 0.7);
  double volume = 0.0;
  SpacePoint moment = SpacePoint::Zero();
  for (const MeshPart& part : body.parts) {
    const auto& element = mesh.elements[static_cast<std::size_t>(part.element)];
    const Content content = content_of(mesh, element);
    EXPECT_GT(content.volume, 0.0);
    volume += content.volume;
    moment += content.volume * content.centroid;
    SpacePoint closed = SpacePoint::Zero();
    double swept = 0.0;
    for (const auto& facet : facets_of(mesh, element)) {
      for (const FacetPiece& piece : flat_pieces(mesh, facet)) {
        closed += piece.area;
        swept += piece.area.dot(piece.middle);
      }
    }
    EXPECT_LT(closed.norm(), 1e-14);
    EXPECT_NEAR(swept, content.volume * mesh.dimension, 1e-14);
  }
  constexpr double round_off = 1e-13;
  EXPECT_NEAR(volume, whole, round_off);
  EXPECT_LT((moment - whole * SpacePoint(0.75, 1.0, plane ? 0.0 : 0.35)).norm(), round_off);
}

// Each facet is once in the list; those without a part beyond are the box's faces.
TEST_P(Elements, MeetEachOtherOrTheSurface) {
  const BoxMesh box{.kind = GetParam(), .cells = {3, 4, 5}, .size = {1.5, 2.0, 0.7}, .jitter = 0.2};
  const GmshMesh mesh = read_gmsh(text_of(box));
  const MeshBody body = join_elements(mesh, regions_of(mesh));
  double surface = 0.0;
  std::size_t sides = 0;
  for (const MeshFacet& facet : body.facets) {
    sides += facet.beyond < 0 ? 1 : 2;
    for (const FacetPiece& piece : flat_pieces(mesh, facet.nodes)) {
      if (facet.beyond < 0) surface += piece.area.norm();
    }
  }
  const double whole =
      box.is_plane() ? 2.0 * (1.5 + 2.0) : 2.0 * (1.5 * 2.0 + 1.5 * 0.7 + 2.0 * 0.7);
  EXPECT_NEAR(surface, whole, 1e-13);
  std::size_t facets = 0;
  for (const MeshPart& part : body.parts) {
    facets += facets_of(mesh, mesh.elements[static_cast<std::size_t>(part.element)]).size();
  }
  EXPECT_EQ(sides, facets);
}

// Of cubes the spacing is their width; of the six tetrahedra of each its sixth root of the volume.
TEST(Spacings, AreThoseOfTheElementsAround) {
  for (const auto& [kind, parts] :
       {std::pair(Kind::hexahedra, 1.0), std::pair(Kind::tetrahedra, 6.0)}) {
    const BoxMesh box{.kind = kind, .cells = {4, 4, 4}};
    const GmshMesh mesh = read_gmsh(text_of(box));
    const MeshBody body = join_elements(mesh, regions_of(mesh));
    const std::vector<double> volume(body.parts.size(), 1.0 / 64.0 / parts);
    for (const double spacing : spacings(mesh, body, volume)) {
      EXPECT_NEAR(spacing, 0.25 * std::cbrt(1.0 / parts), 1e-14);
    }
  }
}

TEST(Pyramid, IsAThirdOfItsBox) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
      "5 0.5 0.5 1\n$EndNodes\n$Elements\n1\n1 7 2 3 3 1 2 3 4 5\n$EndElements\n";
  for (const bool turned : {false, true}) {
    std::string given = text;
    if (turned) given.replace(given.find("1 2 3 4 5\n"), 9, "1 4 3 2 5");
    const GmshMesh mesh = read_gmsh(given);
    const Content content = content_of(mesh, mesh.elements.at(0));
    EXPECT_NEAR(content.volume, 1.0 / 3.0, 1e-15);
    EXPECT_LT((content.centroid - SpacePoint(0.5, 0.5, 0.25)).norm(), 1e-15);
  }
}

std::string refusal(const std::string& elements, const std::string& nodes) {
  try {
    const GmshMesh mesh = read_gmsh("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" + nodes +
                                    "$EndNodes\n$Elements\n" + elements + "$EndElements\n");
    (void)join_elements(mesh, regions_of(mesh));
  } catch (const GmshError& error) {
    return std::to_string(error.line()) + ": " + error.what();
  }
  return "";
}

TEST(Solids, ThatAreNoneAreRefused) {
  const std::string cube =
      "8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n";
  EXPECT_EQ(refusal("1\n1 5 2 3 3 1 2 3 4 5 6 7 8\n", cube), "");
  EXPECT_THAT(refusal("1\n1 4 2 3 3 1 2 3 4\n", cube),
              HasSubstr("17: element 1 at (0, 0, 0) has no volume"));
  EXPECT_THAT(refusal("1\n1 5 2 3 3 1 2 4 3 5 6 7 8\n", cube),
              HasSubstr("17: element 1 at (0, 0, 0) is folded"));
  EXPECT_THAT(refusal("3\n1 4 2 3 3 1 2 3 5\n2 4 2 3 3 1 2 3 6\n3 4 2 3 3 1 2 3 7\n", cube),
              HasSubstr("more than two elements meet at (0.666667, 0.333333, 0)"));
  EXPECT_THAT(refusal("2\n1 4 2 3 3 1 2 3 5\n2 4 2 4 4 1 2 3 5\n", cube),
              HasSubstr("is of two regions"));
  // Twice in one region it is there once.
  EXPECT_EQ(refusal("2\n1 4 2 3 3 1 2 3 5\n2 4 2 3 3 1 2 3 5\n", cube), "");
}

}  // namespace
}  // namespace shape

// Meshes of Gmsh: what is read of them, the outlines of their groups, and what is refused.
#include "shape/gmsh.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "shape/mesh_outline.hpp"

namespace shape {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Nodes 1 to 9 of a square of 2 m in rows of three from below; node 5 is its middle.
const std::string head2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 7 \"rim\"\n2 3 \"soft clay\"\n"
    "2 4 \"rock\"\n$EndPhysicalNames\n";
const std::string nodes2 =
    "$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n7 0 2 0\n8 1 2 0\n9 2 2 0\n"
    "$EndNodes\n";

std::string elements2(const std::vector<std::string>& elements) {
  std::string text = "$Elements\n" + std::to_string(elements.size()) + "\n";
  for (std::size_t k = 0; k < elements.size(); ++k) {
    text += std::to_string(k + 1) + " " + elements[k] + "\n";
  }
  return text + "$EndElements\n";
}

// An L of three squares, one of them two triangles, the other clockwise; the fourth is rock.
const std::string l_and_rock =
    head2 + nodes2 +
    elements2({"15 2 0 1 1", "1 2 7 1 1 2", "1 2 7 1 2 3", "1 2 7 2 3 6", "2 2 3 1 1 2 5",
               "2 2 3 1 1 5 4", "3 2 3 1 2 5 6 3", "3 2 3 1 4 5 8 7", "3 2 4 2 5 6 9 8"});

TEST(Gmsh, GivesOutlinesOfItsGroupsWithoutCornersOnTheWay) {
  const GmshMesh mesh = read_gmsh(l_and_rock);
  ASSERT_EQ(mesh.groups.size(), 3U);
  const auto clay = find_group(mesh, 2, "soft clay");
  ASSERT_TRUE(clay);
  EXPECT_FALSE(find_group(mesh, 1, "soft clay"));
  const auto pieces = pieces_of(mesh, *clay);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_TRUE(pieces[0].holes.empty());
  EXPECT_THAT(pieces[0].outline, ElementsAre(Point(0, 0), Point(2, 0), Point(2, 1), Point(1, 1),
                                             Point(1, 2), Point(0, 2)));
  const auto rim = polylines_of(mesh, *find_group(mesh, 1, "rim"));
  ASSERT_EQ(rim.size(), 1U);
  EXPECT_THAT(rim[0], ElementsAre(Point(0, 0), Point(2, 0), Point(2, 1)));
}

TEST(Gmsh, IsInItsUnit) {
  EXPECT_EQ(read_gmsh(l_and_rock, 1e-3).plane_at(8), Point(2e-3, 2e-3));
}

// A ring of eight triangles and quadrilaterals around the middle, which is not of the group.
TEST(Gmsh, GivesHolesAndParts) {
  const std::string ring =
      head2 +
      "$Nodes\n9\n1 0 0 5\n2 3 0 5\n3 3 3 5\n4 0 3 5\n5 1 1 5\n6 2 1 5\n7 2 2 5\n8 1 2 5\n9 9 9 5\n"
      "$EndNodes\n" +
      elements2({"3 2 3 1 1 2 6 5", "3 2 3 1 2 3 7 6", "3 2 3 1 3 4 8 7", "3 2 3 1 4 1 5 8",
                 "1 2 7 1 5 6", "1 2 7 1 7 8", "1 2 7 1 8 5", "1 2 7 1 6 7", "1 2 7 1 1 2",
                 "2 2 4 1 5 6 7"});
  const GmshMesh mesh = read_gmsh(ring);
  const auto pieces = pieces_of(mesh, *find_group(mesh, 2, "soft clay"));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].outline.size(), 4U);
  ASSERT_EQ(pieces[0].holes.size(), 1U);
  EXPECT_EQ(pieces[0].holes[0].size(), 4U);
  const auto lines = polylines_of(mesh, *find_group(mesh, 1, "rim"));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].size(), 2U);
  EXPECT_EQ(lines[1].size(), 5U);
  EXPECT_EQ(lines[1].front(), lines[1].back());
}

// The same L in the other format, whose groups belong to entities; the second surface is of none.
TEST(Gmsh, ReadsFormat41) {
  const std::string text =
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 3 \"soft clay\"\n"
      "$EndPhysicalNames\n$Comments\nanything\n$EndComments\n$Entities\n1 1 2 0\n1 0 0 0 0\n"
      "1 0 0 0 2 0 0 1 -7 2 1 -2\n1 0 0 0 2 2 0 1 3 1 1\n2 0 0 0 2 2 0 0 1 1\n$EndEntities\n"
      "$Nodes\n2 9 1 9\n0 1 0 1\n1\n0 0 0\n2 1 1 8\n2\n3\n4\n5\n6\n7\n8\n9\n"
      "1 0 0 0.5 0.5\n2 0 0 0.5 0.5\n0 1 0 0.5 0.5\n1 1 0 0.5 0.5\n2 1 0 0.5 0.5\n0 2 0 0.5 0.5\n"
      "1 2 0 0.5 0.5\n2 2 0 0.5 0.5\n$EndNodes\n"
      "$Elements\n4 8 1 8\n0 1 15 1\n1 1\n1 1 1 2\n2 1 2\n3 2 3\n2 1 3 3\n4 1 2 5 4\n5 2 3 6 5\n"
      "6 4 5 8 7\n2 2 3 1\n7 5 6 9 8\n$EndElements\n";
  const GmshMesh mesh = read_gmsh(text);
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.elements.size(), 5U);
  const auto pieces = pieces_of(mesh, *find_group(mesh, 2, "soft clay"));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].outline.size(), 6U);
  EXPECT_EQ(polylines_of(mesh, *find_group(mesh, 1, "7")).size(), 1U);
}

std::string refusal(const std::string& text) {
  try {
    const GmshMesh mesh = read_gmsh(text);
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      if (mesh.groups[g].dimension == 2) (void)pieces_of(mesh, static_cast<int>(g));
    }
  } catch (const GmshError& error) {
    return std::to_string(error.line()) + ": " + error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error(what + " is not in the mesh");
  return text.replace(at, what.size(), by);
}

TEST(Gmsh, RefusesWhatIsNoPlaneMesh) {
  const std::string& good = l_and_rock;
  EXPECT_EQ(refusal(good), "");
  const auto with = [&](const std::string& what, const std::string& by) {
    return refusal(replaced(good, what, by));
  };
  EXPECT_THAT(refusal(""), HasSubstr("1: it does not begin with $MeshFormat"));
  EXPECT_THAT(with("2.2 0 8", "4 0 8"), HasSubstr("2: found format 4: save it as MSH 4.1 or 2.2"));
  EXPECT_THAT(with("2.2 0 8", "2.2 1 8"), HasSubstr("2: it is binary"));
  EXPECT_THAT(with("\"rim\"", "\"rim"), HasSubstr("6: a name in quotes does not end"));
  EXPECT_THAT(with("$Nodes\n9", "$Nodes\n99999"), HasSubstr("more than the file has"));
  EXPECT_THAT(with("$Nodes\n9", "$Nodes\n8"), HasSubstr("found 9 where $EndNodes should be"));
  EXPECT_THAT(with("2 1 0 0", "2 1 0 nan"), HasSubstr("13: a coordinate is not finite"));
  EXPECT_THAT(with("2 1 0 0", "2 1 0 0.1"), HasSubstr("z = 0 and at z = 0.1"));
  EXPECT_THAT(with("2 1 0 0", "1 1 0 0"), HasSubstr("node 1 is there twice"));
  EXPECT_THAT(with("15 2 0 1 1", "9 2 3 1 1"), HasSubstr("element 1 is of Gmsh's type 9"));
  EXPECT_THAT(with("2 2 3 1 1 2 5", "2 2 3 1 1 2 12"), HasSubstr("has node 12, which is none"));
  EXPECT_THAT(with("2 2 3 1 1 2 5", "2 2 3 1 1 2 3"), HasSubstr("element 5 at (0, 0) has no area"));
  EXPECT_THAT(with("3 2 4 2 5 6 9 8", "3 2 4 2 5 6 8 9"), HasSubstr("is folded or not convex"));
  EXPECT_THAT(with("3 2 3 1 2 5 6 3", "3 2 3 1 1 2 5 4"), HasSubstr("faces overlap at (0, 0)"));
  EXPECT_THAT(refusal(good.substr(0, good.size() - 30)), HasSubstr("should be"));
}

}  // namespace
}  // namespace shape

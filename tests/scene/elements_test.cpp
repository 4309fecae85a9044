// Bodies whose particles are the elements of a mesh: what a scene says of them, and what is
// refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/element_body.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "support/box_mesh.hpp"

namespace scene {
namespace {

using support::BoxMesh;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Kind = BoxMesh::Kind;

std::string side(const std::string& group, const std::string& kind) {
  return "[[side]]\nname = \"" + group + "\"\ngroup = \"" + group + "\"\nkind = \"" + kind + "\"\n";
}

std::string scene_of(const BoxMesh& mesh) {
  std::string text = "[geometry]\ndimension = " + std::string(mesh.is_plane() ? "2" : "3") +
                     "\n[mesh]\nparticles = \"elements\"\ntext = '''\n" + text_of(mesh) +
                     "'''\n[[material]]\nname = \"m\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
                     "poissons_ratio = 0.3\n[[region]]\nmaterial = \"m\"\ngroup = \"low\"\n"
                     "[[region]]\nmaterial = \"m\"\ngroup = \"high\"\n" +
                     side("x0", "symmetry") + side("x1", "roller") + side("y0", "fixed") +
                     side("y1", "footing");
  if (!mesh.is_plane()) text += side("z0", "roller") + side("z1", "free");
  return text + "[drive]\nkind = \"displacement\"\ntarget = 0.01\n";
}

const BoxMesh plane{.kind = Kind::triangles, .cells = {4, 4, 0}, .size = {2.0, 1.0, 1.0}};
const BoxMesh solid{.kind = Kind::tetrahedra, .cells = {4, 4, 4}, .size = {2.0, 1.0, 1.0}};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error(what + " is not in the scene");
  return text.replace(at, what.size(), by);
}

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const auto& error : parse_scene(text, "s.toml").errors) errors.push_back(error.text());
  return errors;
}

std::string error_with(const BoxMesh& mesh, const std::string& what, const std::string& by) {
  const auto errors = errors_of(replaced(scene_of(mesh), what, by));
  return errors.empty() ? "" : errors[0];
}

TEST(ElementScene, SaysWhatItsSidesComeTo) {
  const auto reading = parse_scene(scene_of(solid), "s.toml");
  ASSERT_THAT(errors_of(scene_of(solid)), IsEmpty());
  const Scene& scene = *reading.scene;
  EXPECT_THAT(scene.geometry.min, ElementsAre(0.0, 0.0, 0.0));
  EXPECT_THAT(scene.geometry.max, ElementsAre(2.0, 1.0, 1.0));
  // A sixth of a cell of 0.5 x 0.25 x 0.25.
  EXPECT_NEAR(scene.geometry.spacing, std::cbrt(0.5 * 0.25 * 0.25 / 6.0), 1e-12);
  ASSERT_EQ(scene.support.size(), 3U);
  EXPECT_EQ(scene.support[0].side, Side::right);
  EXPECT_THAT(scene.support[0].directions, ElementsAre(Axis::x));
  EXPECT_THAT(scene.support[1].directions, ElementsAre(Axis::x, Axis::y, Axis::z));
  EXPECT_EQ(scene.support[2].side, Side::front);
  ASSERT_EQ(scene.symmetry.size(), 1U);
  EXPECT_EQ(scene.drive.side, Side::top);
  EXPECT_EQ(scene.drive.level, 1.0);
  EXPECT_THAT(scene.drive.direction, ElementsAre(0.0, -1.0, 0.0));
  EXPECT_NEAR(*scene.drive.width, 2.0, 1e-14);  // the base's area
  EXPECT_EQ(scene.drive.method, DriveMethod::tied);
  EXPECT_THAT(errors_of(scene_of(plane)), IsEmpty());
}

TEST(ElementScene, RefusesWhatBelongsToCells) {
  const std::string elements = "particles that are elements";
  EXPECT_THAT(error_with(plane, "[geometry]", "[geometry]\njitter = 0.1"), HasSubstr(elements));
  EXPECT_THAT(error_with(plane, "[mesh]", "[grading]\nenabled = true\n[mesh]"),
              HasSubstr("grading.enabled: found true; " + elements));
  EXPECT_THAT(error_with(plane, "[mesh]", "[[cutout]]\nname = \"c\"\n[mesh]"),
              HasSubstr("leave it out of the mesh"));
  EXPECT_THAT(error_with(solid, "particles = \"elements\"\n", ""),
              HasSubstr("mesh.particles: found cells with a solid mesh"));
  EXPECT_THAT(error_with(plane, "particles = \"elements\"\n", ""),
              HasSubstr("geometry.spacing: is missing; needed is a number > 0 [m]"));
}

TEST(ElementScene, RefusesABoxAndASpacingThatAreNotTheMeshs) {
  EXPECT_THAT(error_with(plane, "[geometry]", "[geometry]\nspacing = 0.1"),
              HasSubstr("geometry.spacing: found 0.1, and the mesh has 0.25; "));
  EXPECT_THAT(error_with(plane, "[geometry]", "[geometry]\nmax = [2.5, 1.0]"),
              HasSubstr("geometry.max: found 2.5, and the mesh has 2; "));
  EXPECT_EQ(error_with(plane, "[geometry]", "[geometry]\nmax = [2.0, 1.0]"), "");
}

TEST(ElementScene, RefusesTheOtherDimension) {
  EXPECT_THAT(error_with(solid, "dimension = 3", "dimension = 2"),
              HasSubstr("geometry.dimension: found 2 with a solid mesh"));
  EXPECT_THAT(error_with(plane, "dimension = 2", "dimension = 3"),
              HasSubstr("geometry.dimension: found 3 with a plane mesh"));
}

TEST(ElementScene, RefusesGroupsThatAreNone) {
  EXPECT_THAT(
      error_with(solid, "group = \"high\"", "group = \"higher\""),
      HasSubstr("found \"higher\"; the mesh's physical volumes with elements are high, low; "
                "did you mean \"high\"?"));
  EXPECT_THAT(error_with(solid, "group = \"x1\"", "group = \"xx\""),
              HasSubstr("the mesh's physical surfaces with elements are"));
  EXPECT_THAT(error_with(solid, "group = \"high\"", "group = \"low\""),
              HasSubstr("region.1.group: found \"low\" again; a volume is one region"));
  EXPECT_THAT(error_with(solid, "group = \"x1\"", "group = \"x0\""),
              HasSubstr("is named by side \"x0\" as well"));
}

TEST(ElementScene, RefusesSurfaceWithoutASideAndSidesWithoutSurface) {
  EXPECT_THAT(error_with(solid, side("z1", "free"), ""), HasSubstr("is of no side"));
  // The lower half alone: the sides go on beyond it.
  EXPECT_THAT(error_with(solid, "[[region]]\nmaterial = \"m\"\ngroup = \"high\"\n", ""),
              HasSubstr("is not on the surface of the regions"));
  EXPECT_THAT(
      error_with(plane, "group = \"low\"\n", "outline = [[0, 0], [2, 0], [2, 0.5], [0, 0.5]]\n"),
      "");
  EXPECT_THAT(error_with(plane, "[[region]]\nmaterial = \"m\"\ngroup = \"low\"\n",
                         "[[region]]\nmaterial = \"m\"\noutline = [[0, 0], [2, 0], [2, 0.4], "
                         "[0, 0.4]]\n[[region]]\nmaterial = \"m\"\noutline = [[0, 0.4], [2, 0.4], "
                         "[2, 0.5], [0, 0.5]]\n"),
              HasSubstr("of which elements fill"));
}

TEST(ElementScene, RefusesWhatSolidsCannotHave) {
  EXPECT_THAT(error_with(solid, "kind = \"free\"", "kind = \"loaded\"\nshear = 1.0"),
              HasSubstr("side.5.shear: found 1; a face of a solid has no one direction along it"));
  EXPECT_THAT(error_with(solid, "[drive]",
                         "[[traction]]\nname = \"t\"\nside = \"top\"\nvalue = [0, 1, 0]\n[drive]"),
              HasSubstr("give a loaded [[side]] a pressure"));
  EXPECT_THAT(
      error_with(solid, "[drive]",
                 "[[support]]\nname = \"s\"\nat = [0, 0, 0]\ndirections = [\"x\"]\n[drive]"),
      HasSubstr("a body of volumes is held by its sides"));
  EXPECT_THAT(error_with(solid, "kind = \"footing\"", "kind = \"free\""),
              HasSubstr("what a drive moves of a body of volumes is its footing"));
  BoxMesh aslant = solid;
  aslant.map = [](auto at) { return std::array<double, 3>{at[0], at[1] * (1.0 + at[0]), at[2]}; };
  EXPECT_THAT(errors_of(scene_of(aslant))[0], HasSubstr("is aslant; a footing has one flat base"));
}

TEST(ElementScene, RefusesValuesThatVanishInSomeElement) {
  const std::string falling = "youngs_modulus = { at = [0, 1], value = 1e6, gradient = [0, ";
  EXPECT_EQ(error_with(solid, "youngs_modulus = 1e6", falling + "9e5] }"), "");
  EXPECT_THAT(error_with(solid, "youngs_modulus = 1e6", falling + "1.1e6] }"),
              HasSubstr("allowed is a modulus of more than zero wherever the material is"));
}

TEST(ElementScene, RefusesAMeshGivenTwice) {
  EXPECT_THAT(error_with(plane, "[mesh]\n", "[mesh]\nfile = \"m.msh\"\n"),
              HasSubstr("mesh.text: found beside a file; give one of them"));
}

}  // namespace
}  // namespace scene

#include "stepping/likely_causes.hpp"

#include <gmock/gmock.h>

#include "small_footing.hpp"

namespace stepping {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::string box(int dimension) {
  return dimension == 2 ? "[geometry]\ndimension = 2\nmin = [5.0, -1.0]\nmax = [7.0, 0.0]\n"
                          "spacing = 0.25\n"
                        : "[geometry]\ndimension = 3\nmin = [5.0, -1.0, 2.0]\n"
                          "max = [7.0, 0.0, 3.0]\nspacing = 0.25\n";
}

// The motions of a box that are left free by what holds it.
template <int Dim>
std::vector<std::string> free_motions(const std::string& holds) {
  const auto reading = scene::parse_scene(
      box(Dim) + "[[material]]\nname = \"a\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n" +
          "poissons_ratio = 0.3\n" + holds,
      "box");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  return free_rigid_motions(model::build_model<Dim>(*reading.scene));
}

std::string support(const std::string& choice, const std::string& directions) {
  return "[[support]]\nname = '" + choice + "'\n" + choice + "\ndirections = " + directions + "\n";
}

std::string mirror(const std::string& axis, const std::string& position) {
  return "[[symmetry]]\naxis = \"" + axis + "\"\nposition = " + position + "\n";
}

const std::string corner = "at = [5.0, -1.0]", bottom = "side = \"bottom\"";

TEST(FreeRigidMotions, OfAPlaneBodyAreTheThreeLessThoseHeld) {
  EXPECT_THAT(free_motions<2>(""),
              UnorderedElementsAre("a shift along x", "a shift along y", "a turn"));
  EXPECT_THAT(free_motions<2>(support(corner, "[\"x\", \"y\"]")), ElementsAre("a turn"));
  EXPECT_THAT(free_motions<2>(support(bottom, "[\"y\"]")), ElementsAre("a shift along x"));
  EXPECT_THAT(free_motions<2>(support(bottom, "[\"x\", \"y\"]")), IsEmpty());
  EXPECT_THAT(
      free_motions<2>(support(corner, "[\"x\", \"y\"]") + support("at = [7.0, -1.0]", "[\"y\"]")),
      IsEmpty());
}

TEST(FreeRigidMotions, AreHeldByMirrorsAndPenaltiesToo) {
  EXPECT_THAT(free_motions<2>(mirror("x", "5.0")), ElementsAre("a shift along y"));
  EXPECT_THAT(free_motions<2>(mirror("x", "5.0") + mirror("y", "-1.0")), IsEmpty());
  EXPECT_THAT(free_motions<2>(support(bottom, "[\"y\"]\nmethod = \"penalty\"")),
              ElementsAre("a shift along x"));
}

TEST(FreeRigidMotions, AreHeldByRigidFaces) {
  const std::string contact = "[\"y\"]\nmethod = \"contact\"\n";
  EXPECT_THAT(free_motions<2>(support(bottom, contact)), ElementsAre("a shift along x"));
  EXPECT_THAT(free_motions<2>(support(bottom, contact + "friction_angle = 20")), IsEmpty());
  // A triangle on its side aslant.
  const auto held = [](const std::string& kind) {
    const auto reading = scene::parse_scene(
        "[geometry]\nspacing = 0.125\n[[material]]\nname = \"a\"\nmodel = \"elastic\"\n"
        "youngs_modulus = 1e6\npoissons_ratio = 0.3\n[[region]]\nname = \"r\"\nmaterial = \"a\"\n"
        "outline = [[0, 0], [2, 1], [0, 2]]\n[[side]]\nname = \"held\"\nkind = \"" +
            kind +
            "\"\nalong = [[0, 0], [2, 1]]\n[[side]]\nname = \"free\"\nkind = \"free\"\n"
            "along = [[2, 1], [0, 2], [0, 0]]\n",
        "triangle");
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return free_rigid_motions(model::build_model<2>(*reading.scene));
  };
  EXPECT_THAT(held("fixed"), IsEmpty());
  EXPECT_THAT(held("roller"), ElementsAre("a shift along x"));
}

TEST(FreeRigidMotions, InSpaceAreSix) {
  EXPECT_EQ(free_motions<3>("").size(), 6U);
  EXPECT_THAT(free_motions<3>(support(bottom, "[\"y\"]")),
              UnorderedElementsAre("a shift along x", "a shift along z", "a turn about y"));
  EXPECT_THAT(free_motions<3>(mirror("x", "5.0") + mirror("z", "2.0")),
              ElementsAre("a shift along y"));
  EXPECT_THAT(free_motions<3>(support(bottom, "[\"x\", \"y\", \"z\"]")), IsEmpty());
}

std::vector<std::string> causes(const SmallFooting& run) {
  return likely_causes(run.scene, run.model, run.state);
}

TEST(LikelyCauses, OfAHeldBodyOfOrdinaryGroundAreNone) {
  EXPECT_THAT(causes(SmallFooting()), IsEmpty());
}

TEST(LikelyCauses, AreNearlyIncompressibleMaterials) {
  EXPECT_THAT(
      causes(SmallFooting({"material.0.poissons_ratio=0.4999", "solver.preconditioner=two_level"})),
      ElementsAre(HasSubstr("material.0.poissons_ratio = 0.4999: next to 0.5")));
  EXPECT_THAT(causes(SmallFooting({"material.0.poissons_ratio=0.4999"})), IsEmpty());
}

TEST(LikelyCauses, AreWeightsThatNoInitialStressCarries) {
  SmallFooting run({"initial_stress.kind=none"});
  EXPECT_THAT(causes(run), ElementsAre(HasSubstr("give [initial_stress] kind = \"geostatic\"")));
  run.state.programme.load = 0.1;  // it was borne
  EXPECT_THAT(causes(run), IsEmpty());
  EXPECT_THAT(causes(SmallFooting({"initial_stress.kind=none", "material.0.model=elastic"})),
              IsEmpty());
}

// G = E / 2.6: the law loses its stiffness against shear where the stresses differ by E / 1.3.
TEST(LikelyCauses, AreStrainsBeyondTheElasticLaw) {
  SmallFooting run({"material.0.model=elastic"});
  run.state.stress.col(7) << 0.76e6, 0.0, 0.0, 0.0;
  EXPECT_THAT(causes(run), IsEmpty());
  run.state.stress.col(7) << 0.3e6, -0.3e6, 0.0, 0.25e6;  // 0.78e6, turned
  EXPECT_THAT(causes(run), ElementsAre(HasSubstr("in 1 of 96 particles the stresses differ")));
  SmallFooting small({"material.0.model=elastic", "approximation.kinematics=small_strain"});
  small.state.stress.col(7) = run.state.stress.col(7);
  EXPECT_THAT(causes(small), IsEmpty()) << "which has no such law";
}

TEST(LikelyCauses, AreCollapsesUnderLoadsThatGrow) {
  SmallFooting run(
      {"drive.kind=load", "drive.scales=gravity", "programme.steps=4", "initial_stress.kind=none"});
  run.state.programme.load = 0.75;
  EXPECT_THAT(causes(run), IsEmpty()) << "nothing yields";
  run.state.plastic_increment[5] = 1e-3;
  EXPECT_THAT(causes(run), ElementsAre(HasSubstr("collapse: the body bears 0.75 of the load")));
}

}  // namespace
}  // namespace stepping

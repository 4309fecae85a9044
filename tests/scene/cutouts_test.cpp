// Cutouts in scenes: what is refused, and what is read.
#include "scene/cutouts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/derived.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;

std::string text_of(const std::string& cutouts, const std::string& geometry = {}) {
  return "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [2.0, 1.0]\nspacing = 0.1\n" +
         geometry +
         "[[material]]\nname = \"m\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
         "poissons_ratio = 0.3\ndensity = 1.0\n[[support]]\nname = \"base\"\nside = \"bottom\"\n"
         "directions = [\"x\", \"y\"]\n" +
         cutouts;
}

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const auto& error : parse_scene(text, "s.toml").errors) errors.push_back(error.text());
  return errors;
}

const std::string hole = "[[cutout]]\nname = \"hole\"\ncentre = [1.0, 0.5]\nradius = 0.25\n";
const std::string slope =
    "[[cutout]]\nname = \"air\"\noutline = [[1.0, 1.0], [2.0, 0.5], [3.0, 2.0]]\n";

TEST(Cutouts, AreReadPrintedAndReadAgain) {
  const auto reading = parse_scene(text_of(hole + "pressure = 5e3\n" + slope), "s.toml");
  ASSERT_TRUE(reading.scene);
  const Scene& scene = *reading.scene;
  EXPECT_EQ(scene.cutout[0].radius, 0.25);
  EXPECT_EQ(scene.cutout[0].pressure, 5e3);
  EXPECT_EQ(scene.cutout[1].outline[2], PlanePoint(3.0, 2.0));
  const auto again = parse_scene(effective_toml(scene), "again.toml");
  ASSERT_TRUE(again.scene);
  EXPECT_EQ(*again.scene, scene);
  EXPECT_TRUE(resolve_consistency(scene));
  // Chords leave the circle by 1e-4 at most, along its length.
  EXPECT_NEAR(body_of(scene).area(), 2.0 - M_PI / 16.0 - 0.25, 1e-4 * 0.5 * M_PI);
}

TEST(Cutouts, ThatAreNoShapeAreRefused) {
  EXPECT_THAT(errors_of(text_of(hole + "outline = [[0, 0], [1, 0], [1, 1]]\n")),
              ElementsAre("s.toml:16:1: cutout.0: an outline and a circle are given; exactly one "
                          "of outline, and centre with radius"));
  EXPECT_THAT(
      errors_of(text_of("[[cutout]]\nname = \"a\"\n")),
      ElementsAre("s.toml:16:1: cutout.0: neither an outline nor a circle is given; exactly "
                  "one of outline, and centre with radius"));
  EXPECT_THAT(errors_of(text_of("[[cutout]]\nname = \"a\"\nradius = 0.25\n")),
              ElementsAre("s.toml:16:1: cutout.0.centre: is missing; a circle has a centre and a "
                          "radius"));
  EXPECT_THAT(
      errors_of(text_of("[[cutout]]\nname = \"a\"\noutline = [[0, 0], [1, 1], [1, 0], [0, 1]]\n")),
      ElementsAre("s.toml:18:11: cutout.0.outline: found no simple polygon; it crosses or touches "
                  "itself"));
  EXPECT_THAT(errors_of(text_of("[[cutout]]\nname = \"a\"\noutline = [[0, 0], [1, 1]]\n")),
              ElementsAre("s.toml:18:11: cutout.0.outline: found no simple polygon; it has fewer "
                          "than three corners"));
}

TEST(Cutouts, ThatLeaveNothingOrTwoBodiesAreRefused) {
  EXPECT_THAT(
      errors_of(text_of("[[cutout]]\nname = \"a\"\ncentre = [1.0, 0.5]\nradius = 3.0\n")),
      ElementsAre("s.toml:16:1: cutout.0: the cutouts leave 0 m2 of the body; a particle stands "
                  "for 0.01 m2"));
  EXPECT_THAT(errors_of(text_of("[[cutout]]\nname = \"a\"\noutline = [[0.9, -1], [1.1, -1], "
                                "[1.1, 2], [0.9, 2]]\n")),
              ElementsAre("s.toml:16:1: cutout.0: the cutouts leave 2 bodies apart; a scene has "
                          "one"));
}

TEST(Cutouts, HaveNoGeostaticStress) {
  EXPECT_THAT(
      errors_of(text_of(hole + "[gravity]\nacceleration = [0.0, -9.81]\n"
                               "[initial_stress]\nkind = \"geostatic\"\n")),
      ElementsAre("s.toml:23:8: initial_stress.kind: found geostatic in a body with cutouts; "
                  "it is the stress of ground without a hole: kind = \"gravity\" settles any; "
                  "what is dug later is a [[region]] that a [[stage]] removes"));
}

TEST(Cutouts, OfBodiesInSpaceAreRegions) {
  EXPECT_THAT(errors_of("[geometry]\ndimension = 3\nmin = [0.0, 0.0, 0.0]\nmax = [2.0, 1.0, 1.0]\n"
                        "spacing = 0.1\n[[material]]\nname = \"m\"\nmodel = \"elastic\"\n"
                        "youngs_modulus = 1e6\npoissons_ratio = 0.3\n[[support]]\nname = \"base\"\n"
                        "side = \"bottom\"\ndirections = [\"x\", \"y\", \"z\"]\n" +
                        hole),
              ElementsAre("s.toml:15:1: cutout.0: found in 3D; only plane bodies have cutouts: in "
                          "space give [[region]]s without it, prisms by geometry.depth, or a "
                          "[mesh]"));
}

TEST(Cutouts, AreOfPlaneBodiesOfCells) {
  EXPECT_THAT(
      errors_of(text_of(hole, "layout = \"vertex\"\n")),
      ElementsAre("s.toml:17:1: cutout.0: found with geometry.layout = \"vertex\"; "
                  "particles of a body with cutouts are those of cells: layout = \"cell\""));
  EXPECT_THAT(errors_of(text_of(hole + "kind = \"fixed\"\npressure = 1e3\n")),
              ElementsAre("s.toml:21:12: cutout.0.pressure: found on a surface of kind fixed; "
                          "tractions act on free surfaces"));
  EXPECT_THAT(errors_of(text_of("[[cutout]]\nname = \"base\"\ncentre = [1.0, 0.5]\n"
                                "radius = 0.25\n")),
              ElementsAre("s.toml:17:8: cutout.0.name: found \"base\" again; it is the name of a "
                          "support"));
}

}  // namespace
}  // namespace scene

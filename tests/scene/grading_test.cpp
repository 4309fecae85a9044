// Where a scene's particles are fine, and how their spacing grows.
#include "scene/grading.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/reader.hpp"
#include "support/sample_scene.hpp"

namespace scene {
namespace {

// The sample's plate ends at (0.5, 0) on the top of [0, 2] x [-1, 0]; its spacing is 0.1.
Scene sample(const std::string& more) {
  const auto reading =
      parse_scene(support::sample_with("width = 0.5\n", "width = 0.5\n" + more), "s.toml");
  if (!reading.scene) throw std::runtime_error(reading.errors[0].text());
  return *reading.scene;
}

double wanted(const Scene& scene, Point min, Point max) {
  return wanted_spacing(scene, fine_places(scene), min, max);
}

TEST(Grading, IsFinestAtTheEndOfAPlateWithinASide) {
  const Scene scene = sample("[grading]\nenabled = true\n");
  const auto places = fine_places(scene);
  ASSERT_EQ(places.size(), 1U);  // the other end is a corner
  EXPECT_EQ(places[0].min, (Point{0.5, 0.0}));
  EXPECT_EQ(places[0].max, (Point{0.5, 0.0}));
  EXPECT_EQ(places[0].spacing, 0.1);
  EXPECT_EQ(places[0].radius, 0.05);  // how far it is driven
}

TEST(Grading, TakesEndsOfLoadsAndThePlacesOfTheScene) {
  const Scene scene = sample(
      "[[traction]]\nname = \"q\"\nside = \"right\"\nrange_min = -0.7\nrange_max = -0.3\n"
      "value = [1.0, 0.0]\n[grading]\nenabled = true\n"
      "[[refine]]\nside = \"left\"\nspacing = 0.2\nradius = 0.3\n"
      "[[refine]]\nregion_min = [1.0, -0.6]\nregion_max = [1.2, -0.4]\n");
  const auto places = fine_places(scene);
  ASSERT_EQ(places.size(), 5U);
  EXPECT_EQ(places[1].min, (Point{2.0, -0.7}));
  EXPECT_EQ(places[2].max, (Point{2.0, -0.3}));
  EXPECT_EQ(places[3].min, (Point{0.0, -1.0}));
  EXPECT_EQ(places[3].max, (Point{0.0, 0.0}));
  EXPECT_EQ(places[3].spacing, 0.2);
  EXPECT_EQ(places[4].max, (Point{1.2, -0.4}));
}

TEST(Grading, GrowsByTheRule) {
  const Scene scene = sample(
      "reference_length = 0.5\n[grading]\nenabled = true\ngrowth = 0.25\nexponent = 0.6\n"
      "coarsest = 0.25\n");
  // 0.9 beside the end, at the surface: A L (r / L)^p.
  EXPECT_DOUBLE_EQ(wanted(scene, {1.4, -0.1}, {1.5, 0.0}), 0.25 * 0.5 * std::pow(0.9 / 0.5, 0.6));
  EXPECT_EQ(wanted(scene, {0.5, -0.1}, {0.6, 0.0}), 0.1);
  EXPECT_EQ(wanted(scene, {0.8, -1.0}, {2.0, 0.0}), 0.1);  // by its nearest point
  const Scene steep = sample("[grading]\nenabled = true\ngrowth = 1.0\ncoarsest = 0.25\n");
  EXPECT_EQ(wanted(steep, {1.4, -0.1}, {1.5, 0.0}), 0.25);
}

TEST(Grading, HasDefaultsFromTheBody) {
  EXPECT_EQ(resolve_grading_length(sample("")), 1.0);
  EXPECT_EQ(resolve_coarsest(sample("")), 0.125);
  EXPECT_EQ(resolve_grading_length(sample("reference_length = 0.5\n")), 0.5);
}

// The body's least extent is 1: closer where an elastic one's finest spacing is less than a 64th of
// that, never where ground yields.
TEST(Grading, IsCloserInElasticBodiesOfFineSpacing) {
  Scene scene = sample("");
  for (Material& material : scene.material) material.model = "von_mises";
  scene.geometry.spacing = 1.0 / 256.0;
  EXPECT_EQ(resolve_growth(scene), 0.125);
  for (Material& material : scene.material) material.model = "elastic";
  EXPECT_DOUBLE_EQ(resolve_growth(scene), 1.0 / 16.0);
  // Of the length of the rule: else the particles of a small footing grow without bound.
  scene.grading.length = 0.25;
  EXPECT_DOUBLE_EQ(resolve_growth(scene), 0.125);
  scene.grading.length.reset();
  // Of no other rule, nor in space, where it was not measured.
  scene.grading.exponent = 0.6;
  EXPECT_EQ(resolve_growth(scene), 0.125);
  scene.grading.exponent = 0.5;
  scene.geometry.dimension = 3;
  EXPECT_EQ(resolve_growth(scene), 0.125);
  scene.geometry.dimension = 2;
  scene.geometry.spacing = 0.1;
  EXPECT_EQ(resolve_growth(scene), 0.125);
  scene.grading.growth = 0.25;
  EXPECT_EQ(resolve_growth(scene), 0.25);
}

TEST(Grading, FollowsRegions) {
  const Scene scene = sample(
      "[grading]\nenabled = true\n[[material]]\nname = \"rock\"\nmodel = \"elastic\"\n"
      "youngs_modulus = 1e9\npoissons_ratio = 0.2\ndensity = 1800.0\n"
      "region_min = [1.0, -1.0]\nregion_max = [2.0, -0.4]\n");
  EXPECT_EQ(wanted(scene, {1.6, -0.5}, {1.8, -0.3}), 0.1);  // cut by the face at y = -0.4
  EXPECT_EQ(wanted(scene, {0.9, -0.9}, {1.1, -0.7}), 0.1);
  EXPECT_GT(wanted(scene, {1.6, -0.6}, {1.8, -0.4}), 0.1);  // within, along it
  EXPECT_GT(wanted(scene, {1.6, -0.4}, {1.8, -0.2}), 0.1);  // without
  // Three cells fit in a layer, which may be a body of its own.
  const Scene seam = sample(
      "[grading]\nenabled = true\ncoarsest = 1.0\ngrowth = 1.0\n"
      "[[material]]\nname = \"rock\"\nmodel = \"elastic\"\n"
      "youngs_modulus = 1e9\npoissons_ratio = 0.2\ndensity = 1800.0\n"
      "region_min = [0.0, -1.0]\nregion_max = [2.0, -0.4]\n");
  EXPECT_DOUBLE_EQ(wanted(seam, {1.8, -0.6}, {2.0, -0.5}), 0.2);
}

TEST(Grading, TurnsTheCorrectionOnAndWarnsWhereItIsOff) {
  const auto reading = parse_scene(support::sample_with("width = 0.5\n",
                                                        "width = 0.5\n[grading]\nenabled = true\n"
                                                        "[approximation]\nconsistency = \"off\"\n"),
                                   "s.toml");
  ASSERT_TRUE(reading.scene);
  ASSERT_EQ(reading.warnings.size(), 1U);
  EXPECT_EQ(reading.warnings[0].text(),
            "s.toml:37:15: approximation.consistency: found off with graded particles; loads are "
            "wrong by tens of per cent without it where widths change");
}

}  // namespace
}  // namespace scene

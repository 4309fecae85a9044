// Bodies of regions in scenes: what is refused, what is read, and what it comes to.
#include "scene/ground.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/box.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/outline_faces.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string base =
    "[geometry]\nspacing = 0.1\n"
    "[[material]]\nname = \"clay\"\nmodel = \"von_mises\"\nyoungs_modulus = 1e6\n"
    "poissons_ratio = 0.3\ncohesion = 1e3\n"
    "[[material]]\nname = \"rock\"\nmodel = \"elastic\"\nyoungs_modulus = 1e9\n"
    "poissons_ratio = 0.3\n";
const std::string layers =
    "[[region]]\nmaterial = \"rock\"\noutline = [[0, 0], [2.05, 0], [2.05, 0.5], [0, 0.3]]\n"
    "[[region]]\nmaterial = \"clay\"\noutline = [[0, 0.3], [2.05, 0.5], [1.2, 1], [0, 1]]\n";

std::string side(const std::string& name, const std::string& kind, const std::string& along) {
  return "[[side]]\nname = \"" + name + "\"\nkind = \"" + kind + "\"\nalong = " + along + "\n";
}

const std::string around = side("left", "symmetry", "[[0, 1], [0, 0]]") +
                           side("rigid", "fixed", "[[0, 0], [2.05, 0], [2.05, 0.5]]") +
                           side("slope", "free", "[[2.05, 0.5], [1.2, 1], [0.5, 1]]") +
                           side("strip", "footing", "[[0, 1], [0.5, 1]]");
const std::string pressed = "[drive]\nkind = \"displacement\"\ntarget = 0.01\n";

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const auto& error : parse_scene(text, "s.toml").errors) errors.push_back(error.text());
  return errors;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error(what + " is not in the scene");
  return text.replace(at, what.size(), by);
}

TEST(Prisms, HaveADepthOfWholeSpacings) {
  const std::string ends = "[[support]]\nname = \"end\"\nside = \"front\"\ndirections = [\"z\"]\n";
  const auto with = [&](const std::string& geometry) {
    const auto errors = errors_of(replaced(base, "spacing = 0.1\n", "spacing = 0.1\n" + geometry) +
                                  layers + around + pressed + ends);
    return errors.empty() ? "" : errors[0];
  };
  EXPECT_EQ(with("dimension = 3\ndepth = [-0.2, 0.3]\n"), "");
  EXPECT_THAT(with("dimension = 3\ndepth = [0.3, -0.2]\n"),
              HasSubstr("geometry.depth: is no length along z"));
  EXPECT_THAT(with("dimension = 3\ndepth = [0, 0.55]\n"),
              HasSubstr("5.5 times in the extent 0.55 along z"));
  EXPECT_THAT(with("dimension = 3\ndepth = [0, 0.5]\njitter = 0.1\n"),
              HasSubstr("geometry.jitter: found with regions in 3D"));
  EXPECT_THAT(with("depth = [0, 0.5]\n"), HasSubstr("geometry.depth: found in a plane"));
  const std::string graded = "dimension = 3\ndepth = [0, 0.5]\n[grading]\nenabled = true\n";
  EXPECT_EQ(with(graded), "");
  EXPECT_EQ(with(graded + "[[refine]]\nat = [1.0, 0.2, 0.3]\n"), "");
  EXPECT_THAT(with(graded + "[[refine]]\nat = [1.0, 0.2]\n"), HasSubstr("refine.0.at: "));
  EXPECT_THAT(with(graded + "[[refine]]\nat = [1.0, 0.2, 0.7]\n"), HasSubstr("refine.0.at: "));
  EXPECT_THAT(with(graded + "coarsest = 0.05\n"), HasSubstr("grading.coarsest: found 0.05"));
  const auto reading = parse_scene(
      replaced(base, "spacing = 0.1\n", "spacing = 0.1\ndimension = 3\ndepth = [-0.2, 0.3]\n") +
          layers + around + pressed + ends,
      "s.toml");
  ASSERT_TRUE(reading.scene);
  EXPECT_THAT(reading.scene->drive.range_min, ElementsAre(0.0, -0.2));
  EXPECT_THAT(reading.scene->drive.range_max, ElementsAre(0.5, 0.3));
  EXPECT_NEAR(*reading.scene->drive.width, 0.25, 1e-15);
}

TEST(GroundScene, SaysWhatItsSidesComeTo) {
  const auto reading = parse_scene(base + layers + around + pressed, "s.toml");
  ASSERT_TRUE(reading.scene) << errors_of(base + layers + around + pressed)[0];
  const Scene& scene = *reading.scene;
  EXPECT_THAT(scene.geometry.min, ElementsAre(0.0, 0.0));
  // A whole number of spacings; what is right of the regions is cut away.
  EXPECT_NEAR(scene.geometry.max[0], 2.1, 1e-15);
  EXPECT_EQ(scene.geometry.max[1], 1.0);
  EXPECT_NEAR(body_of(scene).area(), 2.05 - 0.5 * 0.85 * 0.5, 1e-14);
  // The right side is not on the box, so that the particles are tied to it.
  ASSERT_EQ(scene.support.size(), 1U);
  EXPECT_EQ(scene.support[0].name, "rigid bottom");
  EXPECT_EQ(scene.support[0].side, Side::bottom);
  EXPECT_THAT(scene.support[0].directions, ElementsAre(Axis::x, Axis::y));
  EXPECT_THAT(tied_surfaces(scene), ElementsAre("rigid"));
  ASSERT_EQ(scene.symmetry.size(), 1U);
  EXPECT_EQ(scene.symmetry[0].axis, Axis::x);
  EXPECT_EQ(scene.drive.side, Side::top);
  EXPECT_THAT(scene.drive.range_min, ElementsAre(0.0));
  EXPECT_THAT(scene.drive.range_max, ElementsAre(0.5));
  EXPECT_THAT(scene.drive.direction, ElementsAre(0.0, -1.0));
  EXPECT_EQ(scene.drive.width, 0.5);
  const Point in_clay{0.1, 0.9}, in_rock{1.9, 0.1};
  EXPECT_EQ(material_at(scene, in_clay), 0U);
  EXPECT_EQ(material_at(scene, in_rock), 1U);
}

TEST(GroundScene, IsPrintedAndReadAgain) {
  for (const std::string& text :
       {base + layers + around + pressed, base + layers + replaced(around, "footing", "loaded") +
                                              "[load]\nsought = \"traction\"\nkh = 0.1\n"}) {
    const auto reading = parse_scene(text, "s.toml");
    ASSERT_TRUE(reading.scene);
    const auto again = parse_scene(effective_toml(*reading.scene), "again.toml");
    ASSERT_TRUE(again.scene);
    EXPECT_EQ(*again.scene, *reading.scene);
  }
}

// Arcs become chords when they are read, holes stay what they are.
TEST(GroundScene, HasArcsAndHolesThatArePrintedAndReadAgain) {
  const std::string arc = "{ centre = [0, 0], radius = 2, from = 0, to = 90, chords = 36 }";
  const std::string bore = "{ centre = [0.8, 0.8], radius = 0.3 }";
  const std::string text =
      base + "[[region]]\nmaterial = \"clay\"\noutline = [[0, 0], [2, 0], " + arc +
      ", [0, 2]]\nholes = [[" + bore + "]]\n" + side("left", "symmetry", "[[0, 0], [0, 2]]") +
      side("bottom", "fixed", "[[0, 0], [2, 0]]") + side("mantle", "free", "[" + arc + "]") +
      side("bore", "loaded", "[" + bore + "]") + "";
  const auto reading = parse_scene(text, "s.toml");
  ASSERT_TRUE(reading.scene) << errors_of(text)[0];
  EXPECT_EQ(reading.scene->region[0].outline.size(), 1U + 10U);
  ASSERT_EQ(reading.scene->region[0].holes.size(), 1U);
  const auto polygon = [](double radius, double chords) {  // its area
    return 0.5 * chords * radius * radius * std::sin(2.0 * std::numbers::pi / chords);
  };
  EXPECT_NEAR(body_of(*reading.scene).area(), polygon(2.0, 36.0) / 4.0 - polygon(0.3, 144.0),
              1e-13);
  const auto again = parse_scene(effective_toml(*reading.scene), "again.toml");
  ASSERT_TRUE(again.scene);
  EXPECT_EQ(*again.scene, *reading.scene);
  for (const auto& [right, wrong] :
       {std::pair("radius = 2", "radius = 0"), std::pair("from = 0, ", ""),
        std::pair("chords = 36", "chords = 3"), std::pair("chords = 36", "points = 36")}) {
    EXPECT_THAT(errors_of(replaced(text, right, wrong)),
                ElementsAre(::testing::HasSubstr("region.0.outline: ")));
  }
}

std::string of_groups(const std::string& text) {
  std::string groups = "[mesh]\nfile = \"" FPM_SHARE_DIR "/scenes/tunnel.msh\"\n";
  groups += base;
  for (const char* soil : {"soft clay", "stiff clay"}) {
    groups += std::string("[[region]]\nmaterial = \"clay\"\ngroup = \"") + soil + "\"\n";
  }
  for (const char* name : {"level", "slope", "tunnel", "base", "left", "right", "footing"}) {
    groups += std::string("[[side]]\nname = \"") + name + "\"\nkind = \"free\"\ngroup = \"" + name +
              "\"\n";
  }
  return groups + text;
}

// What is read of a mesh is in the scene, which then wants the file no more.
TEST(GroundScene, TakesRegionsAndSidesFromAMesh) {
  const auto reading = parse_scene(of_groups(""), "s.toml");
  ASSERT_TRUE(reading.scene) << errors_of(of_groups(""))[0];
  const Scene& scene = *reading.scene;
  EXPECT_TRUE(scene.mesh.file.empty());
  ASSERT_EQ(scene.region.size(), 2U);
  EXPECT_EQ(scene.region[0].outline.size(), 4U);
  ASSERT_EQ(scene.region[1].holes.size(), 1U);
  // The polygons of tunnel.geo, the tunnel's of as many chords as the mesh has there.
  const auto chords = static_cast<double>(scene.region[1].holes[0].size());
  const double tunnel = 0.5 * chords * 0.49 * std::sin(2.0 * std::numbers::pi / chords);
  const double ground = 8.0 * 4.0 + 3.0 * 4.0 + 0.5 * (4.0 + 2.5) * 3.0 + 0.5 * (2.5 + 2.0) + 6.0;
  EXPECT_NEAR(body_of(scene).area(), ground - tunnel, 1e-6);
  const auto again = parse_scene(effective_toml(scene), "elsewhere/again.toml");
  ASSERT_TRUE(again.scene);
  EXPECT_EQ(*again.scene, scene);
}

TEST(GroundScene, RefusesGroupsThatAreNone) {
  const std::string good = of_groups("");
  const auto with = [&](const std::string& what, const std::string& by) {
    const auto errors = errors_of(replaced(good, what, by));
    return errors.empty() ? "" : errors.front();
  };
  EXPECT_THAT(
      with("group = \"tunnel\"", "group = \"tunel\""),
      HasSubstr("side.2.group: found \"tunel\"; the mesh's physical curves with elements are "
                "base, footing, left, level, right, slope, tunnel; did you mean \"tunnel\"?"));
  EXPECT_THAT(with("group = \"soft clay\"", "group = \"base\""),
              HasSubstr("region.0.group: found \"base\"; the mesh's physical surfaces"));
  EXPECT_THAT(with("group = \"soft clay\"", "outline = [[0, 0], [1, 0], [0, 1]]\ngroup = \"base\""),
              HasSubstr("region.0.group: found \"base\" beside outline; give one of them"));
  EXPECT_THAT(with("group = \"soft clay\"", "name = \"x\""),
              HasSubstr("region.0.outline: is missing"));
  EXPECT_THAT(with("tunnel.msh", "nothing.msh"), HasSubstr("nothing.msh: cannot be read"));
  EXPECT_THAT(with("tunnel.msh", "tunnel.geo"),
              HasSubstr("tunnel.geo:1: it does not begin with $MeshFormat"));
  EXPECT_THAT(errors_of(good.substr(good.find("[geometry]")))[0],
              HasSubstr("region.0.group: found \"soft clay\" without a mesh"));
  EXPECT_THAT(errors_of("[mesh]\nfile = \"" FPM_SHARE_DIR "/scenes/tunnel.msh\"\n" + base)[0],
              HasSubstr("of which no region or side names a group"));
}

// Ground under its geostatic stress is of one weight and K0 at each level.
TEST(GroundScene, IsLevelUnderItsGeostaticStress) {
  const auto with = [&](const std::string& joint, const std::string& sand,
                        const std::string& more = {}) {
    return "[geometry]\nspacing = 0.1\n"
           "[[material]]\nname = \"clay\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\n"
           "poissons_ratio = 0.3\nunit_weight = 17e3\n"
           "[[material]]\nname = \"sand\"\nmodel = \"elastic\"\nyoungs_modulus = 3e7\n" +
           sand + "[[region]]\nname = \"upper\"\nmaterial = \"clay\"\noutline = [[0, -1], " +
           joint +
           ", [3, 0], [0, 0]]\n[[region]]\nname = \"lower\"\nmaterial = \"sand\"\n"
           "outline = [[0, -2], [3, -2], " +
           joint + ", [0, -1]]\n" + side("held", "fixed", "[[0, 0], [0, -2], [3, -2], [3, 0]]") +
           side("top", "free", "[[3, 0], [0, 0]]") + "[initial_stress]\nkind = \"geostatic\"\n" +
           more;
  };
  const std::string heavier = "poissons_ratio = 0.3\nunit_weight = 19e3\n";
  const std::string as_heavy = "poissons_ratio = 0.3\nunit_weight = 17e3\n";
  const std::string of_another_k0 = "poissons_ratio = 0.2\nunit_weight = 17e3\n";
  EXPECT_THAT(errors_of(with("[3, -1]", heavier)), ::testing::IsEmpty());
  EXPECT_THAT(errors_of(with("[3, -0.5]", as_heavy)), ::testing::IsEmpty());
  EXPECT_THAT(errors_of(with("[3, -0.5]", of_another_k0, "K0 = 0.5\n")), ::testing::IsEmpty());
  const std::string beside =
      "initial_stress.kind: found geostatic, and \"upper\" and \"lower\", of another weight or K0, "
      "are both there from y = -1 to -0.5; geostatic is the stress in level layers: kind = "
      "\"gravity\" settles ground of any layers";
  EXPECT_THAT(errors_of(with("[3, -0.5]", heavier)), ElementsAre(HasSubstr(beside)));
  EXPECT_THAT(errors_of(with("[3, -0.5]", of_another_k0)), ElementsAre(HasSubstr(beside)));
  // Not what a stage puts down.
  EXPECT_THAT(errors_of(with("[3, -0.5]", heavier,
                             "[[stage]]\nname = \"fill\"\nplace = [\"upper\"]\nsteps = 1\n")),
              ::testing::IsEmpty());
  EXPECT_THAT(
      errors_of(with("[3, -1]", heavier, "surface = -0.5\n")),
      ElementsAre(HasSubstr("initial_stress.surface: found -0.5; below the top face, y = 0, "
                            "the soil above would be in tension")));
  EXPECT_THAT(
      errors_of(with("[3, -1]",
                     "poissons_ratio = 0.3\nunit_weight = { at = [0, 0], value = 19e3, "
                     "gradient = [100, 0] }\n")),
      ElementsAre(HasSubstr("material.1.unit_weight: changes along x, and the initial stress is "
                            "geostatic; allowed is a weight that changes along y alone: kind = "
                            "\"gravity\" settles ground of any layers")));
  EXPECT_THAT(errors_of(with("[3, -1]", heavier, "[water]\nr_u = 0.2\n")),
              ElementsAre(HasSubstr("water.r_u: found with a geostatic initial stress; a share of "
                                    "the overburden is for slopes")));
}

// A box bears it, by a dead load, and says so.
TEST(GroundScene, WarnsOfABoxThatIsNotLevelUnderItsGeostaticStress) {
  const auto warnings = [&](const std::string& more) {
    const auto reading = parse_scene(
        "[geometry]\nmin = [0, -2]\nmax = [3, 0]\nspacing = 0.1\n"
        "[[material]]\nname = \"clay\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\n"
        "poissons_ratio = 0.3\nunit_weight = 17e3\n"
        "[[material]]\nname = \"wall\"\nmodel = \"elastic\"\nyoungs_modulus = 3e7\n"
        "poissons_ratio = 0.3\n" +
            more +
            "[initial_stress]\nkind = \"geostatic\"\n[[support]]\nname = \"base\"\n"
            "side = \"bottom\"\ndirections = [\"x\", \"y\"]\n",
        "s.toml");
    std::vector<std::string> texts;
    for (const auto& complaint : reading.warnings) texts.push_back(complaint.text());
    return texts;
  };
  const std::string layer = "region_min = [0, -2]\nregion_max = [3, -1]\n";
  const std::string part = "region_min = [0, -1]\nregion_max = [1, 0]\n";
  EXPECT_THAT(warnings("unit_weight = 24e3\n" + layer), ::testing::IsEmpty());
  EXPECT_THAT(warnings("unit_weight = 17e3\n" + part), ::testing::IsEmpty());
  EXPECT_THAT(warnings("unit_weight = 24e3\n" + part),
              ElementsAre(HasSubstr("initial_stress.kind: found geostatic, and \"wall\" and "
                                    "\"clay\", of another weight or K0, side by side; a dead load "
                                    "bears what that leaves unbalanced")));
}

// A bench below a level, and what is no base.
TEST(GroundScene, HasFootingsOnNoFaceOfTheBox) {
  const auto scene_with = [&](const std::string& footing, const std::string& more) {
    return base +
           "[[region]]\nmaterial = \"clay\"\noutline = [[0, 0], [3, 0], [3, 0.5], [2, 0.5], "
           "[1.5, 1], [1, 1], [1, 2], [0, 2]]\n" +
           side("strip", "footing", footing) + side("left", "symmetry", "[[0, 0], [0, 2]]") +
           side("base", "fixed", "[[0, 0], [3, 0]]") + more + pressed;
  };
  const std::string level = "[[1, 1], [1.5, 1]]";
  const auto reading =
      parse_scene(scene_with(level, side("rest", "free", "[[3, 0], [3, 0.5], [2, 0.5], [1.5, 1]]") +
                                        side("wall", "free", "[[1, 1], [1, 2], [0, 2]]")),
                  "s.toml");
  ASSERT_TRUE(reading.scene);
  const Drive& drive = reading.scene->drive;
  EXPECT_EQ(drive.side, Side::top);
  EXPECT_EQ(drive.level, 1.0);
  EXPECT_EQ(plate_position(reading.scene->geometry, reading.scene->drive), 1.0);
  EXPECT_EQ(resolve_drive_method(*reading.scene), DriveMethod::ghosts);
  const auto upright = parse_scene(
      scene_with("[[1, 2], [1, 1]]",
                 side("rest", "free", "[[3, 0], [3, 0.5], [2, 0.5], [1.5, 1], [1, 1]]") +
                     side("top", "free", "[[1, 2], [0, 2]]")),
      "s.toml");
  ASSERT_TRUE(upright.scene);
  EXPECT_EQ(upright.scene->drive.side, Side::right);
  EXPECT_EQ(upright.scene->drive.level, 1.0);
  EXPECT_THAT(upright.scene->drive.direction, ElementsAre(-1.0, 0.0));
  EXPECT_THAT(errors_of(scene_with("[[2, 0.5], [1.5, 1]]",
                                   side("rest", "free", "[[3, 0], [3, 0.5], [2, 0.5]]") +
                                       side("top", "free", "[[1.5, 1], [1, 1], [1, 2], [0, 2]]"))),
              ElementsAre(::testing::HasSubstr("side.0.along: the base at (2, 0.5) is aslant")));
  EXPECT_THAT(
      errors_of(scene_with(level, side("rest", "free", "[[3, 0], [3, 0.5], [2, 0.5], [1.5, 1]]") +
                                      side("wall", "free", "[[1, 1], [1, 2], [0, 2]]")) +
                "method = \"direct\"\n"),
      ElementsAre(::testing::HasSubstr("drive.method: found direct, with a footing on no face")));
}

// A face that is held in part only is held by springs, where it is.
TEST(GroundScene, HoldsFacesAsAWholeOrByTheirPoints) {
  const auto reading =
      parse_scene(base + layers + side("left", "roller", "[[0, 0.5], [0, 0]]") +
                      side("wall", "free", "[[0, 0.5], [0, 1]]") +
                      around.substr(around.find("[[side]]\nname = \"rigid\"")) + pressed,
                  "s.toml");
  ASSERT_TRUE(reading.scene);
  EXPECT_EQ(reading.scene->support.size(), 1U);
  EXPECT_THAT(tied_surfaces(*reading.scene), ::testing::UnorderedElementsAre("left", "rigid"));
}

TEST(GroundScene, TakesWeightsAndEarthquakes) {
  const std::string heavy =
      replaced(replaced(base, "cohesion = 1e3\n", "cohesion = 1e3\nunit_weight = 18e3\n"),
               "youngs_modulus = 1e9\n", "youngs_modulus = 1e9\nunit_weight = 25e3\n") +
      layers + replaced(around, "symmetry", "roller") + pressed;
  const auto still = parse_scene(heavy, "s.toml");
  ASSERT_TRUE(still.scene);
  EXPECT_THAT(still.scene->gravity.acceleration, ElementsAre(0.0, -9.81));
  EXPECT_DOUBLE_EQ(still.scene->material[0].density.value, 18e3 / 9.81);
  const auto shaken = parse_scene(heavy + "[load]\nkh = -0.2\nkv = 0.1\n", "s.toml");
  ASSERT_TRUE(shaken.scene);
  const Point& acceleration = shaken.scene->gravity.acceleration;
  const double density = shaken.scene->material[1].density.value;
  EXPECT_NEAR(density * acceleration[0], -0.2 * 25e3, 1e-9);
  EXPECT_NEAR(density * acceleration[1], -0.9 * 25e3, 1e-9);
  EXPECT_THAT(
      errors_of(replaced(heavy, "unit_weight = 18e3\n", "unit_weight = 18e3\ndensity = 1800.0\n")),
      ElementsAre("s.toml:9:15: material.0.unit_weight: found 18000, and a density of 1800; "
                  "it would be 17658 with gravity's 9.81 m/s2: give one of them"));
}

struct Bad {
  std::string text, message;
};

TEST(GroundScene, ThatIsNoGroundIsRefused) {
  const std::string good = base + layers + around + pressed;
  const Bad all[] = {
      {replaced(good, "material = \"rock\"", "material = \"rocks\""),
       "s.toml:15:12: region.0.material: found \"rocks\"; materials are clay, rock; did you mean "
       "\"rock\"?"},
      {replaced(good, "name = \"slope\"", "name = \"rigid\""),
       "s.toml:29:8: side.2.name: found \"rigid\" again; names of sides are unique"},
      {replaced(good, "[1.2, 1], [0, 1]]", "[0, 1], [1.2, 1]]"),
       "s.toml:19:11: region.1.outline: the polygon crosses itself at (0.846192, 0.793612); an "
       "outline passes no place twice"},
      {replaced(good, "[2.05, 0.5], [0, 0.3]]", "[2.05, 0.5], [0, 0.6]]"),
       "s.toml:19:11: region.1.outline: \"region 0\" and \"region 1\" overlap at (1.025, 0.55); "
       "regions share sides at most"},
      {replaced(good, "[[2.05, 0.5], [1.2, 1], [0.5, 1]]", "[[2.05, 0.5], [1.2, 1]]"),
       "s.toml:19:11: region.1.outline: no [[side]] names the outline (1.2, 1) - (0.5, 1); every "
       "part of the outline belongs to a side"},
      {replaced(good, "[[0, 1], [0.5, 1]]", "[[0, 1], [0.5, 1.2]]"),
       "s.toml:35:9: side.3.along: (0, 1) - (0.5, 1.2) lies off the ground's outline; a side "
       "follows "
       "the outline of the regions together"},
      {replaced(good, "kind = \"displacement\"\ntarget = 0.01\n", "kind = \"none\"\n"),
       "s.toml:34:8: side.3.kind: found a footing that nothing moves or loads; a footing wants "
       "[drive] kind = \"displacement\", or \"load\" with plate among its scales"},
      {replaced(good, "kind = \"free\"", "kind = \"loaded\"\nlive_pressure = 1.0"),
       "s.toml:31:17: side.2.live_pressure: found 1, which nothing lets grow; it grows in a drive "
       "of "
       "kind load with traction among its scales; what is there from the start is pressure or "
       "shear"},
      {replaced(good, "kind = \"free\"", "kind = \"free\"\npressure = 1.0"),
       "s.toml:31:12: side.2.pressure: given for a side of kind free; it belongs to kind loaded"},
      {replaced(good, "spacing = 0.1", "spacing = 0.1\nmin = [0.1, 0.0]"),
       "s.toml:3:7: geometry.min: regions reach beyond it, to 0 along x; the box holds all "
       "regions: "
       "leave it out"},
      {replaced(good, "spacing = 0.1", "spacing = 0.1\ndimension = 3"),
       "s.toml:1:1: geometry.depth: is missing, with a [[region]] in 3D; regions of polygons in 3D "
       "are prisms"},
      {base + "[geometry2]\n", "s.toml:14:2: geometry2: no such table; "},
      {replaced(good, layers, ""),
       "s.toml:14:1: side.0: found without a [[region]]; sides are parts of the outline of "
       "regions; "
       "the faces of a box are left, right, bottom, top"},
      {replaced(good, "cohesion = 1e3\n", "cohesion = 1e3\nregion_min = [0, 0]\n"),
       "s.toml:9:14: material.0.region_min: found in a body of regions; a [[region]] says where "
       "its "
       "material is"},
  };
  for (const char* key : {"surface", "surcharge"}) {
    EXPECT_THAT(
        errors_of(replaced(good, "cohesion = 1e3\n", "cohesion = 1e3\nunit_weight = 1e4\n") +
                  "[initial_stress]\nkind = \"gravity\"\n" + key + " = 1.0\n"),
        ::testing::Contains(
            ::testing::HasSubstr(std::string("initial_stress.") + key +
                                 ": found with kind = \"gravity\"; it belongs to geostatic")));
  }
  EXPECT_THAT(errors_of(replaced(good, "cohesion = 1e3\n", "cohesion = 1e3\nunit_weight = 1e4\n") +
                        "[gravity]\nacceleration = [1.0, -10.0]\n"
                        "[initial_stress]\nkind = \"gravity\"\nK0 = 1.0\n"),
              ::testing::Contains(::testing::HasSubstr(
                  "gravity.acceleration: found a direction other than -y; initial_stress.K0 is "
                  "horizontal over vertical stress")));
  for (const Bad& bad : all) {
    const auto errors = errors_of(bad.text);
    ASSERT_FALSE(errors.empty()) << bad.message;
    EXPECT_THAT(errors[0], ::testing::StartsWith(bad.message));
  }
}

}  // namespace
}  // namespace scene

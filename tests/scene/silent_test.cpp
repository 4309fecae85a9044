// Scenes that would be silently wrong: refused, or said.

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "scene/derived.hpp"
#include "scene/places.hpp"
#include "scene/reader.hpp"
#include "support/sample_scene.hpp"

namespace scene {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

std::vector<std::string> texts(const std::vector<tables::Complaint>& complaints) {
  std::vector<std::string> all;
  for (const tables::Complaint& complaint : complaints) all.push_back(complaint.text());
  return all;
}

SceneReading with(const std::vector<std::string>& settings, const std::string& tail = "") {
  return parse_scene(std::string(support::sample_scene) + tail, "s.toml", settings);
}

std::vector<std::string> errors(const std::vector<std::string>& settings,
                                const std::string& tail = "") {
  return texts(with(settings, tail).errors);
}

std::string support_of(const std::string& name, const std::string& choice) {
  return "[[support]]\nname = \"" + name + "\"\n" + choice + "\ndirections = \"y\"\n";
}

TEST(Places, ALineOfDecimalsHoldsItsParticlesInBothLayouts) {
  // The lattice of a body from 0 to 2 at a spacing of 0.1: 19 inner lines of vertices.
  for (int line = 1; line <= 19; ++line) {
    const double y = std::stod("0." + std::to_string(line)) * (line < 10 ? 1.0 : 10.0);
    const Geometry vertex{
        .min = {0.0, 0.0}, .max = {1.0, 2.0}, .spacing = 0.1, .layout = Layout::vertex};
    const LatticeBox box = lattice_box(vertex, {0.0, y}, {1.0, y});
    EXPECT_EQ(box.first[1], line);
    EXPECT_EQ(box.last[1], line);
    EXPECT_EQ(box.last[0], 10);
  }
  const Geometry cell{.min = {0.0, 0.0}, .max = {1.0, 2.0}, .spacing = 0.1};
  EXPECT_FALSE(lattice_box(cell, {0.0, 0.35}, {1.0, 0.35}).empty());
  EXPECT_TRUE(lattice_box(cell, {0.0, 0.31}, {1.0, 0.34}).empty());
}

// Map coordinates: five thousand kilometres from the origin they are known to a nanometre.
TEST(Places, ALineOfDecimalsHoldsItsParticlesFarFromTheOrigin) {
  const Geometry far{
      .min = {5e6, 5e6}, .max = {5000001.0, 5000002.0}, .spacing = 0.1, .layout = Layout::vertex};
  for (int line = 1; line <= 19; ++line) {
    const double y =
        std::stod("500000" + std::to_string(line / 10) + "." + std::to_string(line % 10));
    const LatticeBox box = lattice_box(far, {5e6, y}, {5000001.0, y});
    EXPECT_EQ(box.first[1], line);
    EXPECT_EQ(box.last[1], line);
  }
}

TEST(Places, HalfwayBetweenTwoParticlesMeanTheFirst) {
  for (const double origin : {0.0, 5e6}) {
    const Geometry cell{
        .min = {origin, origin}, .max = {origin + 1.0, origin + 1.0}, .spacing = 0.1};
    for (int line = 1; line <= 9; ++line) {
      Support support;
      support.at = {origin + 0.1 * line, origin + 0.05};
      EXPECT_EQ(lattice_box(cell, support).first[0], line - 1);
    }
  }
}

TEST(Places, TooFarForTheSpacingAreRefused) {
  const auto at = [](const char* min, const char* max) {
    return errors({std::string("geometry.min=[") + min + ", -1.0]",
                   std::string("geometry.max=[") + max + ", 0.0]",
                   std::string("symmetry.0.position=") + min, std::string("drive.range_min=") + min,
                   std::string("drive.range_max=") + max});
  };
  EXPECT_THAT(at("5e6", "5000002.0"), IsEmpty());
  EXPECT_THAT(at("5e9", "5000000002.0"),
              ElementsAre(HasSubstr("geometry.min: found so far from the origin that its "
                                    "coordinates are known to 1.1e-06 m, with a spacing of 0.1")));
}

TEST(Places, MaterialsReachToTheLastDigitOfTheirRegions) {
  Scene scene;
  scene.geometry = {.min = {0.0, 0.0}, .max = {1.0, 2.0}, .spacing = 0.1};
  scene.material.resize(2);
  scene.material[1].region_min = {0.0, 0.3};
  scene.material[1].region_max = {1.0, 0.3};
  const std::vector<double> place{0.5, 3 * 0.1};  // a digit above 0.3
  EXPECT_EQ(material_at(scene, place), 1U);
}

TEST(Regions, ThatHoldNobodyAreRefused) {
  EXPECT_THAT(errors({}, support_of("e", "region_min = [0.41, -0.49]\nregion_max = [0.44, -0.41]")),
              ElementsAre("s.toml:36:14: support.1.region_min: no particle lies between region_min "
                          "and region_max; particles are 0.1 apart"));
  EXPECT_THAT(errors({}, support_of("e", "region_min = [0.41, -0.49]\nregion_max = [0.46, -0.41]")),
              IsEmpty());
  EXPECT_THAT(errors({},
                     "[[material]]\nname = \"m\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
                     "poissons_ratio = 0.2\ndensity = 1.0\nregion_min = [0.41, -0.44]\n"
                     "region_max = [0.44, -0.41]\n"),
              ElementsAre(HasSubstr("material.1.region_min: no particle lies between")));
}

TEST(Names, AreUniqueWhereTheyAreSaidToBe) {
  EXPECT_THAT(
      errors({}, support_of("base", "at = [1.0, -0.5]")),
      ElementsAre("s.toml:35:8: support.1.name: found \"base\" again; names of supports are "
                  "unique"));
  const std::string load = "[[traction]]\nname = \"p\"\nside = \"right\"\nvalue = [1.0, 0.0]\n";
  EXPECT_THAT(errors({}, load + load),
              ElementsAre(HasSubstr("traction.1.name: found \"p\" again")));
}

TEST(Drive, AndASupportMayNotBothSayHowFarAParticleMoves) {
  EXPECT_THAT(errors({}, support_of("e", "at = [0.2, 0.0]")),
              ElementsAre(StartsWith("s.toml:37:14: support.1.directions: found y, along which the "
                                     "drive moves some of its particles")));
  EXPECT_THAT(errors({}, support_of("e", "at = [0.9, 0.0]")), IsEmpty());
  EXPECT_THAT(errors({"support.1.directions=x"}, support_of("e", "at = [0.2, 0.0]")), IsEmpty());
}

TEST(Drive, IntoAMirrorIsRefused) {
  EXPECT_THAT(errors({"drive.side=left", "drive.direction=[1.0, 0.0]", "drive.range_min=-0.5",
                      "drive.range_max=-0.1"}),
              ElementsAre(StartsWith("--set drive.side=left: drive.side: found left, which is a "
                                     "mirror")));
}

TEST(Drive, FreeAcrossAnObliqueDirectionIsRefused) {
  EXPECT_THAT(errors({"drive.direction=[0.6, -0.8]", "drive.lateral=free"}),
              ElementsAre(StartsWith("--set drive.lateral=free: drive.lateral: found free with an "
                                     "oblique direction")));
  EXPECT_THAT(errors({"drive.direction=[0.6, -0.8]"}), IsEmpty());
}

TEST(Drive, OfEndlesslyManyStepsIsRefused) {
  EXPECT_THAT(errors({"programme.increment_over_spacing=1e-20"}),
              ElementsAre("--set programme.increment_over_spacing=1e-20: "
                          "programme.increment_over_spacing: found 1e-20, which makes 5e+19 steps; "
                          "allowed are at most 1000000000"));
}

// What holds where a plate was, once that is gone, is not there while it is driven.
TEST(Drive, AndASupportMayTakeTurns) {
  const std::string lid = support_of("lid", "side = \"top\"");
  const std::string first = "[[stage]]\nname = \"a\"\nto = 0.05\n";
  const std::string hold = "[[stage]]\nname = \"b\"\nsteps = 2\nhold = [\"lid\"]\n";
  EXPECT_THAT(errors({}, lid + first + hold + "release = [\"drive\"]\n"), IsEmpty());
  EXPECT_THAT(errors({}, lid + first + hold),
              ElementsAre(HasSubstr("support.1.directions: found y, along which the drive moves")));
}

TEST(Stage, SaysThatWhatDoesNotFadeInTheLastOneNeverDoes) {
  const std::string two =
      "[[stage]]\nname = \"a\"\nto = 0.05\n[[stage]]\nname = \"b\"\nto = 0.06\n";
  const auto warnings = [&](const std::string& setting) {
    return texts(with({setting}, two).warnings);
  };
  EXPECT_THAT(warnings("stage.1.fades=0.2"),
              Contains("--set stage.1.fades=0.2: stage.1.fades: found 0.2 in the last stage; the "
                       "rest of what changes leave unbalanced never fades: the run ends out of "
                       "equilibrium"));
  EXPECT_THAT(warnings("stage.0.fades=0.2"), Not(Contains(HasSubstr("fades"))));
}

TEST(Traction, ThroughAMirrorIsRefused) {
  EXPECT_THAT(
      errors({}, "[[traction]]\nname = \"p\"\nside = \"left\"\nvalue = [1.0, 0.0]\n"),
      ElementsAre(StartsWith("s.toml:36:8: traction.0.side: found left, which is a mirror")));
}

TEST(Traction, ThatFollowsHasNoPartAlongTheSide) {
  const std::string load =
      "[[traction]]\nname = \"p\"\nside = \"right\"\nvalue = [1.0, -3e3]\nfollower = true\n";
  EXPECT_THAT(errors({}, load), ElementsAre(StartsWith("s.toml:37:9: traction.0.value: found -3000 "
                                                       "along the side, with follower = true")));
  EXPECT_THAT(errors({"traction.0.value=[1.0, 0.0]"}, load), IsEmpty());
}

TEST(InitialStress, SaysThatNoTractionCarriesItsSurcharge) {
  const std::vector<std::string> surcharge{"initial_stress.surcharge=1e5", "initial_stress.K0=1.0"};
  EXPECT_THAT(
      texts(with(surcharge).warnings),
      ElementsAre(HasSubstr("initial_stress.surcharge: the initial stress carries 100000 Pa "
                            "on the top face, but no traction does from the start")));
  EXPECT_THAT(texts(with(surcharge,
                         "[[traction]]\nname = \"q\"\nside = \"top\"\nrange_min = 0.5\n"
                         "range_max = 2.0\nvalue = [0.0, -1e5]\n")
                        .warnings),
              IsEmpty());
}

// Rankine: without cohesion K0 lies between tan^2(45 - phi/2) and its inverse, 0.4903 and 2.0396
// for 20 degrees.
TEST(InitialStress, SaysWhereTheGroundCannotBearIt) {
  const auto warned = [](const char* K0) {
    return texts(with({"material.0.cohesion=0", std::string("initial_stress.K0=") + K0}).warnings);
  };
  EXPECT_THAT(warned("0.491"), IsEmpty());
  EXPECT_THAT(warned("2.039"), IsEmpty());
  EXPECT_THAT(warned("0.489"), ElementsAre(HasSubstr("it bears 0.4903 .. 2.04 there")));
  EXPECT_THAT(warned("2.041"), ElementsAre(HasSubstr("initial_stress.K0: 2.041 is more than")));
}

TEST(InitialStress, SaysLikewiseOfTheStressOutOfThePlane) {
  const std::vector<std::string> beyond{"material.0.cohesion=0", "initial_stress.K0=0.5",
                                        "initial_stress.K0_z=2.041"};
  EXPECT_THAT(texts(with(beyond).warnings),
              ElementsAre(HasSubstr("initial_stress.K0_z: 2.041 is more than")));
}

// Elastic parts are welcome to the control of the ground around them; a body of them alone is not.
TEST(Hourglass, MixedNeedsSomethingThatYields) {
  const std::string block =
      "[[material]]\nname = \"block\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
      "poissons_ratio = 0.2\ndensity = 1.0\nregion_min = [0.5, -0.5]\nregion_max = [1.0, 0.0]\n";
  EXPECT_THAT(errors({"hourglass.control=mixed"}, block), IsEmpty());
  EXPECT_THAT(
      errors({"hourglass.control=mixed", "material.0.model=elastic"}, block),
      ElementsAre(StartsWith("--set hourglass.control=mixed: hourglass.control: found mixed "
                             "with elastic materials only; a body that does not yield")));
}

// sqrt(J2) = c is reached at 2 c in plane strain and at sqrt(3) c in triaxial compression.
TEST(VonMises, SaysInSpaceThatItsCompressionIsWeaker) {
  const std::vector<std::string> in_space{"geometry.dimension=3",
                                          "geometry.min=[0.0, -1.0, 0.0]",
                                          "geometry.max=[2.0, 0.0, 1.0]",
                                          "gravity.acceleration=[0.0, -9.81, 0.0]",
                                          "drive.direction=[0.0, -1.0, 0.0]",
                                          "drive.range_min=[0.0, 0.0]",
                                          "drive.range_max=[0.5, 1.0]",
                                          "support.0.directions=[\"x\", \"y\", \"z\"]",
                                          "material.0.friction_angle=0",
                                          "material.0.dilation_angle=0"};
  const auto warnings = [](std::vector<std::string> settings, const std::string& model) {
    settings.push_back("material.0.model=" + model);
    return texts(with(settings).warnings);
  };
  EXPECT_THAT(warnings(in_space, "von_mises"),
              Contains(HasSubstr("material.0.model: found von_mises in 3D; it is the cylinder "
                                 "sqrt(J2) = cohesion: compression carries 1.73 cohesion")));
  EXPECT_THAT(warnings(in_space, "mohr_coulomb"), Not(Contains(HasSubstr("1.73"))));
  EXPECT_THAT(warnings({"material.0.friction_angle=0", "material.0.dilation_angle=0"}, "von_mises"),
              Not(Contains(HasSubstr("1.73"))));
}

std::string measure(const std::string& name, const std::string& what) {
  return "[[measure]]\nname = \"" + name + "\"\nkind = " + what + "\n";
}

TEST(Measure, HasANameThatMakesAColumn) {
  EXPECT_THAT(errors({}, measure("a b", "\"max_displacement\"")),
              ElementsAre(HasSubstr("measure.0.name: found \"a b\"; allowed are letters, digits "
                                    "and _")));
  EXPECT_THAT(errors({}, measure("", "\"max_displacement\"")),
              ElementsAre(HasSubstr("measure.0.name: found \"\"; allowed are letters")));
  EXPECT_THAT(
      errors({}, measure("a", "\"max_displacement\"") + measure("a", "\"max_displacement\"")),
      ElementsAre(HasSubstr("measure.1.name: found \"a\" again; it is the name of "
                            "measure.0")));
}

TEST(Measure, HasTheOneKeyThatItsKindNeeds) {
  for (const std::string kind : {"displacement", "stress", "plastic_strain"}) {
    const std::string what = "\"" + kind + "\"";
    EXPECT_THAT(
        errors({}, measure("a", what)),
        ElementsAre(HasSubstr("measure.0.at: absent; a measure of kind " + kind + " needs it")));
    EXPECT_THAT(errors({}, measure("a", what + "\nat = [2.0, -1.0]")), IsEmpty());
    EXPECT_THAT(errors({}, measure("a", what + "\nat = [1.0, -0.5]\nside = \"top\"")),
                ElementsAre(HasSubstr("measure.0.side: found; a measure of kind " + kind +
                                      " does not have it")));
  }
  EXPECT_THAT(
      errors({}, measure("a", "\"reaction\"")),
      ElementsAre(HasSubstr("measure.0.support: absent; a measure of kind reaction needs")));
  EXPECT_THAT(errors({}, measure("a", "\"resultant\"")),
              ElementsAre(HasSubstr("measure.0.side: absent; a measure of kind resultant needs")));
  EXPECT_THAT(
      errors({}, measure("a", "\"max_displacement\"\nsupport = \"base\"")),
      ElementsAre(HasSubstr("measure.0.support: found; a measure of kind max_displacement")));
}

TEST(Measure, IsOfWhatTheSceneHas) {
  EXPECT_THAT(errors({}, measure("a", "\"reaction\"\nsupport = \"bse\"")),
              ElementsAre(HasSubstr("measure.0.support: found \"bse\"; the supports are base")));
  EXPECT_THAT(errors({}, measure("a", "\"displacement\"\nat = [2.1, -0.5]")),
              ElementsAre(HasSubstr("measure.0.at: found 2.1 along x; the body is from 0 to 2")));
  EXPECT_THAT(errors({}, measure("a", "\"displacement\"\nat = [2.0]")),
              ElementsAre(HasSubstr("measure.0.at: found length 1")));
  EXPECT_THAT(errors({}, measure("a", "\"resultant\"\nside = \"front\"")),
              ElementsAre(HasSubstr("measure.0.side: found front in 2D")));
  EXPECT_THAT(
      errors({"material.0.model=elastic"}, measure("a", "\"plastic_strain\"\nat = [1.0, -0.5]")),
      ElementsAre(HasSubstr("measure.0.kind: found plastic_strain; every material is "
                            "elastic")));
}

TEST(Tolerance, IsTightEnoughForTheFriction) {
  EXPECT_THAT(errors({"solver.tolerance=0.5"}), ElementsAre(HasSubstr("0 < value <= 0.01")));
  // tan^2(45 + 75/2) = 57.7
  EXPECT_THAT(errors({"material.0.friction_angle=75"}),
              ElementsAre(HasSubstr("allowed is solver.tolerance <= 0.00017")));
  EXPECT_THAT(errors({"material.0.friction_angle=75", "solver.tolerance=1e-4"}), IsEmpty());
  EXPECT_THAT(errors({"material.0.friction_angle=59"}), IsEmpty());
}

TEST(Keys, OfEndlessDepthAreRefused) {
  std::string key = "a";
  for (int i = 0; i < 50000; ++i) key += ".a";
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n", "b = {" + key + " = 1}\n"}) {
    EXPECT_THAT(texts(parse_scene("\n" + text, "s.toml").errors),
                ElementsAre("s.toml:2: a key of too many parts; the deepest key has four, as in "
                            "stage.0.drive.kind"));
  }
  EXPECT_EQ(errors({"title={" + key + " = 1}"}).size(), 1U);
  EXPECT_THAT(errors({"title=\"" + std::string(100, '.') + "\""}), IsEmpty());
}

}  // namespace
}  // namespace scene

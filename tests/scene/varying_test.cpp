// Numbers of materials that change from place to place, and the files they are read from.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>

#include "constitutive/parameters.hpp"
#include "scene/derived.hpp"
#include "scene/geostatic.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "support/sample_scene.hpp"
#include "support/temporary_folder.hpp"

namespace scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// The sample's body is 2 m wide and 1 m deep, its top at y = 0.
std::string with(const std::string& key, const std::string& value) {
  const std::string sample(support::sample_scene);
  const auto at = sample.find(key + " = ");
  const auto end = sample.find('\n', at);
  return std::string(sample).replace(at, end - at, key + " = " + value);
}

std::string complaint(const std::string& text, const std::string& source = "s.toml") {
  const auto reading = parse_scene(text, source);
  return reading.errors.empty() ? "" : reading.errors.front().text();
}

double at(const tables::VaryingNumber& number, double x, double y) {
  return number.at_place(std::array{x, y});
}

TEST(Samples, OfEveryKindAreReadBesideTheSceneAndThenPartOfIt) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "c.csv") << "depth,c_kPa\n0,2\n0.5,3\n1,7\n";
  std::ofstream(folder / "phi.asc") << "ncols 2\nnrows 2\nxllcorner -1\nyllcorner -2\ncellsize 2\n"
                                       "20 30\n20 30\n";
  std::ofstream(folder / "gamma.csv") << "0,0,18e3\n2,0,20e3\n";
  std::ofstream(folder / "E.asc") << "ncols 2\nnrows 1\nxllcorner 0\nyllcorner -1\ncellsize 1\n"
                                     "2e6 9e6\n";
  std::string text = with("cohesion", "{ below = 0.0, table = \"c.csv\", factor = 1e3 }");
  text.replace(text.find("friction_angle = 20.0"), 21, "friction_angle = { raster = \"phi.asc\" }");
  text.replace(text.find("dilation_angle = 10.0"), 21, "dilation_angle = 0.0");
  text.replace(text.find("density = 1850.0"), 16, "unit_weight = { points = \"gamma.csv\" }");
  const auto modulus = text.find("youngs_modulus");
  text.replace(modulus, text.find('\n', modulus) - modulus,
               "youngs_modulus = { raster = \"E.asc\", nearest = true }");
  const auto reading = parse_scene(text, (folder / "s.toml").string());
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  const Material& soil = reading.scene->material[0];
  EXPECT_DOUBLE_EQ(at(*soil.cohesion, 0.3, -0.25), 2.5e3);
  EXPECT_DOUBLE_EQ(at(*soil.cohesion, 0.3, -0.75), 5e3);
  EXPECT_DOUBLE_EQ(at(*soil.friction_angle, 0.5, -0.5), 22.5);
  EXPECT_DOUBLE_EQ(at(soil.youngs_modulus, 0.9, -0.5), 2e6);
  EXPECT_DOUBLE_EQ(at(soil.youngs_modulus, 1.1, -0.5), 9e6);
  EXPECT_DOUBLE_EQ(at(*soil.unit_weight, 0.9, -1.0), 18e3);
  EXPECT_DOUBLE_EQ(at(soil.density, 1.1, -1.0), 20e3 / 9.81);
  const auto there = parameters_at(soil, std::array{0.5, -0.25});
  EXPECT_DOUBLE_EQ(there.cohesion, 2.5e3);
  EXPECT_DOUBLE_EQ(there.friction_angle, 22.5);
  // What is printed wants no file and is the same scene.
  const std::string printed = effective_toml(*reading.scene);
  EXPECT_EQ(printed.find(".csv"), std::string::npos);
  EXPECT_EQ(printed.find(".asc"), std::string::npos);
  const auto again = parse_scene(printed, "elsewhere.toml");
  ASSERT_TRUE(again.scene) << again.errors.front().text();
  EXPECT_TRUE(*again.scene == *reading.scene);
  EXPECT_EQ(effective_toml(*again.scene), printed);
}

TEST(Samples, InAFileThatIsWrongAreToldByFileLineAndKey) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "c.csv") << "0,2e3\n1,-5\n";
  std::string wrong = with("cohesion", "{ below = 0.0, table = \"c.csv\" }");
  EXPECT_THAT(complaint(wrong, (folder / "s.toml").string()),
              AllOf(HasSubstr("s.toml:12:12: material.0.cohesion: "), HasSubstr("c.csv:2: "),
                    HasSubstr("found \"-5\" in column 2; allowed is a number >= 0")));
  EXPECT_THAT(complaint(with("cohesion", "{ points = \"none.csv\" }")),
              AllOf(HasSubstr("material.0.cohesion: none.csv: "),
                    HasSubstr("allowed is a file of values, its path from the scene's folder")));
}

struct Wrong {
  const char* key;
  const char* value;
  const char* message;
  friend void PrintTo(const Wrong& wrong, std::ostream* out) { *out << wrong.value; }
};

class WrongNumbers : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongNumbers, AreRefusedWithTheirMessage) {
  EXPECT_THAT(complaint(with(GetParam().key, GetParam().value)), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Scene, WrongNumbers,
    ::testing::Values(
        Wrong{"cohesion", "{ along = \"y\", table = [[-1, 1e3], [-0.5, 2e3]] }",
              "material.0.cohesion: found values from y = -1 to -0.5, and the material reaches (2, "
              "0); allowed are values for all of where the material is"},
        Wrong{"cohesion", "{ along = \"z\", table = [[-1, 1e3], [0, 2e3]] }",
              "material.0.cohesion: found along = the text \"z\"; allowed is { along = \"x\" or "},
        Wrong{"cohesion", "{ table = [[-1, 1e3], [0, 2e3]] }", "found neither along nor below"},
        Wrong{"cohesion", "{ along = \"y\", table = [[0, 1e3], [-1, 2e3]] }",
              "found 0 followed by -1"},
        Wrong{"cohesion", "{ along = \"y\", table = [[-1, 1e3], [0, -2]] }",
              "found -2 at y = 0; allowed is a number >= 0 [Pa]"},
        Wrong{"cohesion", "{ raster = [[1e3]], step = [1, 1] }", "without lower or step"},
        Wrong{"cohesion", "{ raster = [[1, 2], [3]], lower = [0, -1], step = [2, 1] }",
              "found 2 values in row 1, and 1 in others"},
        Wrong{"cohesion", "{ raster = [[1e3, 2e3]], lower = [0.5, -0.5], step = [1, 0] }",
              "a step of more than zero"},
        Wrong{"cohesion", "{ raster = [[1e3, 2e3]], lower = [0.5, -0.5], step = [0.5, 1] }",
              "found values from x = 0.25 to 1.25, and the material reaches ("},
        Wrong{"cohesion",
              "{ raster = [[1e3, 2e3]], lower = [0.5, -0.5], step = [1, 1], nearest = 1 }",
              "found nearest = "},
        Wrong{"cohesion", "{ points = [[0, 0, 1]], nearest = true }", "no such key in it: nearest"},
        Wrong{"cohesion",
              "{ raster = [[1e3, 2e3]], lower = [0.5, -0.5], step = [0.5, 1], nearest = true }",
              "found values from x = 0.25 to 1.25, and the material reaches ("},
        Wrong{"cohesion", "{ points = [[0, 0, 1e3], [0, 0, 2e3]] }", "found two points at (0, 0)"},
        Wrong{"cohesion", "{ points = [[0, 0]] }", "material.0.cohesion: found [0, 0]"},
        Wrong{"cohesion", "{ points = [[0, 0, 1]], lower = [0, 0] }", "no such key in it: lower"},
        Wrong{"friction_angle", "{ at = [0, 0], value = 20, gradient = [40, 0] }",
              "material.0.friction_angle: 100 at (2, -1); allowed is an angle from zero to below "
              "90 wherever the material is"},
        Wrong{"friction_angle", "{ at = [0, 0], value = 20, gradient = [0, 15] }",
              "material.0.dilation_angle: has 5, and dilates by 10; a material dilates by its "
              "friction angle at most"},
        Wrong{"friction_angle", "{ points = [[0, 0, 95]] }", "found 95 at (0, 0)"},
        Wrong{"friction_angle", "{ points = [[0, 0, 8], [1, 0, 30]] }",
              "material.0.dilation_angle: has 8, and dilates by 10"},
        Wrong{"density", "0.0\nunit_weight = { at = [0, 0], value = 10e3, gradient = [0, 10e3] }",
              "material.0.unit_weight: 0 at (0, -1); allowed is more than zero wherever the "
              "material is"},
        Wrong{"density", "1800\nunit_weight = { at = [0, 0], value = 17658, gradient = [0, 1] }",
              "material.0.unit_weight: found 17658, and a density of 1800"}));

// Slices of a spacing each are exact for a density that is linear.
TEST(GeostaticStress, OfADensityThatGrowsWithDepthIsQuadratic) {
  const std::string text =
      with("density", "0.0\nunit_weight = { at = [0, 0], value = 15e3, gradient = [0, -4e3] }");
  const auto reading = parse_scene(text, "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  for (const double depth : {0.0, 0.05, 0.33, 1.0}) {
    EXPECT_NEAR(geostatic_stress(*reading.scene, std::array{0.7, -depth}),
                -(15e3 * depth + 0.5 * 4e3 * depth * depth), 1e-8);
  }
}

}  // namespace
}  // namespace scene

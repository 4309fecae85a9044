#include "material/path.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "material/report.hpp"

namespace material {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string sand = R"(
[material]
model = "mohr_coulomb"
youngs_modulus = 40e6
poissons_ratio = 0.25
friction_angle = 40.0
dilation_angle = 10.0
)";
const std::string shear = R"(
[[stage]]
test = "triaxial_compression"
amount = 0.03
)";

std::string complaint_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  const PathReading reading = read_path(text, "path.toml", settings);
  EXPECT_FALSE(reading.path.has_value()) << text;
  return reading.errors.empty() ? "" : reading.errors.front().text();
}

TEST(APathFile, IsReadWithSettingsApplied) {
  const PathReading reading =
      read_path(sand + shear, "path.toml", std::vector<std::string>{"stage.0.steps=7"});
  ASSERT_TRUE(reading.path.has_value()) << reading.errors.front().text();
  EXPECT_EQ(reading.path->stage[0].steps, 7);
  EXPECT_EQ(parameters_of(*reading.path).model, "mohr_coulomb");
  EXPECT_EQ(parameters_of(*reading.path).friction_angle, 40.0);
}

TEST(APathFile, IsRefusedWithTheKeyAndWhatIsAllowed) {
  EXPECT_THAT(complaint_of(sand), HasSubstr("stage"));
  EXPECT_THAT(complaint_of(sand + "[[stage]]\ntest = \"oedometr\"\namount = 1\n"),
              HasSubstr("did you mean \"oedometer\""));
  EXPECT_THAT(complaint_of(sand + "[[stage]]\ntest = \"oedometer\"\n"),
              HasSubstr("stage.0.amount: absent; the test needs it"));
  EXPECT_THAT(complaint_of(sand + "[[stage]]\ntest = \"mixed\"\namount = 1.0\n"),
              HasSubstr("a test of mixed does not have it"));
  EXPECT_THAT(complaint_of(sand + "[[stage]]\ntest = \"mixed\"\ncontrol = [\"strain\"]\n"),
              HasSubstr("stage.0.control: found 1; mixed needs 6 values"));
  EXPECT_THAT(complaint_of("initial_stress = [1.0, 2.0]\n" + sand + shear),
              HasSubstr("initial_stress: found 2 values"));
  EXPECT_THAT(complaint_of(sand + shear, {"material.dilation_angle=50"}),
              HasSubstr("material.dilation_angle"));
  EXPECT_THAT(complaint_of(sand + shear, {"material.model=elastic"}),
              HasSubstr("it has no effect on the model elastic"));
}

TEST(APathFile, StrainsAConeOfPlaneStrainInThePlaneOnly) {
  const std::vector<std::string> cone{"material.model=drucker_prager"};
  EXPECT_THAT(complaint_of(sand + shear, cone), HasSubstr("stage 0 strains zz"));
  const std::string plane = "[[stage]]\ntest = \"plane_strain\"\namount = 0.03\n";
  EXPECT_TRUE(read_path(sand + plane, "path.toml", cone).path.has_value());
}

TEST(APathFile, AsksOfAClayWhatItsStatesNeed) {
  const std::string clay = R"(
initial_stress = [-1e5, -1e5, -1e5]
[material]
model = "modified_cam_clay"
youngs_modulus = 8e6
poissons_ratio = 0.3
compression_index = 0.1
swelling_index = 0.02
critical_stress_ratio = 1.0
preconsolidation_pressure = 1e5
)";
  EXPECT_TRUE(read_path(clay + shear, "path.toml").path.has_value());
  EXPECT_THAT(complaint_of(clay + shear, {"initial_stress=[0, 0, 1]"}),
              HasSubstr("begins with a mean stress below zero"));
  EXPECT_THAT(complaint_of(clay + shear, {"material.swelling_index=0.1"}),
              HasSubstr("it must be below the compression index, 0.1"));
  EXPECT_THAT(complaint_of(clay + shear, {"material.cohesion=1e3"}),
              HasSubstr("it has no effect on the model modified_cam_clay"));
  std::string without = clay;
  const std::string line = "compression_index = 0.1\n";
  without.erase(without.find(line), line.size());
  EXPECT_THAT(complaint_of(without + shear),
              HasSubstr("material.compression_index: is missing; the model modified_cam_clay needs "
                        "it"));
}

TEST(ATest, PrescribesWhatItsNameSays) {
  Stage stage;
  stage.test = TestKind::plane_strain;
  stage.amount = 0.01;
  const Prescription given = prescription_of(stage);
  EXPECT_THAT(given.control, ElementsAre(Control::stress, Control::strain, Control::strain,
                                         Control::strain, Control::strain, Control::strain));
  EXPECT_THAT(given.change, ElementsAre(0.0, -0.01, 0.0, 0.0, 0.0, 0.0));
}

// The figures that the files' own comments announce.
TEST(SharedPaths, EndWhereTheySay) {
  const auto end_of = [](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(std::string(FPM_SHARE_DIR) + "/paths/" + name).rdbuf();
    const PathReading reading = read_path(text.str(), name);
    EXPECT_TRUE(reading.path.has_value());
    return follow(constitutive::make_material(parameters_of(*reading.path)), *reading.path)
        .points.back();
  };
  const Stress triaxial = end_of("triaxial.toml").state.stress;
  EXPECT_NEAR(triaxial[1] / triaxial[0], 4.599, 5e-4);
  EXPECT_NEAR(end_of("simple_shear.toml").state.stress[3], 25e3, 1.0);
  const Stress clay = end_of("cam_clay.toml").state.stress;
  EXPECT_NEAR(-constitutive::mean_stress(clay), 114.87e3, 5.0);
  EXPECT_NEAR(clay[0] - clay[1], 114.87e3, 5.0);
}

TEST(TheReport, HasALineAPointAndACurveAStage) {
  const PathReading reading =
      read_path(sand + "[[stage]]\ntest=\"isotropic\"\namount=1e5\nsteps=3\n" + shear, "p.toml",
                std::vector<std::string>{"stage.1.steps=4"});
  ASSERT_TRUE(reading.path.has_value());
  const Course course =
      follow(constitutive::make_material(parameters_of(*reading.path)), *reading.path);
  const std::string csv = csv_text(course);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 4 + 5);
  const auto columns =
      std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ',');
  EXPECT_EQ(std::ranges::count(csv, ','), columns * (1 + 4 + 5));
  const std::string picture = shear_picture(*reading.path, course);
  EXPECT_THAT(picture, HasSubstr("triaxial_compression"));
  EXPECT_THAT(summary(*reading.path, course), HasSubstr("deviatoric 359891 Pa"));
}

// share/doc/path.md is what the program prints.
TEST(TheReference, IsTheOneInTheDocuments) {
  std::ostringstream text;
  text << std::ifstream(std::string(FPM_SHARE_DIR) + "/doc/path.md").rdbuf();
  EXPECT_EQ(text.str(), path_reference());
}

}  // namespace
}  // namespace material

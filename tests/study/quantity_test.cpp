#include "study/quantity.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "files/file_error.hpp"
#include "program/command_line.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "study/reference.hpp"
#include "support/sample_scene.hpp"
#include "support/temporary_folder.hpp"

namespace study {
namespace {

using program::UsageError;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Columns curve{{"step", "settlement_over_B", "mean_pressure_Pa", "corrected_pressure_Pa"},
                    {{0, 1, 2, 3}, {0, 0.02, 0.04, 0.06}, {0, 300, 500, 400}, {0, 1, 2, 3}}};

double value_of(const std::string& text) {
  return value_in(curve, parse_quantity(text)).value.value();
}

TEST(AQuantity, IsTheLastTheLargestOrTheInterpolatedValueOfAColumn) {
  EXPECT_EQ(value_of("mean_pressure_Pa"), 400.0);
  EXPECT_EQ(value_of("max(mean_pressure_Pa)"), 500.0);
  EXPECT_DOUBLE_EQ(value_of("mean_pressure_Pa@settlement_over_B=0.03"), 400.0);
  EXPECT_EQ(value_of("mean_pressure_Pa@settlement_over_B=0.04"), 500.0) << "at a row";
  EXPECT_EQ(value_of("mean_pressure_Pa@settlement_over_B=0"), 0.0);
}

TEST(AQuantity, MayBeNamedAsPeopleDo) {
  EXPECT_DOUBLE_EQ(value_of("pressure@d/B=0.01"), 150.0);
  EXPECT_EQ(value_of("corrected_pressure"), 3.0);
  EXPECT_EQ(column_meant({"a_m", "b"}, "c"), "");
  EXPECT_EQ(column_meant({"settlement_over_B", "pressure_kPa"}, "mean_pressure_Pa"),
            "pressure_kPa");
}

TEST(AQuantity, ThatIsNotReachedOrNotThereSaysSo) {
  const Reading beyond = value_in(curve, parse_quantity("pressure@d/B=0.07"));
  EXPECT_FALSE(beyond.value.has_value());
  EXPECT_THAT(beyond.obstacle, HasSubstr("d/B does not come to 0.07"));
  const Reading absent = value_in(curve, parse_quantity("mean_presure_Pa"));
  EXPECT_FALSE(absent.value.has_value());
  EXPECT_THAT(absent.obstacle, HasSubstr("did you mean \"mean_pressure_Pa\""));
}

TEST(AQuantity, OfNoFormIsRefusedWithTheForms) {
  for (const char* text : {"", "@x=1", "pressure@=1", "pressure@d/B=x", "displacement@0,0",
                           "stress_xz1@0,0", "displacement_x@0,a", "displacement_x@"}) {
    EXPECT_THROW((void)parse_quantity(text), UsageError) << text;
  }
}

TEST(AFieldAtAPoint, IsMeasuredByTheRunItself) {
  const Quantity quantity = parse_quantity("stress_xy@0.5,-0.25");
  EXPECT_EQ(quantity.column, "fpm_study_sxy_Pa");
  const scene::SceneReading reading = scene::parse_scene(support::sample_scene, "sample");
  const scene::Scene measuring = with_measure(*reading.scene, quantity);
  ASSERT_EQ(measuring.measure.size(), 1U);
  EXPECT_EQ(measuring.measure[0].kind, scene::MeasureKind::stress);
  EXPECT_THAT(measuring.measure[0].at, ElementsAre(0.5, -0.25));
  const scene::SceneReading again = scene::parse_scene(scene::effective_toml(measuring), "again");
  EXPECT_TRUE(again.errors.empty()) << again.errors[0].text();
}

// A run without measures whose load is given shows reactions; asking for a field must not hide
// them.
TEST(AFieldAtAPoint, IsOfTheBody) {
  scene::Scene scene;
  scene.geometry.dimension = 2;
  scene.geometry.min = {0.0, -3.0};
  scene.geometry.max = {6.0, 0.0};
  scene.geometry.spacing = 0.5;
  const auto refusal = [&](const char* text) {
    try {
      check_quantity(scene, parse_quantity(text));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("displacement_y@6,0"), "");
  EXPECT_EQ(refusal("pressure"), "");
  EXPECT_THAT(refusal("displacement_y@6,0.1"),
              HasSubstr("displacement_y@6,0.1: found 0.1 along y; the body is from -3 to 0"));
  EXPECT_THAT(refusal("stress_xx@6"), HasSubstr("found 1 coordinates; needed are 2"));
  EXPECT_THAT(refusal("displacement_z@1,-1"), HasSubstr("no such component"));
}

TEST(AFieldAtAPoint, HidesNothingThatTheCurveShowsOfItself) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes/beam.toml";
  const scene::SceneReading reading = scene::read_scene(file);
  const auto before = with_measure(*reading.scene, parse_quantity("step")).measure.size();
  const auto after = with_measure(*reading.scene, parse_quantity("displacement_y@5,0.5")).measure;
  EXPECT_EQ(before, 0U);
  EXPECT_GT(after.size(), 1U);
}

class AFile : public ::testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path with(const std::string& text) const {
    std::ofstream(folder_ / "table.csv") << text;
    return folder_ / "table.csv";
  }
  support::TemporaryFolder folder_;
};

TEST_F(AFile, GivesAReferenceInItsOwnUnits) {
  const auto file = with("# a comment\nsettlement_over_B,pressure_kPa\n0,0\n0.1,50\n0.2,60\n");
  const ReferenceWish wish = parse_reference(file.string(), parse_quantity("pressure@d/B=0.15"));
  EXPECT_EQ(wish.kind, ReferenceWish::Kind::file);
  EXPECT_DOUBLE_EQ(wish.reference.value, 55e3);
}

TEST_F(AFile, ThatIsNoTableIsAnErrorThatNamesTheLine) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"a,b\n1,2\n3\n", "line 3: 1 values under 2 names"},
           {"a,b\n1,x\n", "line 2: \"x\" is no number"},
           {"a,b\n", "has no line of numbers"},
           {"", "has no line of numbers"}}) {
    try {
      (void)read_columns(with(text));
      ADD_FAILURE() << text;
    } catch (const files::FileError& failure) {
      EXPECT_THAT(failure.what(), HasSubstr(message));
    }
  }
}

TEST(AReference, IsANumberARuleOrAFile) {
  const Quantity pressure = parse_quantity("pressure");
  using Kind = ReferenceWish::Kind;
  EXPECT_EQ(parse_reference("richardson", pressure).kind, Kind::richardson);
  EXPECT_EQ(parse_reference("richardson:solver.tolerance", pressure).key, "solver.tolerance");
  EXPECT_EQ(parse_reference("limit", pressure).kind, Kind::limit);
  EXPECT_EQ(parse_reference("-5.14e3", pressure).reference.value, -5140.0);
  for (const char* text : {"", "nan", "1e400", "richardsen", "no/such/file.csv"}) {
    EXPECT_THROW((void)parse_reference(text, pressure), UsageError) << text;
  }
}

}  // namespace
}  // namespace study

#include "bounds/plateau_check.hpp"

#include <gmock/gmock.h>

#include "scene/scene.hpp"

namespace {

using namespace bounds;
using ::testing::HasSubstr;

std::vector<record::CurveRow> curve(const std::vector<std::pair<double, double>>& points) {
  std::vector<record::CurveRow> rows;
  for (const auto& [settlement, pressure] : points) {
    record::CurveRow row;
    row.settlement = settlement;
    row.mean_pressure = pressure;
    rows.push_back(row);
  }
  return rows;
}

scene::Scene scene() {
  scene::Scene scene;
  scene.drive.width = 1.0;
  return scene;
}

TEST(PlateauCheck, WeighsTheLastFifthBySettlement) {
  // From 0.8 to 0.9 at 10, from 0.9 to 1 at 20.
  const PlateauCheck check =
      check_plateau(curve({{0, 0}, {0.5, 5}, {0.9, 10}, {1.0, 20}}), scene(), 14.0, 16.0);
  EXPECT_NEAR(check.plateau, 15.0, 1e-12);
  EXPECT_EQ(check.place, PlateauCheck::Place::inside);
  EXPECT_EQ(check.distance, 0.0);
  EXPECT_EQ(check.passed_lower, 1.0);
  EXPECT_EQ(check.passed_upper, 1.0);
}

TEST(PlateauCheck, SaysHowFarOutsideAndWhy) {
  const auto rows = curve({{0, 0}, {0.5, 10}, {1.0, 10}});
  const PlateauCheck above = check_plateau(rows, scene(), 7.0, 8.0);
  EXPECT_EQ(above.place, PlateauCheck::Place::above);
  EXPECT_NEAR(above.distance, 0.25, 1e-12);
  EXPECT_THAT(text_of(above), HasSubstr("25.0 % above the upper bound"));
  EXPECT_THAT(text_of(above), HasSubstr("finite strain"));
  const PlateauCheck below = check_plateau(rows, scene(), 12.5, 13.0);
  EXPECT_EQ(below.place, PlateauCheck::Place::below);
  EXPECT_NEAR(below.distance, 0.2, 1e-12);
  EXPECT_FALSE(below.passed_lower);
  EXPECT_THAT(text_of(below), HasSubstr("passed nowhere"));
}

TEST(PlateauCheck, RefusesCurvesWithoutPressureOrSettlement) {
  scene::Scene without = scene();
  without.drive.width.reset();
  EXPECT_THROW((void)check_plateau(curve({{0, 0}, {1, 1}}), without, 1, 2), std::invalid_argument);
  EXPECT_THROW((void)check_plateau({}, scene(), 1, 2), std::invalid_argument);
}

}  // namespace

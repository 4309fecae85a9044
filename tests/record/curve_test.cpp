#include "record/curve.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace record {
namespace {

CurveRow row(std::int64_t step) {
  CurveRow row;
  row.step = step;
  row.load_parameter = static_cast<double>(step) / 3.0;
  row.mean_pressure = 58437.0 / 7.0 * static_cast<double>(step);
  row.jacobian_actions = 10 * step;
  row.wall = 0.1;
  return row;
}

TEST(Curve, NamesItsColumnsWithTheirUnits) {
  EXPECT_EQ(curve_header(2),
            "step,load_parameter,settlement_m,settlement_over_B,reaction_N_per_m,mean_pressure_Pa,"
            "corrected_pressure_Pa,increment_m,newton_iterations,residual_evaluations,"
            "jacobian_actions,evaluations,cuts,plastic_particles,researched_rows,residual_ratio,"
            "max_plastic_strain,hourglass_work_ratio,wall_s");
  EXPECT_THAT(curve_header(3), ::testing::HasSubstr(",reaction_N,"));
}

TEST(Curve, ReadsEveryColumnBackToTheSameValue) {
  CurveRow full;
  double value = 1.0 / 3.0;
  std::int64_t count = 1;
  CurveRow::for_each_column(full, [&](std::string_view, auto& column, auto&&...) {
    if constexpr (std::is_same_v<decltype(column), std::int64_t&>) {
      column = count++;
    } else {
      column = value /= -7.0;
    }
  });
  EXPECT_EQ(parse_curve_line(curve_line(full)), full);
}

TEST(Curve, HasItsMeasuresBeforeTheWallTimeAndReadsThemBack) {
  const CurveColumns columns(3, {"top_uy_m", "base_Ry_N"});
  const std::string header = curve_header(columns);
  EXPECT_THAT(header, ::testing::EndsWith(",hourglass_work_ratio,top_uy_m,base_Ry_N,wall_s"));
  EXPECT_EQ(parse_curve_header(header), columns);
  CurveRow measured = row(3);
  measured.measures = {-1.0 / 3.0, 1e300};
  const std::string line = curve_line(measured);
  EXPECT_THAT(line, ::testing::EndsWith(",-0.3333333333333333,1e+300,0.1"));
  EXPECT_EQ(parse_curve_line(line, 2), measured);
  EXPECT_THROW((void)parse_curve_line(line, 1), std::invalid_argument);
  EXPECT_THROW((void)parse_curve_line(line), std::invalid_argument);
}

TEST(Curve, IsKnownByItsHeader) {
  EXPECT_EQ(parse_curve_header(curve_header(2)), CurveColumns(2));
  EXPECT_EQ(parse_curve_header(curve_header(3)), CurveColumns(3));
  const std::string header = curve_header(2);
  for (const std::string& foreign :
       {std::string(), std::string("step"), header + ",more", header.substr(5), "x" + header}) {
    EXPECT_EQ(parse_curve_header(foreign), std::nullopt) << foreign;
  }
}

TEST(Curve, KeepsMeasuresOfTheSameNameAndDoesNotInventThoseOfAnother) {
  std::vector<CurveRow> rows{row(1)};
  rows.front().measures = {1.0, 2.0};
  change_measures(rows, {"a", "b"}, {"c", "b"});
  ASSERT_EQ(rows.front().measures.size(), 2U);
  EXPECT_TRUE(std::isnan(rows.front().measures[0]));
  EXPECT_EQ(rows.front().measures[1], 2.0);
}

TEST(Curve, RefusesBrokenLines) {
  const std::string line = curve_line(row(1));
  EXPECT_THROW((void)parse_curve_line(line + ",1"), std::invalid_argument);
  EXPECT_THROW((void)parse_curve_line(line.substr(0, line.rfind(','))), std::invalid_argument);
  EXPECT_THROW((void)parse_curve_line("x" + line), std::invalid_argument);
  EXPECT_THROW((void)parse_curve_line(""), std::invalid_argument);
}

}  // namespace
}  // namespace record

// What a scene measures besides its drive is part of the curve, through a resume, too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "record/curve_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::ElementsAre;

// Its weight is all that the base can carry.
TEST(Measure, OfALoadDriveShowsWhatItCarriesWithoutBeingAsked) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, block, {"--set", "solver.tolerance=1e-9"}).code,
            program::ExitCode::done);
  EXPECT_THAT(record::read_curve_columns(run / "curve.csv").measures,
              ElementsAre("body_max_displacement_m", "base_Rx_N", "base_Ry_N", "base_Rz_N"));
  const double weight = 2000.0 * 9.81 * 1.5;
  const auto rows = record::read_curve(run / "curve.csv");
  EXPECT_THAT(rows.front().measures, ElementsAre(0.0, 0.0, 0.0, 0.0));
  for (const record::CurveRow& row : rows) {
    // What is left of the residual, summed over some hundred unknowns.
    EXPECT_NEAR(row.measures[2], row.load_parameter * weight, 1e-7 * weight);
  }
  // Uniaxial strain lies between: rho g h^2 / (2 M) and / (2 E), M = E (1 - nu) / ((1 + nu) (1 - 2
  // nu)).
  const double free = 2000.0 * 9.81 * 1.5 * 1.5 / (2.0 * 1e6);
  EXPECT_GT(rows.back().measures[0], free / 1.35);
  EXPECT_LT(rows.back().measures[0], free * 1.1);
}

TEST(Measure, AddedOnResumeIsUnknownBeforeAndTheOthersStay) {
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", run = folder / "run";
  const std::string first = block +
                            "[[measure]]\nname = \"top\"\nkind = \"displacement\"\n"
                            "at = [0.5, 1.5, 0.5]\n";
  const std::string second = block +
                             "[[measure]]\nname = \"base\"\nkind = \"resultant\"\n"
                             "side = \"bottom\"\n" +
                             first.substr(block.size());
  ASSERT_EQ(fpm_run_in(whole, first).code, program::ExitCode::done);
  const Outcome outcome = fpm_run_in(run, second, {"--resume=" + checkpoint_of(whole, 3).string()});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  EXPECT_THAT(
      record::read_curve_columns(run / "curve.csv").measures,
      ElementsAre("base_Fx_N", "base_Fy_N", "base_Fz_N", "top_ux_m", "top_uy_m", "top_uz_m"));
  const auto before = record::read_curve(whole / "curve.csv");
  const auto after = record::read_curve(run / "curve.csv");
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t k = 0; k < after.size(); ++k) {
    EXPECT_EQ(std::isnan(after[k].measures[1]), k <= 3) << k;
    EXPECT_EQ(after[k].measures[4], before[k].measures[1]) << k;
  }
  EXPECT_LT(after.back().measures[4], 0.0);
}

}  // namespace
}  // namespace restart

#include "study/results.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "program/command_line.hpp"
#include "study/report.hpp"
#include "support/temporary_folder.hpp"

namespace study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Result result(double value, double cpu) {
  Result one;
  one.value = value;
  one.cost.cpu = cpu;
  one.exit_code = 0;
  return one;
}

std::vector<bool> fronts(const std::vector<Result>& results) {
  std::vector<bool> all;
  for (const Result& one : results) all.push_back(one.on_front);
  return all;
}

TEST(TheFront, HasTheRunsThatNoneSurpassesInBoth) {
  // Errors +1, -0.5, 0.5, 0.1, 0.2 at 1, 2, 3, 9, 10 s: the third costs more than the second for
  // the same, the last is worse and dearer than the fourth.
  std::vector<Result> results{result(11, 1), result(9.5, 2), result(10.5, 3), result(10.1, 9),
                              result(10.2, 10)};
  judge(results, {10.0, 0.0, ""});
  EXPECT_THAT(fronts(results), ElementsAre(true, true, false, true, false));
  EXPECT_DOUBLE_EQ(*results[1].error, -0.5);
}

TEST(TheFront, LeavesOutWhatHasNoValueOrNoKnownCost) {
  std::vector<Result> results{result(10, 1), result(10.5, 2), result(10.6, 3)};
  results[0].cost.complete = false;
  results[1].value.reset();
  judge(results, {10.0, 0.0, ""});
  EXPECT_THAT(fronts(results), ElementsAre(false, false, true));
  EXPECT_TRUE(results[0].error.has_value()) << "its error is known all the same";
}

/// value = 2 + 3 h^2 + 0.1 t over h = 0.4, 0.2, 0.1 and t = 1, 0.5.
struct Made {
  std::vector<Vary> varied{parse_vary("geometry.spacing=0.4,0.2,0.1"),
                           parse_vary("solver.tolerance=1,0.5")};
  std::vector<Result> results;
  Made() {
    for (const Combination& one : all_combinations(varied)) {
      const double h = varied[0].numbers[one[0]], t = varied[1].numbers[one[1]];
      results.push_back(result(2.0 + 3.0 * h * h + 0.1 * t, 1.0 / h));
      results.back().combination = one;
      results.back().words = words_for(varied, one);
    }
  }
};

// The search for an order ends at round-off of squares.
constexpr double search = 1e-5;

TEST(RichardsonsReference, IsAlongOneKeyWithTheOthersAtTheirLastValues) {
  const Made made;
  EXPECT_NEAR(richardson_reference(made.varied, 0, made.results).value, 2.05, search);
  // Two values of the tolerance: of the formal order 2, and cautious.
  const Reference along_tolerance = richardson_reference(made.varied, 1, made.results);
  EXPECT_NEAR(along_tolerance.value, 2.03 + 0.05 - 0.05 / 3.0, 1e-12);
}

TEST(RichardsonsReference, NeedsTwoValues) {
  Made made;
  for (Result& one : made.results) one.value.reset();
  EXPECT_THROW((void)richardson_reference(made.varied, 0, made.results), program::UsageError);
}

TEST(Orders, AreOfEachSeriesAlongEachKeyOfNumbers) {
  Made made;
  judge(made.results, {2.0, 0.0, ""});
  const auto orders = orders_of(made.varied, made.results, true);
  ASSERT_EQ(orders.size(), 5U);  // two along the spacing, three along the tolerance
  EXPECT_EQ(orders[0].key, "geometry.spacing");
  EXPECT_EQ(orders[0].others, "tolerance=1");
  EXPECT_NEAR(orders[0].extrapolation.order.value(), 2.0, search);
  EXPECT_NEAR(orders[1].extrapolation.limit, 2.05, search);
  // The errors have the tolerance's share in them, too: they fall slower than the values settle.
  EXPECT_LT(orders[0].slope.value().order, 1.9);
  EXPECT_FALSE(orders_of(made.varied, made.results, false)[0].slope.has_value());
}

TEST(AResult, OfARunThatDidNotConvergeHasWhatItPassed) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "curve.csv")
      << "step,settlement_over_B,mean_pressure_Pa,evaluations\n0,0,0,0\n1,0.1,100,7\n2,0.2,150,9\n";
  campaign::Status status;
  status.folder = folder.path();
  status.stage = campaign::Status::Stage::failed;
  status.outcome.exit_code = 3;
  status.complaint = "error: stuck";
  const Result passed = result_of(status, parse_quantity("pressure@d/B=0.15"));
  EXPECT_DOUBLE_EQ(passed.value.value(), 125.0);
  EXPECT_EQ(passed.evaluations, 16);
  EXPECT_EQ(passed.steps, 2);
  const Result last = result_of(status, parse_quantity("pressure"));
  EXPECT_FALSE(last.value.has_value()) << "its last value is not that of the programme's end";
  EXPECT_EQ(last.obstacle, "error: stuck");
}

// What bears no more ends without equilibrium, and how much it bore is the answer.
TEST(AResult, OfARunToFailureIsWhereItFailed) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "curve.csv") << "step,load_parameter,strength_reduction,top_uy_m\n"
                                         "0,0,1,0\n1,0.5,1.5,-0.1\n2,0.75,1.75,-0.3\n";
  campaign::Status status;
  status.folder = folder.path();
  status.stage = campaign::Status::Stage::failed;
  status.complaint = "error: no convergence";
  for (const int exit_code : {0, 3}) {
    status.outcome.exit_code = exit_code;
    EXPECT_DOUBLE_EQ(result_of(status, parse_quantity("load_parameter")).value.value(), 0.75);
    EXPECT_DOUBLE_EQ(result_of(status, parse_quantity("max(strength_reduction)")).value.value(),
                     1.75);
  }
  EXPECT_FALSE(result_of(status, parse_quantity("top_uy_m")).value.has_value());
  const Result none = result_of(status, parse_quantity("top_ux_m"));
  EXPECT_TRUE(none.no_such_column);
  EXPECT_THAT(none.obstacle, HasSubstr("did you mean \"top_uy_m\"?"));
  status.outcome.exit_code = 2;
  EXPECT_FALSE(result_of(status, parse_quantity("load_parameter")).value.has_value());
}

TEST(TheReport, SaysTheSameInEveryForm) {
  Made made;
  made.results[5].value.reset();
  made.results[5].obstacle = "error: stuck";
  judge(made.results, {2.0, 0.01, "given"});
  Findings findings;
  findings.scene = "a.toml";
  findings.varied = made.varied;
  findings.quantity = parse_quantity("pressure@d/B=0.05");
  findings.reference = {2.0, 0.01, "given"};
  findings.results = made.results;
  findings.orders = orders_of(made.varied, made.results, true);
  const std::string table = table_text(findings);
  EXPECT_THAT(table, HasSubstr("spacing=0.4 tolerance=1"));
  EXPECT_THAT(table, HasSubstr("error: stuck"));
  EXPECT_THAT(table, HasSubstr("order 2.00"));

  const std::string csv = csv_text(findings);
  EXPECT_THAT(csv, HasSubstr("geometry.spacing,solver.tolerance,pressure@d/B=0.05,error,"));
  EXPECT_THAT(csv, HasSubstr("\n0.1,0.5,,,,"));

  const auto json = nlohmann::json::parse(json_text(findings));
  ASSERT_EQ(json.at("runs").size(), 6U);
  EXPECT_DOUBLE_EQ(json.at("runs")[0].at("error").get<double>(), *made.results[0].error);
  EXPECT_TRUE(json.at("runs")[5].at("value").is_null());
  EXPECT_EQ(json.at("runs")[0].at("settings").at("geometry.spacing"), "0.4");

  // A mark for each run with a value.
  const std::string picture = picture_text(findings);
  std::size_t marks = 0;
  for (std::size_t at = 0; (at = picture.find("<circle", at)) != std::string::npos; ++at) ++marks;
  EXPECT_EQ(marks, 5U);
}

}  // namespace
}  // namespace study

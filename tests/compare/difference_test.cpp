#include "compare/difference.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <map>

#include "compare/report.hpp"

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

comparison::Quantity field(std::vector<double> values, std::size_t components = 1) {
  const std::size_t rows = values.size() / components;
  return {"Pa", components == 1 ? std::vector{rows} : std::vector{rows, components},
          std::move(values)};
}

comparison::Quantity list(std::vector<std::int64_t> values) {
  return {"-", {values.size()}, std::move(values)};
}

comparison::Source source_of(const std::map<std::string, comparison::Quantity>& fields,
                             std::vector<std::int64_t> steps = {}) {
  comparison::Source source;
  for (const auto& entry : fields) source.names.push_back(entry.first);
  source.load = [fields](const std::string& name) { return fields.at(name); };
  source.steps = std::move(steps);
  return source;
}

TEST(Difference, IsTheLargestAndSaysWhereItIs) {
  const comparison::Difference d =
      comparison::difference_of(field({1, 2, 3, 4, -8, 6}, 2), field({1, 2.5, 3, 4, -7, 6.5}, 2));
  EXPECT_FALSE(d.identical);
  EXPECT_EQ(d.largest, 1.0);
  EXPECT_EQ(d.relative, 1.0 / 8.0);
  EXPECT_EQ(d.count, 3U);
  EXPECT_EQ(d.row, 2U);
  EXPECT_EQ(d.component, 0U);
  EXPECT_EQ(d.first, -8.0);
  EXPECT_EQ(d.second, -7.0);
}

TEST(Difference, OfEqualFieldsIsNoneNanIncluded) {
  const comparison::Difference d =
      comparison::difference_of(field({1, nan, infinity}), field({1, nan, infinity}));
  EXPECT_TRUE(d.identical);
  EXPECT_EQ(d.largest, 0.0);
}

TEST(Difference, ThatIsOnlyInTheSignOfZeroIsNotIdentical) {
  const comparison::Difference d = comparison::difference_of(field({0.0}), field({-0.0}));
  EXPECT_FALSE(d.identical);
  EXPECT_EQ(d.count, 0U);
}

TEST(Difference, ToANumberThatIsNotFiniteIsInfinite) {
  for (const double bad : {nan, infinity, -infinity}) {
    EXPECT_EQ(comparison::difference_of(field({1.0, 2.0}), field({1.0, bad})).largest, infinity);
    EXPECT_EQ(comparison::difference_of(field({bad, 2.0}), field({1.0, 2.0})).largest, infinity);
  }
}

TEST(Difference, OfIntegersSeesTheLastBit) {
  const std::int64_t large = (std::int64_t{1} << 60) + 1;  // no double
  const comparison::Difference d = comparison::difference_of(list({large}), list({large - 1}));
  EXPECT_FALSE(d.identical);
}

TEST(Difference, OfFieldsThatDoNotMatchSaysWhy) {
  EXPECT_THAT(comparison::difference_of(field({1, 2}), field({1, 2, 3})).obstacle,
              HasSubstr("shape 2 and 3"));
  EXPECT_THAT(comparison::difference_of(field({1, 2}), field({1, 2}, 2)).obstacle,
              HasSubstr("shape 2 and 1 x 2"));
  comparison::Quantity other = field({1, 2});
  other.unit = "kPa";
  EXPECT_THAT(comparison::difference_of(field({1, 2}), other).obstacle,
              HasSubstr("unit Pa and kPa"));
  comparison::Quantity integers = list({1, 2});
  integers.unit = "Pa";
  EXPECT_THAT(comparison::difference_of(field({1, 2}), integers).obstacle,
              HasSubstr("another type"));
}

TEST(Pattern, MatchesTheWholeNameOrItsLastPart) {
  EXPECT_TRUE(comparison::matches("particles/stress", "stress"));
  EXPECT_TRUE(comparison::matches("particles/stress", "particles/*"));
  EXPECT_TRUE(comparison::matches("particles/stress", "s?ress"));
  EXPECT_FALSE(comparison::matches("particles/stress", "strain"));
  EXPECT_FALSE(comparison::matches("particles/stress", "rows/*"));
}

std::vector<std::string> failing(const comparison::Source& a, const comparison::Source& b,
                                 const comparison::Request& request) {
  std::vector<std::string> names;
  for (const comparison::Difference& d : comparison::differences(a, b, request)) {
    if (!d.passes) names.push_back(d.name);
  }
  return names;
}

TEST(Tolerance, OfTheLastPatternThatMatchesCounts) {
  const comparison::Source a = source_of({{"s/x", field({10.0})}, {"s/y", field({10.0})}});
  const comparison::Source b = source_of({{"s/x", field({10.5})}, {"s/y", field({10.5})}});
  EXPECT_THAT(failing(a, b, {}), ElementsAre("s/x", "s/y"));
  EXPECT_THAT(failing(a, b, {.absolute = {{"*", 0.5}}}), ElementsAre());
  EXPECT_THAT(failing(a, b, {.absolute = {{"*", 0.5}, {"y", 0.1}}}), ElementsAre("s/y"));
  EXPECT_THAT(failing(a, b, {.absolute = {{"y", 0.1}, {"*", 0.5}}}), ElementsAre());
  EXPECT_THAT(failing(a, b, {.relative = {{"*", 0.05}}}), ElementsAre());  // of 10.5
  EXPECT_THAT(failing(a, b, {.relative = {{"*", 0.04}}}), ElementsAre("s/x", "s/y"));
  EXPECT_THAT(failing(a, b, {.absolute = {{"*", 0.1}}, .relative = {{"*", 0.04}}}), ElementsAre());
}

TEST(Tolerance, LetsNothingThroughThatCannotBeCompared) {
  const comparison::Source a =
      source_of({{"x", field({1.0})}, {"y", field({1.0})}, {"z", field({nan})}});
  const comparison::Source b =
      source_of({{"x", field({1.0, 2.0})}, {"w", field({1.0})}, {"z", field({1.0})}});
  const comparison::Request generous{.absolute = {{"*", 1e300}}, .relative = {{"*", 1e300}}};
  EXPECT_THAT(failing(a, b, generous), ElementsAre("w", "x", "y", "z"));
}

TEST(Request, TakesSomeFieldsAndLeavesOthers) {
  const comparison::Source a = source_of({{"x", field({1.0})}, {"y", field({1.0})}});
  const comparison::Source b = source_of({{"x", field({1.0})}, {"y", field({2.0})}});
  EXPECT_THAT(failing(a, b, {.only = {"x"}}), ElementsAre());
  EXPECT_THAT(failing(a, b, {.ignored = {"y"}}), ElementsAre());
  EXPECT_TRUE(comparison::differences(a, b, {.only = {"no such"}}).empty());
}

TEST(Curves, OfDifferentLengthAreComparedAtTheStepsTheyShare) {
  const comparison::Source a = source_of(
      {{"curve/p", field({0, 1, 2, 3})}, {"curve/step", list({0, 1, 2, 3})}}, {0, 1, 2, 3});
  const comparison::Source b =
      source_of({{"curve/p", field({0, 2.5, 3})}, {"curve/step", list({0, 2, 3})}}, {0, 2, 3});
  const auto all = comparison::differences(a, b, {});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].largest, 0.5);
  EXPECT_EQ(all[0].row, 2U);
  EXPECT_THAT(all[1].obstacle, HasSubstr("1 steps only in A, 0 only in B"));
  EXPECT_THAT(comparison::comparison_report(a, all), HasSubstr("2 and 2.5; 1 differ; step 2  <--"));
}

// What solvers have learnt differs with the last digits of the results.
TEST(Differences, OfSecantPairsCountWithoutATolerance) {
  const comparison::Source a =
      source_of({{"particles/x", field({1.0})}, {"secants/step", field({1.0})}});
  const comparison::Source b =
      source_of({{"particles/x", field({1.0})}, {"secants/step", field({-1.0})}});
  EXPECT_EQ(failing(a, b, {}), std::vector<std::string>{"secants/step"});
  EXPECT_TRUE(failing(a, b, {.relative = {{"*", 1e-6}}}).empty());
  EXPECT_EQ(failing(a, b, {.relative = {{"*", 1e-6}}, .only = {"secants/*"}}),
            std::vector<std::string>{"secants/step"});
  EXPECT_THAT(comparison::comparison_report(a, comparison::differences(a, b, {})),
              HasSubstr("1 differ; pair 0 unknown 0  <--"));
}

TEST(Report, SumsUp) {
  const comparison::Source a =
      source_of({{"particles/x", field({1.0, 2.0})}, {"particles/y", field({1.0})}});
  const comparison::Source b =
      source_of({{"particles/x", field({1.0, 2.5})}, {"particles/y", field({1.0})}});
  EXPECT_THAT(comparison::comparison_report(a, comparison::differences(a, a, {})),
              HasSubstr("all 2 fields are identical bit by bit"));
  EXPECT_THAT(
      comparison::comparison_report(a, comparison::differences(a, b, {.absolute = {{"*", 1.0}}})),
      HasSubstr("\n1 identical, 1 within tolerance"));
  const std::string report = comparison::comparison_report(a, comparison::differences(a, b, {}));
  EXPECT_THAT(report, HasSubstr("2 and 2.5; 1 differ; particle 1  <--"));
  EXPECT_THAT(report, HasSubstr("DIFFERENT: 1 of 2 fields; 1 identical, 0 within tolerance"));
}

}  // namespace

#include "study/grid.hpp"

#include <gmock/gmock.h>

#include "program/command_line.hpp"

namespace study {
namespace {

using program::UsageError;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Vary, HasTheValuesBetweenCommas) {
  const Vary vary = parse_vary("geometry.spacing=0.04,2e-2,0.01");
  EXPECT_EQ(vary.key, "geometry.spacing");
  EXPECT_THAT(vary.values, ElementsAre("0.04", "2e-2", "0.01"));
  EXPECT_THAT(vary.numbers, ElementsAre(0.04, 0.02, 0.01));
}

TEST(Vary, KeepsCommasInBracketsAndQuotes) {
  EXPECT_THAT(parse_vary("drive.direction=[0.0, -1.0],[1.0,0.0]").values,
              ElementsAre("[0.0, -1.0]", "[1.0,0.0]"));
  EXPECT_THAT(parse_vary("title=\"a, b\",'c,d'").values, ElementsAre("\"a, b\"", "'c,d'"));
}

TEST(Vary, HasNumbersOnlyIfAllAreAndHaveAnOrder) {
  EXPECT_THAT(parse_vary("hourglass.control=mixed,incremental").numbers, IsEmpty());
  EXPECT_THAT(parse_vary("a.b=1,0").numbers, IsEmpty()) << "0 has no logarithm";
}

TEST(Vary, RefusesWhatNamesNothingOrTheSameTwice) {
  for (const char* text : {"a.b", "=1", "a.b=", "a.b=1,", "a.b=1,,2", "a.b=0.1,1e-1", "a.b=x,x"}) {
    EXPECT_THROW((void)parse_vary(text), UsageError) << text;
  }
}

const std::vector<Vary> two_keys{parse_vary("a.x=3,2,1"), parse_vary("b.y=p,q")};

TEST(Combinations, AreAllOfThemTheLastKeyFastest) {
  const auto all = all_combinations(two_keys);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_THAT(all[0], ElementsAre(0, 0));
  EXPECT_THAT(all[1], ElementsAre(0, 1));
  EXPECT_THAT(all[5], ElementsAre(2, 1));
  EXPECT_THAT(settings_of(two_keys, all[3]), ElementsAre("a.x=2", "b.y=q"));
  EXPECT_EQ(words_for(two_keys, all[3]), "x=2 y=q");
}

TEST(Series, RunAlongOneKeyWithTheOthersAsTheyAre) {
  const auto all = all_combinations(two_keys);
  EXPECT_THAT(series_along(two_keys, all, 0),
              ElementsAre(ElementsAre(0, 2, 4), ElementsAre(1, 3, 5)));
  EXPECT_THAT(series_along(two_keys, all, 1),
              ElementsAre(ElementsAre(0, 1), ElementsAre(2, 3), ElementsAre(4, 5)));
}

}  // namespace
}  // namespace study

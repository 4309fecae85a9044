#include "picture/picture.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <regex>
#include <stdexcept>

namespace picture {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

struct Place {
  double x, y;
};

std::vector<Place> marks_in(const std::string& svg) {
  std::vector<Place> all;
  const std::regex mark("<circle cx=\"([-0-9.]+)\" cy=\"([-0-9.]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), mark), end; at != end; ++at) {
    all.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  }
  return all;
}

Picture of(const std::vector<double>& x, const std::vector<double>& y, bool logarithmic) {
  return {"title", {"x", logarithmic}, {"y", logarithmic}, {{"s", x, y, false, true, {}}}};
}

// Places are printed to a tenth of a pixel.
constexpr double pixel = 0.15;

TEST(Picture, PutsEqualRatiosAtEqualDistancesOnLogarithmicAxes) {
  const auto marks = marks_in(svg_text(of({1.0, 10.0, 100.0}, {1e-3, 1e-2, 1e-1}, true)));
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, pixel);
  EXPECT_NEAR(marks[1].y - marks[0].y, marks[2].y - marks[1].y, pixel);
  EXPECT_GT(marks[1].x, marks[0].x) << "to the right";
  EXPECT_LT(marks[1].y, marks[0].y) << "and up";
}

TEST(Picture, PutsEqualDifferencesAtEqualDistancesOnLinearAxes) {
  const auto marks = marks_in(svg_text(of({-1.0, 0.0, 1.0}, {5.0, 7.0, 9.0}, false)));
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, pixel);
  EXPECT_NEAR(marks[1].y - marks[0].y, marks[2].y - marks[1].y, pixel);
}

TEST(Picture, PartsALineWhereItHasNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Picture picture = of({1.0, 2.0, nan, 3.0, 4.0}, {1.0, 2.0, nan, 3.0, 4.0}, false);
  picture.series.front().line = true;
  const std::string svg = svg_text(picture);
  const std::regex parts("<path d=\"M[-0-9. ]+L[-0-9. ]+M[-0-9. ]+L[-0-9. ]+\"");
  EXPECT_TRUE(std::regex_search(svg, parts));
}

TEST(Picture, LeavesOutWhatHasNoPlace) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string svg =
      svg_text(of({1.0, 0.0, -1.0, nan, infinity, 2.0}, {1.0, 1.0, 1.0, 1.0, 1.0, 0.0}, true));
  EXPECT_EQ(marks_in(svg).size(), 1U);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
  for (const bool logarithmic : {false, true}) {
    EXPECT_THAT(svg_text(of({}, {}, logarithmic)), Not(HasSubstr("nan")));
    EXPECT_THAT(svg_text(of({3.0}, {3.0}, logarithmic)), Not(HasSubstr("nan")));
    EXPECT_THAT(svg_text(of({0.0}, {0.0}, logarithmic)), Not(HasSubstr("nan")));
  }
}

TEST(Picture, EscapesWhatTheUserWrote) {
  Picture picture = of({1.0}, {1.0}, false);
  picture.title = "a < b & \"c\"";
  EXPECT_THAT(svg_text(picture), HasSubstr("a &lt; b &amp; &quot;c&quot;"));
}

TEST(Picture, OfSeriesOfUnequalLengthIsAnErrorWithBoth) {
  try {
    (void)svg_text(of({1.0, 2.0}, {1.0}, false));
    FAIL();
  } catch (const std::invalid_argument& failure) {
    EXPECT_THAT(failure.what(), HasSubstr("2 values of x, 1 of y"));
  }
}

TEST(Ticks, AreDecadesOrRoundSteps) {
  EXPECT_THAT(ticks_of(0.9, 11000.0, true), ElementsAre(1.0, 10.0, 100.0, 1000.0, 10000.0));
  EXPECT_THAT(ticks_of(0.9, 6.0, true), ElementsAre(1.0, 2.0, 5.0));
  EXPECT_THAT(ticks_of(-0.05, 1.05, false),
              ElementsAre(0.0, DoubleNear(0.2, 1e-12), DoubleNear(0.4, 1e-12),
                          DoubleNear(0.6, 1e-12), DoubleNear(0.8, 1e-12), DoubleNear(1.0, 1e-12)));
}

// A range of a few units in the last place: counting on would never come to its end.
TEST(Ticks, OfARangeAtTheRoundOffOfItsPlaceAreFew) {
  EXPECT_LE(ticks_of(1e20, 1e20 * (1.0 + 4e-16), false).size(), 20U);
  EXPECT_LE(marks_in(svg_text(of({1e20, 1e20 * (1.0 + 4e-16)}, {1e300, -1e300}, false))).size(),
            2U);
}

}  // namespace
}  // namespace picture

// The scenes of share/scenes/limit as they are shipped: the table of share/doc/limit-analysis.md.
#include <cstdio>

#include "limit/ground/ground_cases.hpp"

namespace {

using namespace limit;

class Ground : public ::testing::TestWithParam<KnownGround> {};

TEST_P(Ground, IsBracketedWithinFourPerCent) {
  const KnownGround& known = GetParam();
  const auto problem = shipped(known.scene);
  ASSERT_TRUE(problem);
  const bracket::Solution found =
      bracket::solution_of(problem->associated, bracket::BracketOptions{}, {});
  ASSERT_TRUE(found.lower && found.upper);
  double seconds = 0.0;
  for (const bracket::Attempt& attempt : found.bracket.attempts) seconds += attempt.seconds;
  std::printf(
      "%-18s known %8.6g .. %8.6g  lower %8.6g  upper %8.6g  gap %.2f %%  %zu and %zu triangles, "
      "%.0f s\n",
      known.scene, known.low, known.high, *found.lower, *found.upper, 100 * found.gap(),
      found.bracket.lower->mesh.triangles.size(), found.bracket.upper->mesh.triangles.size(),
      seconds);
  EXPECT_LE(*found.lower, known.high) << known.source;
  EXPECT_GE(*found.upper, known.low) << known.source;
  EXPECT_LE(found.gap(), 0.04);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Ground, ::testing::ValuesIn(known_grounds()),
                         [](const auto& info) { return std::string(info.param.scene); });

// A slope of 2:1, friction 20 degrees, c = 0.05 of its weight times its height, by its water.
struct PublishedSlope {
  const char* scene;
  const char* table;  // [[...]] in place of the scene's
  double published;
  double off;  // how far that is from exact, as a share: its method's, or its last digit
  const char* source;
};

void PrintTo(const PublishedSlope& slope, std::ostream* out) {
  *out << slope.scene << " " << slope.table;
}

class PublishedSlopes : public ::testing::TestWithParam<PublishedSlope> {};

TEST_P(PublishedSlopes, HaveTheirFactorInTheBracket) {
  const PublishedSlope& known = GetParam();
  const auto cases = shipped(known.scene, {std::string("water.table=") + known.table});
  ASSERT_TRUE(cases);
  const bracket::Solution found = bracket::solution_of(cases->associated, {}, {});
  ASSERT_TRUE(found.lower && found.upper);
  std::printf("%s %s: %.4g (%s) | %.5f %.5f %.2f %%\n", known.scene, known.table, known.published,
              known.source, *found.lower, *found.upper, 100.0 * found.gap());
  EXPECT_LE(*found.lower, known.published * (1.0 + known.off));
  EXPECT_GE(*found.upper, known.published * (1.0 - known.off));
}

constexpr const char* griffiths = "Griffiths & Lane 1999, finite elements, two digits";
INSTANTIATE_TEST_SUITE_P(
    GriffithsAndLane, PublishedSlopes,
    ::testing::Values(PublishedSlope{"drawdown_full", "[[-20, -6], [35, -6]]", 1.380, 0.01,
                                     "Bishop & Morgenstern 1960, method of slices"},
                      PublishedSlope{"drawdown_full", "[[-20, 3], [35, 3]]", 1.3, 0.04,
                                     griffiths}));

}  // namespace

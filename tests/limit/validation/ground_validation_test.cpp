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

}  // namespace

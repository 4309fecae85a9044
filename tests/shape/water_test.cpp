// The weight above a place, and water tables.
#include "shape/water.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>

namespace shape {
namespace {

using ::testing::HasSubstr;

constexpr double rounding = 1e-12;

// A face of 2 : 3 between two levels.
const Ring slope{{0, 0}, {10, 0}, {10, 2}, {4, 6}, {0, 6}};

TEST(Overburden, IsTheWeightStraightAbove) {
  Ring clockwise = slope;
  std::ranges::reverse(clockwise);
  for (const Ring& ring : {slope, clockwise}) {
    const std::vector<HeavyRing> ground{{ring, 20e3}};
    const Pressure level = overburden(ground, {2.0, 1.0});
    EXPECT_NEAR(level.value, 20e3 * 5.0, rounding * 1e5);
    EXPECT_NEAR(level.gradient.x(), 0.0, rounding);
    EXPECT_NEAR(level.gradient.y(), -20e3, rounding);
    // The face is 4 m high there.
    const Pressure below_face = overburden(ground, {7.0, 1.0});
    EXPECT_NEAR(below_face.value, 20e3 * 3.0, rounding * 1e5);
    EXPECT_NEAR(below_face.gradient.x(), -20e3 * 2.0 / 3.0, rounding * 1e5);
    EXPECT_NEAR(below_face.gradient.y(), -20e3, rounding * 1e5);
    EXPECT_EQ(overburden(ground, {7.0, 5.0}).value, 0.0) << "in the air";
  }
}

// Soft ground over a layer whose upper face rises by 1 : 4.
TEST(Overburden, CountsEachLayerByItsThickness) {
  const std::vector<HeavyRing> ground{{{{0, 0}, {8, 0}, {8, 3}, {0, 1}}, 24e3},
                                      {{{0, 1}, {8, 3}, {8, 5}, {0, 5}}, 16e3}};
  const Pressure low = overburden(ground, {4.0, 0.5});
  EXPECT_NEAR(low.value, 24e3 * 1.5 + 16e3 * 3.0, rounding * 1e5);
  EXPECT_NEAR(low.gradient.x(), (24e3 - 16e3) / 4.0, rounding * 1e5);
  EXPECT_NEAR(low.gradient.y(), -24e3, rounding * 1e5);
  const Pressure high = overburden(ground, {4.0, 4.0});
  EXPECT_NEAR(high.value, 16e3, rounding * 1e5);
  EXPECT_NEAR(high.gradient.x(), 0.0, rounding * 1e5);
}

std::string complaint_of(const std::vector<HeavyRing>& ground) {
  tables::Diagnosis diagnosis("s.toml");
  const bool has = has_overburden(ground, "water.r_u", diagnosis);
  EXPECT_EQ(has, diagnosis.errors().empty());
  return has ? "" : diagnosis.errors().front().text();
}

TEST(Overburden, JumpsBelowAnUprightFace) {
  EXPECT_EQ(complaint_of({{slope, 20e3}}), "") << "the ends of the ground are no such faces";
  // A vertical cut of 4 m.
  EXPECT_THAT(complaint_of({{{{0, 0}, {10, 0}, {10, 2}, {4, 2}, {4, 6}, {0, 6}}, 20e3}}),
              HasSubstr("water.r_u: the weight above jumps by 80000 Pa below the upright face at "
                        "x = 4"));
  // Two soils side by side on a third.
  const auto beside = [](double right) {
    return std::vector<HeavyRing>{{{{0, 0}, {8, 0}, {8, 1}, {4, 1}, {0, 1}}, 24e3},
                                  {{{0, 1}, {4, 1}, {4, 5}, {0, 5}}, 16e3},
                                  {{{4, 1}, {8, 1}, {8, 5}, {4, 5}}, right}};
  };
  EXPECT_EQ(complaint_of(beside(16e3)), "");
  EXPECT_THAT(complaint_of(beside(18e3)), HasSubstr("jumps by 8000 Pa"));
}

}  // namespace
}  // namespace shape

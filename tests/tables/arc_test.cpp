// Arcs in lists of points.
#include "tables/arc.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tables {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<double> corners(const Arc& arc) {
  std::vector<double> coordinates;
  append(arc, coordinates);
  return coordinates;
}

TEST(Arc, HasItsEndsAndCornersOnItsCircle) {
  const std::vector<double> found = corners({{2.0, -1.0}, 0.5, 10.0, 100.0, 8});  // steps of 45
  ASSERT_EQ(found.size(), 8U);
  const double degrees[] = {10.0, 45.0, 90.0, 100.0};
  for (std::size_t k = 0; k < 4; ++k) {
    const double angle = degrees[k] * std::acos(-1.0) / 180.0;
    EXPECT_NEAR(found[2 * k], 2.0 + 0.5 * std::cos(angle), 1e-15);
    EXPECT_NEAR(found[2 * k + 1], -1.0 + 0.5 * std::sin(angle), 1e-15);
  }
}

// So that a side may follow a part of a region's arc, either way.
TEST(Arc, SharesCornersWithAllOfItsCircle) {
  const std::vector<double> whole = corners({{0.3, 0.7}, 1.3});
  ASSERT_EQ(whole.size(), 2U * 145U);
  EXPECT_EQ(whole[0], whole[288]);
  EXPECT_EQ(whole[1], whole[289]);
  for (const auto& [from, to] : {std::pair(10.0, 70.0), std::pair(70.0, 10.0),
                                 std::pair(-50.0, 40.0), std::pair(400.0, 370.0)}) {
    const std::vector<double> part = corners({{0.3, 0.7}, 1.3, from, to});
    for (std::size_t k = 0; k < part.size(); k += 2) {
      bool is_shared = false;
      for (std::size_t j = 0; j < whole.size(); j += 2) {
        is_shared = is_shared || (whole[j] == part[k] && whole[j + 1] == part[k + 1]);
      }
      EXPECT_TRUE(is_shared) << from << " " << k / 2;
    }
  }
}

TEST(Arc, IsExactOnTheAxes) {
  EXPECT_THAT(corners({{0.0, 0.0}, 3.0, -90.0, 0.0, 4}), ElementsAre(0.0, -3.0, 3.0, 0.0));
  EXPECT_THAT(corners({{0.0, 0.0}, 3.0, 180.0, 90.0, 4}), ElementsAre(-3.0, 0.0, 0.0, 3.0));
}

TEST(Arc, GoesOnWhereTheListEnds) {
  std::vector<double> coordinates{0.0, 0.0, 1.0, 0.0};
  append({{0.0, 0.0}, 1.0, 0.0, 90.0, 8}, coordinates);
  ASSERT_EQ(coordinates.size(), 8U);
  EXPECT_TRUE(is_end({0.0, 1.0}, coordinates));
  EXPECT_FALSE(is_end({0.0, 1.0 + 1e-6}, coordinates));
}

TEST(Arc, IsNoneWithoutARadiusOrAnAngle) {
  EXPECT_THAT(objection({{0.0, 0.0}, 0.0}), HasSubstr("radius"));
  EXPECT_THAT(objection({{0.0, 0.0}, 1.0, 30.0, 30.0}), HasSubstr("nothing"));
  EXPECT_THAT(objection({{0.0, 0.0}, 1.0, 0.0, 361.0}), HasSubstr("more than a turn"));
  EXPECT_EQ(objection({{0.0, 0.0}, 1.0, 360.0, 0.0}), "");
}

}  // namespace
}  // namespace tables

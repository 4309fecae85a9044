#include "tables/nearest_name.hpp"

#include <gtest/gtest.h>

namespace tables {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("spacing", "spacing"), 0U);
  EXPECT_EQ(edit_distance("spacng", "spacing"), 1U);
  EXPECT_EQ(edit_distance("spaccing", "spacing"), 1U);
  EXPECT_EQ(edit_distance("spasing", "spacing"), 1U);
  EXPECT_EQ(edit_distance("spaicng", "spacing"), 1U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
}

TEST(EditDistance, IsSymmetricAndIgnoresCase) {
  EXPECT_EQ(edit_distance("traction", "drive"), edit_distance("drive", "traction"));
  EXPECT_EQ(edit_distance("k0", "K0"), 0U);
}

TEST(NearestName, FindsTheMisspeltOne) {
  EXPECT_EQ(nearest_name("cohesoin", {"cohesion", "density"}), "cohesion");
  EXPECT_EQ(nearest_name("Denstiy", {"cohesion", "density"}), "density");
}

TEST(NearestName, IsEmptyWhenNothingIsNear) {
  EXPECT_EQ(nearest_name("colour", {"cohesion", "density"}), "");
  EXPECT_EQ(nearest_name("w", {"x", "y"}), "");
  EXPECT_EQ(nearest_name("abc", {}), "");
}

TEST(NearestName, TakesTheFirstOfEquallyNearOnes) {
  EXPECT_EQ(nearest_name("range_mi", {"range_min", "range_mid"}), "range_min");
}

}  // namespace
}  // namespace tables

#include <gtest/gtest.h>
#include <omp.h>

#include "run/run_loop.hpp"

namespace run {
namespace {

/// As many threads as OpenMP would offer, whatever this machine has.
class ThreadCount : public ::testing::Test {
 protected:
  void SetUp() override { omp_set_num_threads(8); }
  void TearDown() override { omp_set_num_threads(offered_); }

 private:
  int offered_ = omp_get_max_threads();
};

TEST_F(ThreadCount, IsTheOneAskedForWhateverTheBody) {
  EXPECT_EQ(thread_count(1, 1000000), 1);
  EXPECT_EQ(thread_count(3, 1), 3);
  EXPECT_EQ(thread_count(16, 1000000), 16);
}

TEST_F(ThreadCount, IsOneForASmallBodyAndGrowsWithIt) {
  EXPECT_EQ(thread_count(0, 1), 1);
  EXPECT_EQ(thread_count(0, 3999), 1);
  EXPECT_EQ(thread_count(0, 4000), 2);
  EXPECT_EQ(thread_count(0, 7260), 2);
  EXPECT_EQ(thread_count(0, 12000), 4);
}

TEST_F(ThreadCount, IsAtMostWhatOpenMpOffersThoughTheCountExceedsAnInt) {
  EXPECT_EQ(thread_count(0, 1000000), 8);
  EXPECT_EQ(thread_count(0, std::int64_t{4000} << 33), 8);
}

}  // namespace
}  // namespace run

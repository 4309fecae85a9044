// The structs of arrays: every array is in its struct's list, and has the size the list says.
#include "equilibrium/arrays.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace {

using namespace equilibrium;

// All sizes differ, so that one taken for another shows.
constexpr ArraySizes distinct = {101, 131, 23, 103, 107, 109, 113, 127, 211, 223, 227, 229};

// A struct is its sizes, its arrays and `others` bytes: an array that the list forgets shows as a
// size that nobody accounts for.
template <class Arrays>
void expect_all_listed(std::size_t others) {
  Arrays arrays;
  std::size_t listed = sizeof(ArraySizes) + others;
  std::set<std::string> names;
  std::set<const void*> seen;
  Arrays::for_each_array(arrays, [&](const char* name, auto& array, Eigen::Index, Eigen::Index) {
    listed += sizeof(array);
    EXPECT_TRUE(names.insert(name).second) << name << " is listed twice";
    EXPECT_TRUE(seen.insert(&array).second) << name << " is another's array";
  });
  EXPECT_EQ(listed, sizeof(Arrays));
}

TEST(Arrays, ListEveryArrayOnce) {
  constexpr std::size_t load = sizeof(double);
  expect_all_listed<StepArrays<2>>(load);
  expect_all_listed<StepArrays<3>>(load);
  expect_all_listed<EvaluationArrays<2>>(0);
  expect_all_listed<EvaluationArrays<3>>(0);
  expect_all_listed<TangentArrays>(sizeof(double));  // its unit
}

template <class Arrays>
void expect_allocated() {
  Arrays arrays;
  EXPECT_EQ(bytes_of(arrays), 0U);
  allocate(arrays, distinct);
  std::size_t bytes = 0;
  const Arrays& held = arrays;
  Arrays::for_each_array(
      held, [&](const char* name, const auto& array, Eigen::Index rows, Eigen::Index columns) {
        EXPECT_EQ(array.rows(), rows) << name;
        EXPECT_EQ(array.cols(), columns) << name;
        EXPECT_TRUE((array.array() == 0.0).all()) << name;
        bytes += static_cast<std::size_t>(rows * columns) * sizeof(*array.data());
      });
  EXPECT_GT(bytes, 0U);
  EXPECT_EQ(bytes_of(arrays), bytes);
}

TEST(Arrays, AreAllocatedAndCountedByTheList) {
  expect_allocated<StepArrays<2>>();
  expect_allocated<StepArrays<3>>();
  expect_allocated<EvaluationArrays<2>>();
  expect_allocated<EvaluationArrays<3>>();
  expect_allocated<TangentArrays>();
}

}  // namespace

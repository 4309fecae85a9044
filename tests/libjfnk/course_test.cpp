#include "course.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

namespace {

using jfnk::detail::FieldCounter;

/// Initialises any member.
struct Anything {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor): that is its purpose
};

template <class T, std::size_t... i>
constexpr bool takes(std::index_sequence<i...>) {
  return requires {
    T{(static_cast<void>(i), Anything{})...};
  };
}

/// Members of an aggregate: the most initialisers that it takes.
template <class T, std::size_t most = 64>
constexpr int members() {
  if constexpr (takes<T>(std::make_index_sequence<most>{})) {
    return static_cast<int>(most);
  } else {
    return members<T, most - 1>();
  }
}

template <class T>
int listed() {
  T part;
  FieldCounter counter;
  part.for_each_field(counter);
  return counter.count;
}

template <class T>
class CourseParts : public testing::Test {};
using Parts = testing::Types<jfnk::detail::Course, jfnk::detail::StageCourse,
                             jfnk::detail::MultisecantCourse, jfnk::detail::NewtonCourse,
                             jfnk::detail::RescueCourse, jfnk::detail::TransientCourse,
                             jfnk::detail::PreconditionerCourse, jfnk::detail::ForcingState>;
TYPED_TEST_SUITE(CourseParts, Parts);

// What is not listed is lost from a snapshot, so that a resumed solve takes another path.
TYPED_TEST(CourseParts, ListEveryMemberOnce) {
  EXPECT_EQ(listed<TypeParam>(), members<TypeParam>());
}

/// Two members more than its list has.
struct Forgetful {
  double named = 0.0;
  int forgotten = 0;
  std::array<double, 3> forgotten_too{};

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(named);
  }
};

TEST(CourseParts, AForgottenMemberIsSeen) {
  EXPECT_EQ(members<Forgetful>(), 3);
  EXPECT_EQ(listed<Forgetful>(), 1);
}

}  // namespace

// Bodies that turn as a whole, many times.

#include "turns.hpp"

namespace extremes {
namespace {

TEST(Axis, Turns) {
  sweep(turning({{1, 4}, {1, 8}, {1, 72}, {10, 8}, {100, 8}, {1000, 8}}));
}

}  // namespace
}  // namespace extremes

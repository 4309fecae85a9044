#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "limit/bracket/side.hpp"
#include "limit/ground/ground_cases.hpp"

// Soil whose tension is cut off, and what is asked of it.
namespace limit {

inline bracket::Solution coarse(const std::string& text) {
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
}

// The lower bound of the first mesh alone, with its fields.
inline bracket::Solution lower_alone(const std::string& text) {
  bracket::Solution found;
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  if (!problem) return found;
  const problem::Case& whole = problem->associated;
  bracket::Side side(problem::in_units(whole.lower, whole.units), true);
  side.attempt(found.bracket, {}, {});
  if (found.bracket.lower) found.lower = found.bracket.lower_bound() * whole.units.multiplier();
  return found;
}

// gamma H / c of a vertical cut. Drucker and Prager's (1952) columns stand without tension up to 2;
// with all of its tension clay comes to 3.776 .. 3.778.
inline std::string cut(double tension) {
  return fmt::format(
             "[load]\nsought = \"gravity\"\n[[material]]\nname = \"clay\"\ncohesion = 1\n"
             "friction_angle = 0\nunit_weight = 1\ntension_cutoff = {}\n",
             tension) +
         R"([[region]]
material = "clay"
outline = [[-2, -1], [2, -1], [2, 1], [0, 1], [0, 0], [-2, 0]]
[[side]]
name = "free"
kind = "free"
along = [[-2, 0], [0, 0], [0, 1], [2, 1]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[-2, 0], [-2, -1], [2, -1], [2, 1]]
)";
}

// The largest principal stress in any corner.
inline double largest_tension(const bracket::Solution& found) {
  double largest = -INFINITY;
  for (const problem::StressTriangle& triangle : found.bracket.lower->certificate.field) {
    for (Eigen::Index i = 0; i < triangle.cols(); ++i) {
      const auto s = triangle.col(i);
      largest = std::max(largest, (s[0] + s[1]) / 2.0 + std::hypot((s[0] - s[1]) / 2.0, s[2]));
    }
  }
  return largest;
}

// Half of a strip that may lift off, on level ground.
inline std::string strip(double friction, double weight, const std::string& more) {
  return "[load]\nsought = \"footing\"\n" + more +
         fmt::format(
             "[[material]]\nname = \"soil\"\ncohesion = 1\nfriction_angle = {}\n"
             "unit_weight = {}\ntension_cutoff = 0\n",
             friction, weight) +
         R"([[region]]
material = "soil"
outline = [[0, -1.5], [3, -1.5], [3, 0], [0, 0]]
[[side]]
name = "base"
kind = "footing"
base = "smooth"
tension = false
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [3, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -1.5]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, -1.5], [3, -1.5], [3, 0]]
)";
}

}  // namespace limit

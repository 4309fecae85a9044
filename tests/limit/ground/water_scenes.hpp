#pragma once

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "limit/ground/ground_cases.hpp"

namespace limit::told {

inline constexpr double degree = std::numbers::pi / 180.0;

/// To a gap of 7 %.
inline bracket::Solution solution(const std::string& text) {
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  bracket::BracketOptions options;
  options.gap = 0.07;
  return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
}

/// A strip on level ground, one half.
inline std::string footing(double cohesion, double unit_weight, const std::string& more) {
  return more + fmt::format(R"([load]
sought = "footing"
[[material]]
name = "soil"
cohesion = {}
friction_angle = 25
unit_weight = {}
[[region]]
material = "soil"
outline = [[0, -2], [5, -2], [5, 0], [1, 0], [0, 0]]
[[side]]
name = "base"
kind = "footing"
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [5, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, -2], [5, -2], [5, 0]]
)",
                            cohesion, unit_weight);
}

/// A face of 20 degrees, 10 m high, in ground of 20 kN/m3.
inline const double run = 10.0 / std::tan(20.0 * degree);

inline std::string slope(double cohesion, const std::string& more) {
  return more + fmt::format(R"([load]
sought = "strength"
[[material]]
name = "sand"
cohesion = {0}
friction_angle = 35
unit_weight = 20e3
[[region]]
material = "sand"
outline = [[-10, -3], [{2}, -3], [{2}, 0], [{1}, 0], [0, 10], [-10, 10]]
[[side]]
name = "surface"
kind = "free"
along = [[-10, 10], [0, 10], [{1}, 0], [{2}, 0]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[-10, 10], [-10, -3], [{2}, -3], [{2}, 0]]
)",
                            cohesion, run, run + 10.0);
}

inline double surface_at(double x) {
  return x <= 0.0 ? 10.0 : x >= run ? 0.0 : 10.0 - x * std::tan(20.0 * degree);
}

/// Columns of four points each from the bottom of the slope to its surface.
template <class Pressure>
std::string points_in_slope(Pressure&& pressure) {
  std::string points;
  for (double x : {-10.0, -5.0, 0.0, run / 4, run / 2, 3 * run / 4, run, run + 5.0, run + 10.0}) {
    for (int i = 0; i <= 3; ++i) {
      const double y = -3.0 + (surface_at(x) + 3.0) * i / 3.0;
      points += fmt::format("[{}, {}, {}], ", x, y, pressure(surface_at(x) - y));
    }
  }
  return "[water]\npore_pressure = { points = [" + points + "] }\n";
}

}  // namespace limit::told

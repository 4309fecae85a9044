#pragma once

#include <array>
#include <string>
#include <vector>

namespace tables {

/// A part of a circle, from one direction to another, counterclockwise if `to` is more.
struct Arc {
  static constexpr int fewest_chords = 8;
  static constexpr int most_chords = 3600;

  std::array<double, 2> centre{};
  double radius = 0.0;
  double from = 0.0, to = 360.0;  // [deg] from +x, counterclockwise
  int chords = 144;               // to a whole circle: no further from it than 2.4e-4 radii
};

/// What is wrong with an arc, in words; empty if it is one.
[[nodiscard]] std::string objection(const Arc& arc);

/// Appends the corners of an arc, x y x y ...: its ends, and between them where its circle is
/// divided into chords, so that arcs of one circle share corners, to the last digit. Its first
/// corner is left out where the list ends there.
void append(const Arc& arc, std::vector<double>& coordinates);

/// Whether a list of places ends at this one, but for round-off.
[[nodiscard]] bool is_end(const std::array<double, 2>& place,
                          const std::vector<double>& coordinates);

}  // namespace tables

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace picture {

struct Axis {
  std::string label;
  bool logarithmic = false;  // what is not > 0 is then left out
};

/// Points that belong together; names of its points stand beside them.
struct Series {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  bool line = true;
  bool marks = false;
  std::vector<std::string> labels;  // of each point, or none
};

/// Curves or points over two axes.
struct Picture {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
};

/// The picture as an SVG file's text: no script, no font, no colour that only colour tells apart.
/// What is not finite is left out, and parts the line it is in.
/// @throws std::invalid_argument if x and y of a series differ in length.
[[nodiscard]] std::string svg_text(const Picture& picture);

/// A text as SVG takes it.
[[nodiscard]] std::string escaped(std::string_view text);

/// Where an axis from `low` to `high` has its numbers: decades, or steps of 1, 2 or 5.
[[nodiscard]] std::vector<double> ticks_of(double low, double high, bool logarithmic);

}  // namespace picture

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>

#include "material/error_map.hpp"
#include "picture/picture.hpp"

namespace material {

namespace {

/// An edge of the grid: the lower of its two nodes, and whether it runs outward.
struct Crossing {
  std::size_t node = 0;
  bool outward = false;
  bool operator==(const Crossing&) const = default;
};
using Segment = std::array<Crossing, 2>;

/// Marching squares: what part of the level crosses a cell, from edge to edge.
class Squares {
 public:
  Squares(const ErrorMap& map, double level)
      : map_(map), level_(level), columns_(map.across.size()) {}

  [[nodiscard]] std::vector<Segment> segments() const {
    std::vector<Segment> all;
    for (std::size_t i = 0; i + 1 < map_.outward.size(); ++i) {
      for (std::size_t j = 0; j + 1 < columns_; ++j) {
        const std::size_t node = i * columns_ + j;
        const std::array<Crossing, 4> around{
            {{node, false}, {node + 1, true}, {node + columns_, false}, {node, true}}};
        std::vector<Crossing> met;
        for (const Crossing& edge : around) {
          if (above(edge.node) != above(end_of(edge))) met.push_back(edge);
        }
        // Four are met at a saddle: any two pairs of neighbours will do.
        for (std::size_t k = 0; k + 1 < met.size(); k += 2) all.push_back({met[k], met[k + 1]});
      }
    }
    return all;
  }

  void put(const Crossing& edge, Contour& lines) const {
    const std::size_t end = end_of(edge);
    const double low = map_.error[edge.node], high = map_.error[end];
    const double share = (level_ - low) / (high - low);
    const auto between = [&](double from, double to) { return from + share * (to - from); };
    lines.outward.push_back(
        between(map_.outward[edge.node / columns_], map_.outward[end / columns_]));
    lines.across.push_back(between(map_.across[edge.node % columns_], map_.across[end % columns_]));
  }

 private:
  [[nodiscard]] bool above(std::size_t node) const { return map_.error[node] > level_; }
  [[nodiscard]] std::size_t end_of(const Crossing& edge) const {
    return edge.node + (edge.outward ? columns_ : 1);
  }

  const ErrorMap& map_;
  double level_;
  std::size_t columns_;
};

/// Takes the segment out that ends at a crossing, and gives its other end.
std::optional<Crossing> next_of(const Crossing& at, std::vector<Segment>& rest) {
  for (std::size_t k = 0; k < rest.size(); ++k) {
    if (rest[k][0] != at && rest[k][1] != at) continue;
    const Crossing other = rest[k][0] == at ? rest[k][1] : rest[k][0];
    rest[k] = rest.back();
    rest.pop_back();
    return other;
  }
  return std::nullopt;
}

}  // namespace

Contour contour(const ErrorMap& map, double level) {
  const Squares squares(map, level);
  std::vector<Segment> rest = squares.segments();
  Contour lines;
  while (!rest.empty()) {
    std::deque<Crossing> line(rest.back().begin(), rest.back().end());
    rest.pop_back();
    while (const auto next = next_of(line.back(), rest)) line.push_back(*next);
    while (const auto next = next_of(line.front(), rest)) line.push_front(*next);
    for (const Crossing& edge : line) squares.put(edge, lines);
    lines.outward.push_back(std::numeric_limits<double>::quiet_NaN());
    lines.across.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  return lines;
}

std::string map_picture(const ErrorMap& map) {
  picture::Picture all{map.of.title + ": error of one step",
                       {"strain across the deviator, in its elastic strain", false},
                       {"strain along the deviator, in its elastic strain", false},
                       {}};
  for (const double percent : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const Contour lines = contour(map, percent / 100.0);
    if (lines.across.empty()) continue;
    all.series.push_back(
        {fmt::format("{:g} %", percent), lines.across, lines.outward, true, false, {}});
  }
  return picture::svg_text(all);
}

}  // namespace material

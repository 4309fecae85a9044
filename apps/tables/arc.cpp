#include "tables/arc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tables {

namespace {

constexpr double round_off = 1e-9;

std::array<double, 2> place_at(const Arc& arc, double degrees) {
  // Directions a turn apart are one, to the last digit.
  const double turn = degrees - 360.0 * std::floor(degrees / 360.0);
  // About the nearest axis, so that places on axes are exact.
  const double quarter = std::round(turn / 90.0);
  const double angle = (turn - 90.0 * quarter) * std::numbers::pi / 180.0;
  double x = std::cos(angle), y = std::sin(angle);
  for (int k = static_cast<int>(quarter); k > 0; --k) {
    const double before = x;
    x = -y;
    y = before;
  }
  return {arc.centre[0] + arc.radius * x, arc.centre[1] + arc.radius * y};
}

void add(const std::array<double, 2>& place, std::vector<double>& coordinates) {
  if (is_end(place, coordinates)) return;
  coordinates.insert(coordinates.end(), place.begin(), place.end());
}

}  // namespace

std::string objection(const Arc& arc) {
  if (!(arc.radius > 0.0)) return fmt::format("found a radius of {}", arc.radius);
  const double turn = std::abs(arc.to - arc.from);
  if (turn == 0.0 || turn > 360.0) {
    return fmt::format("found an arc from {} to {} degrees, more than a turn or nothing", arc.from,
                       arc.to);
  }
  return "";
}

void append(const Arc& arc, std::vector<double>& coordinates) {
  const double step = 360.0 / arc.chords;
  const double way = arc.to > arc.from ? 1.0 : -1.0;
  add(place_at(arc, arc.from), coordinates);
  // Whole multiples of the step between the ends.
  double k = way > 0.0 ? std::floor(arc.from / step) : std::ceil(arc.from / step);
  for (;; k += way) {
    const double degrees = k * step;
    if (way * (degrees - arc.from) <= round_off * step) continue;
    if (way * (arc.to - degrees) <= round_off * step) break;
    add(place_at(arc, degrees), coordinates);
  }
  add(place_at(arc, arc.to), coordinates);
}

bool is_end(const std::array<double, 2>& place, const std::vector<double>& coordinates) {
  if (coordinates.size() < 2) return false;
  const double x = coordinates[coordinates.size() - 2], y = coordinates.back();
  const double size = std::max({std::abs(x), std::abs(y), std::abs(place[0]), std::abs(place[1])});
  return std::hypot(place[0] - x, place[1] - y) <= round_off * size;
}

}  // namespace tables

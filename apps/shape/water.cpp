#include "shape/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shape/ring.hpp"

namespace shape {
namespace {

// Calls visit(left, right, weight) for each edge that is not upright, `weight` being that of the
// ring if the edge is an upper one, and less than nothing if it is a lower one.
template <class Visitor>
void for_each_edge(std::span<const HeavyRing> ground, Visitor&& visit) {
  for (const HeavyRing& part : ground) {
    const double sign = signed_area(part.ring) > 0.0 ? 1.0 : -1.0;
    for (std::size_t k = 0; k < part.ring.size(); ++k) {
      const Point &from = part.ring[k], &to = part.ring[(k + 1) % part.ring.size()];
      if (from.x() > to.x()) visit(to, from, sign * part.unit_weight);
      if (from.x() < to.x()) visit(from, to, -sign * part.unit_weight);
    }
  }
}

}  // namespace

Pressure overburden(std::span<const HeavyRing> ground, const Point& place) {
  Pressure pressure;
  for_each_edge(ground, [&](const Point& left, const Point& right, double weight) {
    // Half open, so that a corner belongs to one of its edges.
    if (place.x() < left.x() || place.x() >= right.x()) return;
    const double slope = (right.y() - left.y()) / (right.x() - left.x());
    const double above = left.y() + slope * (place.x() - left.x()) - place.y();
    if (above <= 0.0) return;
    pressure.value += weight * above;
    pressure.gradient += weight * Point(slope, -1.0);
  });
  return pressure;
}

bool has_overburden(std::span<const HeavyRing> ground, const char* key,
                    tables::Diagnosis& diagnosis) {
  Point low = ground.front().ring.front(), high = low;
  for (const HeavyRing& part : ground) {
    for (const Point& corner : part.ring) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const double slack = 1e-9 * (high - low).norm();
  for (const HeavyRing& part : ground) {
    for (std::size_t k = 0; k < part.ring.size(); ++k) {
      const Point &from = part.ring[k], &to = part.ring[(k + 1) % part.ring.size()];
      const double lower = std::min(from.y(), to.y());
      const bool upright = std::abs(from.x() - to.x()) <= slack && from.y() != to.y();
      const bool outer = from.x() <= low.x() + slack || from.x() >= high.x() - slack;
      if (!upright || outer || lower <= low.y() + slack) continue;
      const Point before(from.x() - 2.0 * slack, lower - slack);
      const Point behind(from.x() + 2.0 * slack, lower - slack);
      const double jump = overburden(ground, behind).value - overburden(ground, before).value;
      double heaviest = 0.0;
      for (const HeavyRing& other : ground) heaviest = std::max(heaviest, other.unit_weight);
      constexpr double rounding = 1e-6;
      if (std::abs(jump) <= rounding * heaviest * (high - low).norm()) continue;
      diagnosis.error(
          key,
          fmt::format("the weight above jumps by {:.6g} Pa below the upright face at "
                      "x = {:g}",
                      std::abs(jump), from.x()),
          "a share of the overburden is the pressure of water below ground that slopes; "
          "below a face that is upright give a table");
      return false;
    }
  }
  return true;
}

bool is_water_table(const Ring& table, const Point& low, const Point& high,
                    tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    if (table[i].x() < table[i + 1].x()) continue;
    diagnosis.error("water.table",
                    fmt::format("found x = {:g} after {:g}", table[i + 1].x(), table[i].x()),
                    "allowed are points from left to right, no two above each other");
    return false;
  }
  if (table.size() > 1 && table.front().x() <= low.x() && table.back().x() >= high.x()) return true;
  diagnosis.error(
      "water.table",
      fmt::format("found a table from x = {:g} to {:g}", table.front().x(), table.back().x()),
      fmt::format("allowed is one over all of the ground, from {:g} or less to {:g} or more",
                  low.x(), high.x()));
  return false;
}

}  // namespace shape

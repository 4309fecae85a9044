#include "limit/ground/ground_variation.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace limit::ground {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using Polygon = std::vector<mesh::Point>;

double value_at(const tables::VaryingNumber& number, const mesh::Point& place) {
  return number.at_place(std::array{place.x(), place.y()});
}

// The part of a convex polygon, or of a line, where a coordinate is no less than a bound, times a
// sign.
Polygon part_beyond(const Polygon& polygon, Eigen::Index axis, double bound, double sign) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const mesh::Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double here = sign * (a[axis] - bound), there = sign * (b[axis] - bound);
    if (here >= 0.0) part.push_back(a);
    if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
      mesh::Point& cut = part.emplace_back(a + here / (here - there) * (b - a));
      cut[axis] = bound;
    }
  }
  return part;
}

Polygon part_between(const Polygon& polygon, Eigen::Index axis, double low, double high) {
  return part_beyond(part_beyond(polygon, axis, low, 1.0), axis, high, -1.0);
}

// Bounds of a function, the number itself and its distance from what is linear.
class Collector {
 public:
  Collector(const tables::VaryingNumber& number, const std::array<mesh::Point, 3>& corners)
      : number_(number), origin_(corners[0]) {
    for (std::size_t i = 0; i < 3; ++i) within_.corner[i] = value_at(number, corners[i]);
    within_.least = infinity;
    within_.most = -infinity;
    const mesh::Point first = corners[1] - corners[0], second = corners[2] - corners[0];
    const auto& c = within_.corner;
    if (corners[1] == corners[2]) {
      slope_ = (c[1] - c[0]) / first.squaredNorm() * first;
    } else {
      Eigen::Matrix2d ways;
      ways << first.transpose(), second.transpose();
      slope_ = ways.inverse() * Eigen::Vector2d(c[1] - c[0], c[2] - c[0]);
    }
  }

  void see(const mesh::Point& place) {
    const double here = value_at(number_, place);
    const double off = here - within_.corner[0] - slope_.dot(place - origin_);
    within_.least = std::min(within_.least, here);
    within_.most = std::max(within_.most, here);
    within_.below = std::min(within_.below, off);
    within_.above = std::max(within_.above, off);
  }

  // A polygon in which the number is bilinear: least and most, and least and most off what is
  // linear, at corners or on sides, along which it is quadratic in the way s, a s^2 + b s + c.
  void see_all(const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const mesh::Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      see(a);
      const double begin = value_at(number_, a), end = value_at(number_, b),
                   middle = value_at(number_, (a + b) / 2.0);
      const double square = 2.0 * (begin + end - 2.0 * middle);
      if (square == 0.0) continue;
      const double growth = end - begin - square, linear = slope_.dot(b - a);
      for (const double way : {growth, growth - linear}) {
        const double at = -way / (2.0 * square);
        if (at > 0.0 && at < 1.0) see(a + at * (b - a));
      }
    }
  }

  // With room for rounding.
  [[nodiscard]] NumberWithin within() const {
    constexpr double rounding = 1e-12;
    NumberWithin result = within_;
    const double room = rounding * std::max(std::abs(result.least), std::abs(result.most));
    result.least -= room;
    result.most += room;
    result.below -= room;
    result.above += room;
    return result;
  }

 private:
  const tables::VaryingNumber& number_;
  mesh::Point origin_;
  mesh::Point slope_{0.0, 0.0};
  NumberWithin within_;
};

// Where a raster is bilinear: between the middles of its cells, and beyond the outer ones.
std::vector<double> lines_of(const tables::Samples& raster, std::size_t axis, double low,
                             double high) {
  const std::size_t count = axis == 0 ? raster.columns : raster.rows();
  std::vector<double> lines{-infinity};
  const double first = (low - raster.lower[axis]) / raster.step[axis];
  for (double k = std::max(0.0, std::floor(first)); k < static_cast<double>(count); k += 1.0) {
    const double line = raster.lower[axis] + k * raster.step[axis];
    lines.push_back(line);
    if (line > high) break;
  }
  lines.push_back(infinity);
  return lines;
}

void see_raster(const tables::Samples& raster, const Polygon& triangle, Collector& collector) {
  const auto [left, right] =
      std::ranges::minmax(triangle, {}, [](const mesh::Point& p) { return p.x(); });
  const auto [low, high] =
      std::ranges::minmax(triangle, {}, [](const mesh::Point& p) { return p.y(); });
  const auto uprights = lines_of(raster, 0, left.x(), right.x());
  const auto levels = lines_of(raster, 1, low.y(), high.y());
  for (std::size_t i = 0; i + 1 < uprights.size(); ++i) {
    const Polygon column = part_between(triangle, 0, uprights[i], uprights[i + 1]);
    for (std::size_t j = 0; j + 1 < levels.size() && !column.empty(); ++j) {
      collector.see_all(part_between(column, 1, levels[j], levels[j + 1]));
    }
  }
}

void see_table(const tables::Samples& table, const Polygon& triangle, Collector& collector) {
  const auto axis = static_cast<Eigen::Index>(table.axis);
  for (const double line : table.coordinates) {
    for (const mesh::Point& place : part_between(triangle, axis, line, line)) collector.see(place);
  }
}

// How much of a triangle, or of a line, is in a part of it.
double measure(const Polygon& part, bool is_line) {
  double area = 0.0, length = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const mesh::Point one = part[i] - part[0], next = part[(i + 1) % part.size()] - part[0];
    area += 0.5 * (one.x() * next.y() - one.y() * next.x());
    length = std::max(length, one.norm());
  }
  return is_line ? length : std::abs(area);
}

// Of one value in each cell: what is in the triangle, not what only touches it.
NumberWithin within_cells(const tables::Samples& raster,
                          const std::array<mesh::Point, 3>& corners) {
  const Polygon triangle(corners.begin(), corners.end());
  const bool is_line = corners[1] == corners[2];
  constexpr double rounding = 1e-12;
  const double nothing = rounding * measure(triangle, is_line);
  const auto [left, right] =
      std::ranges::minmax(triangle, {}, [](const mesh::Point& p) { return p.x(); });
  const auto [low, high] =
      std::ranges::minmax(triangle, {}, [](const mesh::Point& p) { return p.y(); });
  NumberWithin within;
  within.least = infinity;
  within.most = -infinity;
  for (std::size_t i = raster.cell(0, left.x()); i <= raster.cell(0, right.x()); ++i) {
    const auto across = raster.ends_of_cell(0, i);
    const Polygon column = part_between(triangle, 0, across[0], across[1]);
    for (std::size_t j = raster.cell(1, low.y()); j <= raster.cell(1, high.y()); ++j) {
      const auto up = raster.ends_of_cell(1, j);
      if (column.empty() || measure(part_between(column, 1, up[0], up[1]), is_line) <= nothing) {
        continue;
      }
      within.least = std::min(within.least, raster.values[j * raster.columns + i]);
      within.most = std::max(within.most, raster.values[j * raster.columns + i]);
    }
  }
  within.corner.fill(within.least);
  within.above = within.most - within.least;
  return within;
}

// Whatever is nearest to a place is no farther from the middle than twice the radius more than what
// is nearest to that.
NumberWithin within_points(const tables::Samples& points,
                           const std::array<mesh::Point, 3>& corners) {
  const mesh::Point middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  double radius = 0.0, nearest = infinity;
  for (const mesh::Point& corner : corners) radius = std::max(radius, (corner - middle).norm());
  const auto distance = [&](std::size_t i) {
    const auto place = points.place(i);
    return (mesh::Point(place[0], place[1]) - middle).norm();
  };
  for (std::size_t i = 0; i < points.values.size(); ++i) nearest = std::min(nearest, distance(i));
  constexpr double more = 1.0 + 1e-12;
  NumberWithin within;
  within.least = infinity;
  within.most = -infinity;
  for (std::size_t i = 0; i < points.values.size(); ++i) {
    if (distance(i) > more * (nearest + 2.0 * radius)) continue;
    within.least = std::min(within.least, points.values[i]);
    within.most = std::max(within.most, points.values[i]);
  }
  within.corner.fill(within.least);
  within.above = within.most - within.least;
  return within;
}

}  // namespace

NumberWithin number_within(const tables::VaryingNumber& number,
                           const std::array<mesh::Point, 3>& corners) {
  using Kind = tables::Samples::Kind;
  if (number.samples && number.samples->kind == Kind::points) {
    return within_points(*number.samples, corners);
  }
  if (number.samples && number.samples->jumps()) return within_cells(*number.samples, corners);
  Collector collector(number, corners);
  const Polygon triangle(corners.begin(), corners.end());
  for (const mesh::Point& corner : corners) collector.see(corner);
  if (number.samples && number.samples->kind == Kind::table) {
    see_table(*number.samples, triangle, collector);
  } else if (number.samples) {
    see_raster(*number.samples, triangle, collector);
  }
  return collector.within();
}

problem::Variation::Strength GroundVariation::at(const mesh::Point& place) const {
  return {value_at(cohesion_, place), value_at(friction_angle_, place) * std::numbers::pi / 180.0};
}

problem::Variation::Within GroundVariation::within(
    const std::array<mesh::Point, 3>& corners) const {
  const NumberWithin cohesion = number_within(cohesion_, corners);
  Within within{cohesion.corner, cohesion.below, cohesion.above, cohesion.least, cohesion.most};
  constexpr double degree = std::numbers::pi / 180.0;
  within.gentlest = within.steepest = friction_angle_.value * degree;
  if (!friction_angle_.varies()) return within;
  const NumberWithin friction = number_within(friction_angle_, corners);
  within.gentlest = friction.least * degree;
  within.steepest = friction.most * degree;
  return within;
}

}  // namespace limit::ground

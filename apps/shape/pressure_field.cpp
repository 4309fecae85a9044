#include "shape/pressure_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "shape/ring.hpp"
#include "shape/triangulation.hpp"

namespace shape {
namespace {

namespace index = boost::geometry::index;
using Place = boost::geometry::model::d2::point_xy<double>;
using Box = boost::geometry::model::box<Place>;
using Entry = std::pair<Box, int>;
using Triangles = std::vector<std::array<int, 3>>;
using Kind = tables::Samples::Kind;

constexpr double infinity = std::numeric_limits<double>::infinity();

// Of places: outward . place <= reach.
struct HalfPlane {
  Point outward;
  double reach = 0.0;
};

// What of a convex polygon is in a half plane.
Ring cut(const Ring& polygon, const HalfPlane& half) {
  Ring left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double first = half.outward.dot(from) - half.reach;
    const double second = half.outward.dot(to) - half.reach;
    if (first <= 0.0) left.push_back(from);
    if ((first < 0.0 && second > 0.0) || (first > 0.0 && second < 0.0)) {
      left.push_back(from + first / (first - second) * (to - from));
    }
  }
  return left;
}

// Linear: the value at a place and how it grows from there.
struct Plane {
  Point place = Point::Zero();
  double value = 0.0;
  Point gradient = Point::Zero();

  [[nodiscard]] double at(const Point& other) const { return value + gradient.dot(other - place); }
};

// The dry and the wet piece of a part of a polygon, in which a plane is the pressure.
void add_pieces(const Ring& part, const Plane& plane, std::vector<PressureField::Piece>& pieces) {
  const auto add = [&](Ring ring, bool wet) {
    if (ring.size() < 3) return;
    const double area = std::abs(signed_area(ring));
    if (area == 0.0) return;
    PressureField::Piece& piece = pieces.emplace_back();
    piece.ring = std::move(ring);
    piece.area = area;
    piece.wet = wet;
    if (!wet) return;
    piece.value = plane.at(piece.ring.front());
    piece.gradient = plane.gradient;
  };
  const double zero = plane.gradient.dot(plane.place) - plane.value;  // gradient . place there
  if (plane.gradient.isZero(0.0)) {
    add(part, plane.value > 0.0);
    return;
  }
  add(cut(part, {-plane.gradient, -zero}), true);
  add(cut(part, {plane.gradient, zero}), false);
}

Triangles squares_in_two(const tables::Samples& raster) {
  Triangles triangles;
  const auto columns = static_cast<int>(raster.columns), rows = static_cast<int>(raster.rows());
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      const int first = row * columns + column, above = first + columns;
      triangles.push_back({first, first + 1, above + 1});
      triangles.push_back({first, above + 1, above});
    }
  }
  return triangles;
}

std::vector<Point> places_of(const tables::Samples& samples) {
  std::vector<Point> places;
  places.reserve(samples.values.size());
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    const auto place = samples.place(i);
    places.emplace_back(place[0], place[1]);
  }
  return places;
}

// The nearest place of a triangle.
Point nearest_in(const std::array<Point, 3>& corners, const Point& place) {
  Point nearest = corners[0];
  bool inside = true;
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &from = corners[i], &to = corners[(i + 1) % 3];
    inside = inside && cross(to - from, place - from) >= 0.0;
    const double share =
        std::clamp((place - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
    const Point here = from + share * (to - from);
    if ((here - place).squaredNorm() < least) {
      nearest = here;
      least = (here - place).squaredNorm();
    }
  }
  return inside ? place : nearest;
}

}  // namespace

struct PressureField::Parts {
  tables::VaryingNumber told;
  std::vector<Point> places;  // of samples that triangles lie between
  Triangles triangles;
  index::rtree<Entry, index::quadratic<16>> boxes;
  double extent = 0.0;

  [[nodiscard]] bool has_triangles() const {
    return told.samples && told.samples->kind != Kind::table;
  }
  [[nodiscard]] std::array<Point, 3> corners(int triangle) const {
    const auto& nodes = triangles[static_cast<std::size_t>(triangle)];
    const auto place = [&](int node) { return places[static_cast<std::size_t>(node)]; };
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  }
  [[nodiscard]] Plane plane(int triangle) const {
    const auto& nodes = triangles[static_cast<std::size_t>(triangle)];
    const auto value = [&](std::size_t i) {
      return told.samples->values[static_cast<std::size_t>(nodes[i])];
    };
    const auto at = corners(triangle);
    const Point first = at[1] - at[0], second = at[2] - at[0];
    const double up_first = value(1) - value(0), up_second = value(2) - value(0);
    const Point gradient = Point(up_first * second.y() - up_second * first.y(),
                                 up_second * first.x() - up_first * second.x()) /
                           cross(first, second);
    return {at[0], value(0), gradient};
  }
  // The nearest of the triangles whose boxes meet a box, and how far it is.
  [[nodiscard]] std::pair<int, double> nearest_in_box(const Point& place, const Box& box) const {
    std::pair<int, double> best(-1, infinity);
    for (auto it = boxes.qbegin(index::intersects(box)); it != boxes.qend(); ++it) {
      const double distance = (nearest_in(corners(it->second), place) - place).norm();
      if (distance < best.second || (distance == best.second && it->second < best.first)) {
        best = {it->second, distance};
      }
    }
    return best;
  }
  // The triangle nearest to a place, and how far it is.
  [[nodiscard]] std::pair<int, double> nearest(const Point& place) const {
    const Place here(place.x(), place.y());
    auto best = nearest_in_box(place, Box(here, here));
    if (best.second == 0.0) return best;
    // No further than that of the nearest box.
    std::vector<Entry> found;
    boxes.query(index::nearest(here, 1), std::back_inserter(found));
    const double reach =
        std::min(best.second, (nearest_in(corners(found.front().second), place) - place).norm());
    return nearest_in_box(place, Box(Place(place.x() - reach, place.y() - reach),
                                     Place(place.x() + reach, place.y() + reach)));
  }
};

PressureField::PressureField(const tables::VaryingNumber& told)
    : parts_(std::make_unique<Parts>()) {
  parts_->told = told;
  if (!parts_->has_triangles()) return;
  Parts& parts = *parts_;
  parts.places = places_of(*told.samples);
  parts.triangles = told.samples->kind == Kind::raster ? squares_in_two(*told.samples)
                                                       : triangles_between(parts.places);
  std::vector<Entry> entries;
  entries.reserve(parts.triangles.size());
  for (std::size_t t = 0; t < parts.triangles.size(); ++t) {
    const auto at = parts.corners(static_cast<int>(t));
    const Point low = at[0].cwiseMin(at[1]).cwiseMin(at[2]);
    const Point high = at[0].cwiseMax(at[1]).cwiseMax(at[2]);
    entries.emplace_back(Box(Place(low.x(), low.y()), Place(high.x(), high.y())),
                         static_cast<int>(t));
  }
  parts.boxes = decltype(parts.boxes)(entries);
  for (const Point& place : parts.places) {
    parts.extent = std::max(parts.extent, (place - parts.places.front()).norm());
  }
}

PressureField::~PressureField() = default;
PressureField::PressureField(PressureField&&) noexcept = default;
PressureField& PressureField::operator=(PressureField&&) noexcept = default;

bool PressureField::has_nothing() const {
  return parts_->has_triangles() && parts_->triangles.empty();
}

double PressureField::at(const Point& place) const {
  const Parts& parts = *parts_;
  if (!parts.has_triangles()) {
    return std::max(0.0, parts.told.at_place(std::array{place.x(), place.y()}));
  }
  const int triangle = parts.nearest(place).first;
  return std::max(0.0, parts.plane(triangle).at(nearest_in(parts.corners(triangle), place)));
}

bool PressureField::has_triangles() const {
  return parts_->has_triangles();
}

double PressureField::largest() const {
  const auto& told = parts_->told;
  return told.samples ? std::max(0.0, std::ranges::max(told.samples->values))
                      : std::max(0.0, told.value);
}

std::vector<Point> PressureField::kinks(const Point& from, const Point& to) const {
  // A line is the middle of a strip, as narrow as rounding lets it be.
  const Point along = to - from;
  constexpr double narrow = 1e-9;
  const Point aside = narrow * Point(-along.y(), along.x());
  std::vector<double> shares{0.0, 1.0};
  for (const Piece& piece : within({from - aside, to - aside, to + aside, from + aside})) {
    for (const Point& corner : piece.ring) {
      shares.push_back(std::clamp((corner - from).dot(along) / along.squaredNorm(), 0.0, 1.0));
    }
  }
  std::ranges::sort(shares);
  std::vector<std::pair<double, double>> values;
  for (const double share : shares) values.emplace_back(share, at(from + share * along));
  std::vector<Point> found;
  constexpr double rounding = 1e-6;
  const double slack = rounding * largest();
  // Between two places that are kept, the one that comes off most is kept, too.
  const auto divide = [&](const auto& self, std::size_t first, std::size_t last) -> void {
    std::size_t furthest = first;
    double most = slack;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double width = values[last].first - values[first].first;
      const double share = width > 0.0 ? (values[i].first - values[first].first) / width : 0.0;
      const double linear = (1.0 - share) * values[first].second + share * values[last].second;
      if (std::abs(values[i].second - linear) <= most) continue;
      most = std::abs(values[i].second - linear);
      furthest = i;
    }
    if (furthest == first) return;
    self(self, first, furthest);
    found.push_back(from + values[furthest].first * along);
    self(self, furthest, last);
  };
  divide(divide, 0, values.size() - 1);
  return found;
}

bool PressureField::covers(const Point& place) const {
  const Parts& parts = *parts_;
  constexpr double rounding = 1e-6;  // of coordinates in a file
  if (parts.has_triangles()) return parts.nearest(place).second <= rounding * parts.extent;
  if (!parts.told.samples) return true;
  const auto [low, high] = parts.told.samples->coverage();
  const std::size_t axis = parts.told.samples->axis;
  const double here = place[static_cast<Eigen::Index>(axis)];
  const double slack = rounding * (high[axis] - low[axis]);
  return here >= low[axis] - slack && here <= high[axis] + slack;
}

std::vector<PressureField::Piece> PressureField::within(const Ring& polygon) const {
  const Parts& parts = *parts_;
  std::vector<Piece> pieces;
  if (parts.has_triangles()) {
    Point low = polygon.front(), high = low;
    for (const Point& corner : polygon) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const Box box(Place(low.x(), low.y()), Place(high.x(), high.y()));
    std::vector<int> found;
    for (auto it = parts.boxes.qbegin(index::intersects(box)); it != parts.boxes.qend(); ++it) {
      found.push_back(it->second);
    }
    std::ranges::sort(found);
    for (const int triangle : found) {
      const auto at = parts.corners(triangle);
      Ring part = polygon;
      for (std::size_t i = 0; i < 3 && !part.empty(); ++i) {
        const Point along = at[(i + 1) % 3] - at[i];
        const Point outward(along.y(), -along.x());
        part = cut(part, {outward, outward.dot(at[i])});
      }
      add_pieces(part, parts.plane(triangle), pieces);
    }
    return pieces;
  }
  if (!parts.told.samples) {
    const tables::VaryingNumber& told = parts.told;
    add_pieces(polygon,
               {{told.at[0], told.at[1]}, told.value, {told.gradient[0], told.gradient[1]}},
               pieces);
    return pieces;
  }
  const tables::Samples& table = *parts.told.samples;
  const auto axis = static_cast<Eigen::Index>(table.axis);
  Point along = Point::Zero();
  along[axis] = 1.0;
  const auto& lines = table.coordinates;
  // Beyond its ends a table goes on with its last values.
  for (std::size_t i = 0; i <= lines.size(); ++i) {
    Ring part = polygon;
    if (i > 0) part = cut(part, {-along, -lines[i - 1]});
    if (i < lines.size()) part = cut(part, {along, lines[i]});
    const std::size_t from = i > 0 ? i - 1 : 0;
    Plane plane{lines[from] * along, table.values[from]};
    if (i > 0 && i < lines.size()) {
      plane.gradient = (table.values[i] - table.values[from]) / (lines[i] - lines[from]) * along;
    }
    add_pieces(part, plane, pieces);
  }
  return pieces;
}

namespace {

// Water whose pressure is less the deeper it is nowhere is: a sign has slipped.
void warn_of_rise(const PressureField& field, const Ring& corners, const std::string& key,
                  tables::Diagnosis& diagnosis) {
  Point low = corners.front(), high = low;
  for (const Point& corner : corners) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  constexpr double rounding = 1e-9;
  const double slack = rounding * field.largest() / (high - low).norm();
  bool rises = false;
  for (const auto& piece : field.within({low, {high.x(), low.y()}, high, {low.x(), high.y()}})) {
    if (piece.gradient.y() < -slack) return;
    rises = rises || piece.gradient.y() > slack;
  }
  if (!rises) return;
  diagnosis.warning(key, "found a pressure that grows upwards wherever there is any",
                    "at rest water presses the more, the deeper it is, by some -10 kN/m3 along y, "
                    "which points upwards: has a sign slipped?");
}

}  // namespace

bool is_pressure_of(const tables::VaryingNumber& told, const Ring& corners, const std::string& key,
                    tables::Diagnosis& diagnosis) {
  const bool is_raster = told.samples && told.samples->kind == Kind::raster;
  if (is_raster && (told.samples->columns < 2 || told.samples->rows() < 2)) {
    diagnosis.error(key, "found a raster of one row or column",
                    "allowed are two rows and columns or more; along one axis give a table");
    return false;
  }
  if (is_raster && told.samples->nearest) {
    diagnosis.error(key, "found a raster of one value in each cell",
                    "the gradient of the pressure is a force: allowed is a raster that is linear "
                    "between its values, without nearest");
    return false;
  }
  const PressureField field(told);
  if (field.has_nothing()) {
    diagnosis.error(key, "found points on one line, or less than three",
                    "allowed are points around the ground; along one axis give a table");
    return false;
  }
  for (const Point& corner : corners) {
    if (field.covers(corner)) continue;
    diagnosis.error(key,
                    fmt::format("told of nothing at ({:.6g}, {:.6g}), a corner of the ground",
                                corner.x(), corner.y()),
                    is_raster ? "allowed are values all over the ground, between the middles of "
                                "the raster's outermost cells"
                              : "allowed are values all over the ground, up to its corners");
    return false;
  }
  std::vector<std::array<double, 2>> places;
  for (const Point& corner : corners) places.push_back({corner.x(), corner.y()});
  const auto [least, most] = told.extremes(places);
  if (most > 0.0 || least >= 0.0) {
    warn_of_rise(field, corners, key, diagnosis);
    return true;
  }
  diagnosis.error(key, fmt::format("found nothing above zero, but {:g}", least),
                  "water presses with more than zero; less, suction, counts as none");
  return false;
}

}  // namespace shape

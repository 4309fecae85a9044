#include "shape/body.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/multi_linestring.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace shape {
namespace {

namespace geometry = boost::geometry;
using Corner = geometry::model::d2::point_xy<double>;
using Polygon = geometry::model::polygon<Corner, false, true>;  // counter-clockwise, closed
using Polygons = geometry::model::multi_polygon<Polygon>;
using Box = geometry::model::box<Corner>;
using Line = geometry::model::linestring<Corner>;
using Lines = geometry::model::multi_linestring<Line>;
using Segment = geometry::model::segment<Corner>;

Corner corner(const Point& p) {
  return {p.x(), p.y()};
}
Point point(const Corner& c) {
  return {c.x(), c.y()};
}

Polygon polygon_of(const Ring& ring) {
  Polygon polygon;
  for (const Point& p : ring) geometry::append(polygon.outer(), corner(p));
  geometry::correct(polygon);  // closed, counter-clockwise
  return polygon;
}

}  // namespace

struct Body::Shape {
  Point lower, upper;
  double slack = 0.0;  // [m] round-off of coordinates
  Polygons polygons;
  std::vector<SurfaceSegment> surface;

  // The face of the box that a segment is on; 0 for none.
  int face_at(const Point& from, const Point& to) const {
    const auto on = [&](int axis, double position) {
      return std::abs(from[axis] - position) <= slack && std::abs(to[axis] - position) <= slack;
    };
    if (on(0, lower[0])) return -1;
    if (on(0, upper[0])) return -2;
    if (on(1, lower[1])) return -3;
    return on(1, upper[1]) ? -4 : 0;
  }

  void add_surface(const Polygon::ring_type& ring, const std::vector<Polygon>& rings) {
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
      SurfaceSegment segment{point(ring[k]), point(ring[k + 1]), 0};
      if ((segment.to - segment.from).norm() <= slack) continue;
      segment.source = face_at(segment.from, segment.to);
      if (segment.source == 0) segment.source = nearest_cut(segment, rings);
      surface.push_back(segment);
    }
  }

  static int nearest_cut(const SurfaceSegment& segment, const std::vector<Polygon>& rings) {
    const Corner middle = corner(0.5 * (segment.from + segment.to));
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < rings.size(); ++i) {
      Line line(rings[i].outer().begin(), rings[i].outer().end());
      const double distance = geometry::distance(middle, line);
      if (distance >= least) continue;
      least = distance;
      nearest = static_cast<int>(i);
    }
    return nearest;
  }

  // Whether the surface passes through a box; else the box is inside or outside as a whole.
  bool is_cut(const Box& box) const {
    return std::ranges::any_of(surface, [&](const SurfaceSegment& s) {
      if (std::max(s.from.x(), s.to.x()) < box.min_corner().x() ||
          std::min(s.from.x(), s.to.x()) > box.max_corner().x() ||
          std::max(s.from.y(), s.to.y()) < box.min_corner().y() ||
          std::min(s.from.y(), s.to.y()) > box.max_corner().y()) {
        return false;
      }
      return geometry::intersects(Segment(corner(s.from), corner(s.to)), box);
    });
  }
};

Ring circle(const Point& centre, double radius, double sagitta) {
  constexpr int fewest = 16;
  constexpr double most = 1e5;
  // A chord of a circle is radius (1 - cos(half its angle)) away from it.
  const double half = std::acos(std::max(0.0, 1.0 - sagitta / radius));
  const int count =
      std::max(fewest, static_cast<int>(std::min(most, std::ceil(std::numbers::pi / half))));
  Ring ring;
  for (int k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    ring.push_back(centre + radius * Point(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

std::string objection(const Ring& ring) {
  constexpr std::size_t fewest = 3;
  if (ring.size() < fewest) return "it has fewer than three corners";
  for (const Point& p : ring) {
    if (!p.allFinite()) return "a corner is not finite";
  }
  const Polygon polygon = polygon_of(ring);
  if (geometry::intersects(polygon.outer())) return "it crosses or touches itself";
  std::string reason;
  return geometry::is_valid(polygon, reason) ? "" : reason;
}

Body::Body(const Point& lower, const Point& upper, const std::vector<Cut>& cuts)
    : shape_(std::make_unique<Shape>()) {
  constexpr double round_off = 1e-12;
  shape_->lower = lower;
  shape_->upper = upper;
  shape_->slack =
      round_off * std::max((upper - lower).maxCoeff(),
                           std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff()));
  geometry::convert(Box(corner(lower), corner(upper)), shape_->polygons.emplace_back());
  std::vector<Polygon> rings;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (const std::string why = objection(cuts[i].ring); !why.empty()) {
      throw std::invalid_argument("cut " + std::to_string(i) + ": " + why);
    }
    rings.push_back(polygon_of(cuts[i].ring));
    Polygons left;
    if (cuts[i].outside) {
      geometry::intersection(shape_->polygons, rings.back(), left);
    } else {
      geometry::difference(shape_->polygons, rings.back(), left);
    }
    shape_->polygons = std::move(left);
  }
  for (const Polygon& polygon : shape_->polygons) {
    shape_->add_surface(polygon.outer(), rings);
    for (const auto& hole : polygon.inners()) shape_->add_surface(hole, rings);
  }
}

Body::~Body() = default;
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;

double Body::area() const {
  return geometry::area(shape_->polygons);
}

std::size_t Body::pieces() const {
  return shape_->polygons.size();
}

const std::vector<SurfaceSegment>& Body::surface() const {
  return shape_->surface;
}

Part Body::within(const Point& lower, const Point& upper) const {
  const Box box(corner(lower), corner(upper));
  const Point middle = 0.5 * (lower + upper);
  if (!shape_->is_cut(box)) {
    const bool inside = geometry::within(corner(middle), shape_->polygons);
    return {inside ? (upper - lower).prod() : 0.0, middle};
  }
  Polygon whole;
  geometry::convert(box, whole);
  Polygons parts;
  geometry::intersection(shape_->polygons, whole, parts);
  // Measured from the middle, so that digits are those of the box.
  Part part;
  for (const Polygon& each : parts) {
    const double area = geometry::area(each);
    if (!(area > 0.0)) continue;
    Corner centroid(0.0, 0.0);
    geometry::centroid(each, centroid);
    part.area += area;
    part.centroid += area * (point(centroid) - middle);
  }
  part.centroid = part.area > 0.0 ? Point(middle + part.centroid / part.area) : middle;
  return part;
}

Stretch Body::along(const Point& from, const Point& to) const {
  Lines inside;
  geometry::intersection(Line{corner(from), corner(to)}, shape_->polygons, inside);
  Stretch stretch;
  for (const Line& line : inside) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Point a = point(line[k]), b = point(line[k + 1]);
      const double length = (b - a).norm();
      stretch.length += length;
      stretch.middle += 0.5 * length * (a + b);
    }
  }
  if (stretch.length > 0.0) stretch.middle /= stretch.length;
  return stretch;
}

double Body::distance_to_cuts(const Point& lower, const Point& upper) const {
  const Box box(corner(lower), corner(upper));
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceSegment& s : shape_->surface) {
    if (s.source < 0) continue;
    // A bound first: most segments are further away than one before.
    const Point apart = (lower - s.from.cwiseMax(s.to)).cwiseMax(s.from.cwiseMin(s.to) - upper);
    if (apart.maxCoeff() >= least) continue;
    least = std::min(least, geometry::distance(Segment(corner(s.from), corner(s.to)), box));
  }
  return least;
}

}  // namespace shape

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
#include <utility>

#include "shape/outline.hpp"

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

// An edge of a region before anything was cut out of it.
struct Edge {
  Point from, to;
  int side = -1;
  int other = -1;  // region beyond it
  bool hollow = false;
};

// A region with its edges, after the cuts.
struct Region {
  std::vector<Edge> edges;
  Polygons polygons;
  std::vector<std::pair<Point, Point>> rings;  // all straight pieces around it

  // Whether its rings pass through a box; else the box is inside or outside as a whole.
  bool is_cut(const Box& box) const {
    return std::ranges::any_of(rings, [&](const auto& piece) {
      const Point low = piece.first.cwiseMin(piece.second);
      const Point high = piece.first.cwiseMax(piece.second);
      if (high.x() < box.min_corner().x() || low.x() > box.max_corner().x() ||
          high.y() < box.min_corner().y() || low.y() > box.max_corner().y()) {
        return false;
      }
      return geometry::intersects(Segment(corner(piece.first), corner(piece.second)), box);
    });
  }
};

// What of a polygon is on the side of a line across an axis that has `sign` times more than `limit`
// (Sutherland & Hodgman 1974). Pieces that the line parts stay joined along it, which adds no area.
Ring cut_off(const Ring& ring, int axis, double limit, double sign) {
  Ring kept;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point &from = ring[k], &to = ring[(k + 1) % ring.size()];
    const double before = sign * (from[axis] - limit), after = sign * (to[axis] - limit);
    if (before >= 0.0) kept.push_back(from);
    if ((before > 0.0 && after < 0.0) || (before < 0.0 && after > 0.0)) {
      Point crossing = from + before / (before - after) * (to - from);
      crossing[axis] = limit;
      kept.push_back(crossing);
    }
  }
  return kept;
}

// Adds what a ring has in a box: its area, negative of a hole, and first moment about the box's
// middle, so that digits are those of the box. Boost's intersection takes the whole ring for it
// where an edge goes through a corner of the box.
void add_part(const Polygon::ring_type& closed, const Point& lower, const Point& upper,
              Part& part) {
  Ring ring;
  const Point middle = 0.5 * (lower + upper);
  for (std::size_t k = 0; k + 1 < closed.size(); ++k) ring.push_back(point(closed[k]) - middle);
  for (const int axis : {0, 1}) {
    ring = cut_off(ring, axis, lower[axis] - middle[axis], 1.0);
    ring = cut_off(ring, axis, upper[axis] - middle[axis], -1.0);
  }
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point &a = ring[k], &b = ring[(k + 1) % ring.size()];
    const double twice = cross(a, b);
    part.area += 0.5 * twice;
    part.centroid += twice / 6.0 * (a + b);
  }
}

// Which segments of an outline turn towards the ground at both ends; a turn is more than round-off.
std::vector<char> hollows_of(const Outline& outline) {
  constexpr double round_off = 1e-6;
  std::vector<int> turns(outline.segments.size(), 0);
  for (std::size_t i = 0; i < outline.segments.size(); ++i) {
    for (std::size_t j = 0; j < outline.segments.size(); ++j) {
      const OutlineSegment &before = outline.segments[i], &after = outline.segments[j];
      if (before.right >= 0 || after.right >= 0 || before.second != after.first) continue;
      const Point in = (outline.at(before.second) - outline.at(before.first)).normalized();
      const Point out = (outline.at(after.second) - outline.at(after.first)).normalized();
      if (cross(in, out) >= -round_off) continue;
      ++turns[i];
      ++turns[j];
    }
  }
  std::vector<char> hollow;
  for (const int count : turns) hollow.push_back(count == 2 ? 1 : 0);
  return hollow;
}

double distance_of(const Point& place, const Point& from, const Point& to) {
  return geometry::distance(corner(place), Segment(corner(from), corner(to)));
}

}  // namespace

struct Body::Shape {
  Point lower, upper;
  double slack = 0.0;  // [m] round-off of coordinates
  std::vector<Region> regions;
  std::vector<Polygon> cuts;
  std::vector<SurfaceSegment> surface;
  std::vector<Joint> joints;

  Shape(const Point& low, const Point& high) : lower(low), upper(high) {
    constexpr double round_off = 1e-12;
    slack = round_off * std::max((upper - lower).maxCoeff(), std::max(lower.cwiseAbs().maxCoeff(),
                                                                      upper.cwiseAbs().maxCoeff()));
  }

  void take(const std::vector<Cut>& given) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (const std::string why = objection(given[i].ring); !why.empty()) {
        throw std::invalid_argument("cut " + std::to_string(i) + ": " + why);
      }
      cuts.push_back(polygon_of(given[i].ring));
      for (Region& region : regions) {
        Polygons left;
        if (given[i].outside) {
          geometry::intersection(region.polygons, cuts.back(), left);
        } else {
          geometry::difference(region.polygons, cuts.back(), left);
        }
        region.polygons = std::move(left);
      }
    }
    for (std::size_t r = 0; r < regions.size(); ++r) {
      for (const Polygon& polygon : regions[r].polygons) {
        add_ring(polygon.outer(), static_cast<int>(r));
        for (const auto& hole : polygon.inners()) add_ring(hole, static_cast<int>(r));
      }
    }
  }

  // The face of the box that a segment is on; -1 for none.
  int face_at(const Point& from, const Point& to) const {
    const auto on = [&](int axis, double position) {
      return std::abs(from[axis] - position) <= slack && std::abs(to[axis] - position) <= slack;
    };
    if (on(0, lower[0])) return 0;
    if (on(0, upper[0])) return 1;
    if (on(1, lower[1])) return 2;
    return on(1, upper[1]) ? 3 : -1;
  }

  void add_ring(const Polygon::ring_type& ring, int r) {
    Region& region = regions[static_cast<std::size_t>(r)];
    for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
      const Point from = point(ring[k]), to = point(ring[k + 1]);
      if ((to - from).norm() <= slack) continue;
      region.rings.emplace_back(from, to);
      const Point middle = 0.5 * (from + to);
      const Edge* const edge = nearest_edge(region, middle);
      const auto [cut, to_cut] = nearest_cut(middle);
      SurfaceSegment segment{from, to, -1, -1, face_at(from, to), r};
      if (to_cut < distance_of(middle, edge->from, edge->to) && segment.face < 0) {
        segment.cut = cut;
      } else if (edge->other >= 0) {
        if (r < edge->other) joints.push_back({from, to, r, edge->other});
        continue;
      } else {
        segment.side = edge->side;
        segment.hollow = edge->hollow;
      }
      surface.push_back(segment);
    }
  }

  static const Edge* nearest_edge(const Region& region, const Point& place) {
    return &*std::ranges::min_element(
        region.edges, {}, [&](const Edge& edge) { return distance_of(place, edge.from, edge.to); });
  }

  std::pair<int, double> nearest_cut(const Point& place) const {
    std::pair<int, double> nearest{-1, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const Line line(cuts[i].outer().begin(), cuts[i].outer().end());
      const double distance = geometry::distance(corner(place), line);
      if (distance < nearest.second) nearest = {static_cast<int>(i), distance};
    }
    return nearest;
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
    : shape_(std::make_unique<Shape>(lower, upper)) {
  Region& box = shape_->regions.emplace_back();
  geometry::convert(Box(corner(lower), corner(upper)), box.polygons.emplace_back());
  const auto& ring = box.polygons.front().outer();
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
    box.edges.push_back({point(ring[k]), point(ring[k + 1])});
  }
  shape_->take(cuts);
}

Body::Body(const Outline& outline, const Point& lower, const Point& upper,
           const std::vector<Cut>& cuts)
    : shape_(std::make_unique<Shape>(lower, upper)) {
  for (std::size_t r = 0; r < outline.regions.size(); ++r) {
    const std::vector<Ring> rings = outline.rings(r);
    Polygon polygon = polygon_of(rings.front());
    for (std::size_t hole = 1; hole < rings.size(); ++hole) {
      polygon.inners().push_back(polygon_of(rings[hole]).outer());
    }
    geometry::correct(polygon);  // holes clockwise
    shape_->regions.emplace_back().polygons.push_back(std::move(polygon));
  }
  const std::vector<char> hollow = hollows_of(outline);
  for (std::size_t k = 0; k < outline.segments.size(); ++k) {
    const OutlineSegment& segment = outline.segments[k];
    const Point &from = outline.at(segment.first), &to = outline.at(segment.second);
    const auto edges_of = [&](int r) -> auto& {
      return shape_->regions[static_cast<std::size_t>(r)].edges;
    };
    edges_of(segment.left).push_back({from, to, segment.side, segment.right, hollow[k] != 0});
    if (segment.right >= 0) edges_of(segment.right).push_back({to, from, -1, segment.left});
  }
  shape_->take(cuts);
}

Body::~Body() = default;
Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;

double Body::area() const {
  double area = 0.0;
  for (const Region& region : shape_->regions) area += geometry::area(region.polygons);
  return area;
}

std::size_t Body::pieces() const {
  std::vector<const Polygon*> all;
  std::vector<std::size_t> piece;
  for (const Region& region : shape_->regions) {
    for (const Polygon& polygon : region.polygons) {
      piece.push_back(all.size());
      all.push_back(&polygon);
    }
  }
  for (const Joint& joint : shape_->joints) {
    // Those that have the middle of the joint on their rings are one.
    const Corner middle = corner(0.5 * (joint.from + joint.to));
    std::vector<std::size_t> meet;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (geometry::distance(middle, *all[i]) <= shape_->slack) meet.push_back(piece[i]);
    }
    for (const std::size_t other : meet) std::ranges::replace(piece, other, meet.front());
  }
  std::ranges::sort(piece);
  return static_cast<std::size_t>(
      std::ranges::distance(piece.begin(), std::unique(piece.begin(), piece.end())));
}

int Body::regions() const {
  return static_cast<int>(shape_->regions.size());
}

const std::vector<SurfaceSegment>& Body::surface() const {
  return shape_->surface;
}

const std::vector<Joint>& Body::joints() const {
  return shape_->joints;
}

Part Body::within(const Point& lower, const Point& upper, int region) const {
  const Box box(corner(lower), corner(upper));
  const Point middle = 0.5 * (lower + upper);
  const Region& of = shape_->regions[static_cast<std::size_t>(region)];
  if (!of.is_cut(box)) {
    const bool inside = geometry::within(corner(middle), of.polygons);
    return {inside ? (upper - lower).prod() : 0.0, middle};
  }
  Part part;
  for (const Polygon& polygon : of.polygons) {
    add_part(polygon.outer(), lower, upper, part);
    for (const auto& hole : polygon.inners()) add_part(hole, lower, upper, part);
  }
  if (!(part.area > 0.0)) return {0.0, middle};
  part.centroid = middle + part.centroid / part.area;
  return part;
}

Stretch Body::along(const Point& from, const Point& to, int region) const {
  Lines inside;
  geometry::intersection(Line{corner(from), corner(to)},
                         shape_->regions[static_cast<std::size_t>(region)].polygons, inside);
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

double Body::distance_to_hollows(const Point& lower, const Point& upper) const {
  const Box box(corner(lower), corner(upper));
  double least = std::numeric_limits<double>::infinity();
  for (const SurfaceSegment& s : shape_->surface) {
    if (s.cut < 0 && !s.hollow) continue;
    // A bound first: most segments are further away than one before.
    const Point apart = (lower - s.from.cwiseMax(s.to)).cwiseMax(s.from.cwiseMin(s.to) - upper);
    if (apart.maxCoeff() >= least) continue;
    least = std::min(least, geometry::distance(Segment(corner(s.from), corner(s.to)), box));
  }
  return least;
}

double Body::distance_to_region(const Point& lower, const Point& upper, int region) const {
  return geometry::distance(Box(corner(lower), corner(upper)),
                            shape_->regions[static_cast<std::size_t>(region)].polygons);
}

double Body::thickness(int region) const {
  const Region& of = shape_->regions[static_cast<std::size_t>(region)];
  double perimeter = 0.0;
  for (const auto& [from, to] : of.rings) perimeter += (to - from).norm();
  return 2.0 * geometry::area(of.polygons) / perimeter;
}

}  // namespace shape

#include "limit/block/block_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace limit::block {

namespace {

constexpr double pi = std::numbers::pi;

mesh::Point towards(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

double cross(const mesh::Point& a, const mesh::Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// First moments, of x and y, of the triangle between the pole and a straight piece, both seen from
// the pole; positive where the piece runs counterclockwise at positive x or y.
mesh::Point moment_under(const mesh::Point& first, const mesh::Point& second) {
  return cross(first, second) / 6.0 * (first + second);
}

// The same of the sector under an arc, from its lower to its upper angle: of r^3 / 3 towards the
// angle.
mesh::Point moment_under(const problem::SpiralArc& arc) {
  const double g = 3.0 * arc.growth;
  const auto at = [&](double angle) -> mesh::Point {
    const mesh::Point e = towards(angle);
    return g * e + mesh::Point(e.y(), -e.x());
  };
  const double shrunk = std::exp(g * (arc.lower - arc.upper));
  return arc.radius * arc.radius * arc.radius / 3.0 / (1.0 + g * g) *
         (at(arc.upper) - shrunk * at(arc.lower));
}

// How far a spiral turns back (clockwise, from `angle` at `radius`) before it is outside of a
// facet; infinite if that is more than a whole turn. Where the distance from the facet has its
// extremes is known, and between two of them there is at most one zero.
double turn_to_leave(double inside, double normal_angle, double angle, double radius,
                     double growth) {
  // Distance over radius: inside + exp(-growth u) cos(w - u), w the angle less the normal's.
  const double w = angle - normal_angle, share = inside / radius;
  const auto distance = [&](double u) { return share + std::exp(-growth * u) * std::cos(w - u); };
  double extreme = std::fmod(w - std::atan(growth), pi);
  if (extreme <= 0.0) extreme += pi;
  const auto slope = [&](double u) {
    return std::exp(-growth * u) * (std::sin(w - u) - growth * std::cos(w - u));
  };
  double low = 0.0;
  while (low < 2.0 * pi) {
    double high = extreme;
    extreme += pi;
    if (slope((low + high) / 2.0) < 0.0 && distance(high) < 0.0) {
      double at_low = std::max(distance(low), 0.0), at_high = distance(high);
      if (at_low == 0.0 && low == 0.0) return 0.0;
      // Regula falsi, halving what stays (Illinois).
      for (int i = 0; i < 100 && high - low > 1e-15 * (1.0 + high); ++i) {
        const double share_of_high = at_low / (at_low - at_high);
        const double middle = low + share_of_high * (high - low);
        const double here = distance(middle);
        if (here == 0.0 || middle == low || middle == high) return middle;
        if (here > 0.0) {
          low = middle;
          at_low = here;
          at_high /= 2.0;
        } else {
          high = middle;
          at_high = here;
          at_low /= 2.0;
        }
      }
      return low;
    }
    low = high;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

problem::Problem mirrored(problem::Problem problem) {
  for (mesh::Point& node : problem.mesh.nodes) node.x() = -node.x();
  problem.pull.x() = -problem.pull.x();
  problem.live_pull.x() = -problem.live_pull.x();
  for (mesh::Triangle& triangle : problem.mesh.triangles) {
    std::swap(triangle.nodes[1], triangle.nodes[2]);
  }
  for (mesh::BoundaryEdge& edge : problem.mesh.boundary) std::swap(edge.first, edge.second);
  for (problem::Boundary& boundary : problem.boundaries) {
    boundary.shear_stress = -boundary.shear_stress;
    boundary.live_shear_stress = -boundary.live_shear_stress;
  }
  return problem;
}

BlockGround::BlockGround(problem::Problem problem, double least_length)
    : problem_(std::move(problem)), least_length_(least_length) {
  for (const mesh::Triangle& triangle : problem_.mesh.triangles) {
    triangles_.push_back({{}, triangle.region});
  }
  add_edges(mesh::edges_of(problem_.mesh));
  link_pieces();
  set_soils(std::vector<problem::Soil>(problem_.soils));
}

void BlockGround::set_soils(const std::vector<problem::Soil>& soils) {
  problem_.soils = soils;
  growth_.clear();
  for (const problem::Soil& one : soils) growth_.push_back(std::tan(one.friction_angle));
}

void BlockGround::add_edges(const std::vector<mesh::Edge>& edges) {
  const mesh::Mesh& mesh = problem_.mesh;
  const auto region = [&](int triangle) {
    return mesh.triangles[static_cast<std::size_t>(triangle)].region;
  };
  for (const mesh::Edge& edge : edges) {
    const mesh::Point &first = mesh.nodes[static_cast<std::size_t>(edge.first)],
                      &second = mesh.nodes[static_cast<std::size_t>(edge.second)];
    const mesh::Point along = (second - first).normalized();
    Facet facet;
    facet.normal = {-along.y(), along.x()};
    facet.across = edge.right;
    if (edge.right < 0) {
      facet.piece = static_cast<int>(pieces_.size());
      const problem::Boundary& side = problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
      const bool is_free =
          side.normal == problem::Known::traction && side.tangential == problem::Known::traction;
      pieces_.push_back({first, second, is_free, false});
      links_.push_back({edge.left, edge.boundary, -1, {}});
    } else {
      const problem::Soil &left = soil(region(edge.left)), &right = soil(region(edge.right));
      if (left.unit_weight != right.unit_weight ||
          left.live_unit_weight != right.live_unit_weight) {
        facet.seam = static_cast<int>(seams_.size());
        seams_.push_back({first, second, region(edge.left), region(edge.right)});
      }
    }
    const auto put = [&](int triangle, int node, const Facet& what) {
      const int corner = mesh::corner_of(mesh.triangles[static_cast<std::size_t>(triangle)], node);
      Facet& side =
          triangles_[static_cast<std::size_t>(triangle)].sides[static_cast<std::size_t>(corner)];
      side = what;
      side.offset = side.normal.dot(first);
      side.angle = std::atan2(side.normal.y(), side.normal.x());
    };
    put(edge.left, edge.first, facet);
    if (edge.right < 0) continue;
    facet.normal = -facet.normal;
    facet.across = edge.left;
    put(edge.right, edge.second, facet);
  }
}

void BlockGround::link_pieces() {
  const mesh::Mesh& mesh = problem_.mesh;
  std::map<std::pair<double, double>, std::size_t> begins;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    begins[{pieces_[i].first.x(), pieces_[i].first.y()}] = i;
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const std::size_t next = begins.at({pieces_[i].second.x(), pieces_[i].second.y()});
    links_[i].next = static_cast<int>(next);
    const mesh::Point before = (pieces_[i].second - pieces_[i].first).normalized();
    const mesh::Point after = (pieces_[next].second - pieces_[next].first).normalized();
    const auto region = [&](std::size_t piece) {
      return mesh.triangles[static_cast<std::size_t>(links_[piece].triangle)].region;
    };
    constexpr double straight = 1e-6;
    pieces_[next].is_corner = std::abs(cross(before, after)) > straight ||
                              links_[i].boundary != links_[next].boundary ||
                              region(i) != region(next);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const int node : mesh.triangles[t].nodes) {
      const mesh::Point& place = mesh.nodes[static_cast<std::size_t>(node)];
      const auto found = begins.find({place.x(), place.y()});
      if (found != begins.end()) links_[found->second].around.push_back(static_cast<int>(t));
    }
  }
}

// The one that the curve comes out of there.
std::optional<int> BlockGround::triangle_from(const LowEnd& end, const mesh::Point& place,
                                              const mesh::Point& back) const {
  const Piece& piece = links_[end.piece];
  if (end.share > 0.0) return piece.triangle;
  for (const int triangle : piece.around) {
    const auto& sides = triangles_[static_cast<std::size_t>(triangle)].sides;
    int enters = 0;
    for (const Facet& side : sides) {
      const double distance = side.normal.dot(place) - side.offset;
      const mesh::Point& normal = side.normal;
      // Away from the side opposite, and into the two that meet there.
      constexpr double touches = 1e-12;
      enters += distance > touches * (1.0 + std::abs(side.offset)) || normal.dot(back) > 0.0;
    }
    if (enters == 3) return triangle;
  }
  return std::nullopt;
}

double BlockGround::multiplier(const LowEnd& end) {
  constexpr double none = std::numeric_limits<double>::infinity();
  const OutlinePiece& ends = pieces_[end.piece];
  if (!ends.is_free || !(end.turn > 0.0) || !(end.turn < pi) || !(end.radius > 0.0)) return none;
  const mesh::Point along = (ends.second - ends.first).normalized();
  const mesh::Point low = ends.first + end.share * (ends.second - ends.first);
  const double cosine = std::cos(end.turn), sine = std::sin(end.turn);
  const mesh::Point back(cosine * along.x() - sine * along.y(),
                         sine * along.x() + cosine * along.y());
  const std::optional<int> triangle = triangle_from(end, low, back);
  if (!triangle) return none;
  // The curve turns clockwise about the pole as it goes back, and comes closer to it at an angle of
  // phi: back = -(growth e + e turned by a right angle) / norm, e from the pole to the end.
  const int region = triangles_[static_cast<std::size_t>(*triangle)].region;
  const double phi = std::atan(growth_[static_cast<std::size_t>(region)]);
  const double angle = std::atan2(back.y(), back.x()) + pi / 2.0 + phi;
  pole_ = low - end.radius * towards(angle);
  powers_ = {};
  arcs_.clear();
  crossings_.clear();
  const std::optional<int> last = follow(*triangle, angle, end.radius);
  if (!last || !pieces_[static_cast<std::size_t>(*last)].is_free) return none;
  const problem::SpiralArc& top = arcs_.back();
  const mesh::Point high =
      pole_ + top.radius * std::exp(top.growth * (top.lower - top.upper)) * towards(top.lower);
  if ((high - low).norm() < least_length_) return none;
  if (!add_outline(end.piece, low, static_cast<std::size_t>(*last), high)) return none;
  if (!is_seen_from_pole(end.piece, low, static_cast<std::size_t>(*last), high)) return none;
  add_seams();
  if (!(powers_.live > 0.0)) return none;
  const double multiplier = (powers_.dissipation - powers_.dead) / powers_.live;
  return std::isfinite(multiplier) && multiplier > 0.0 ? multiplier : none;
}

// Of a triangle, and how far the spiral turns till then. Mostly the side that its tangent leaves
// through, found by Newton; if that is not within the other two, whichever comes first.
std::pair<const BlockGround::Facet*, double> BlockGround::way_out(const Facets& triangle,
                                                                  double angle, double radius,
                                                                  double growth) const {
  const auto arm_after = [&](double turn) -> mesh::Point {
    return radius * std::exp(-growth * turn) * towards(angle - turn);
  };
  const auto way_at = [&](const mesh::Point& arm) {
    return mesh::Point(arm.y() - growth * arm.x(), -arm.x() - growth * arm.y());
  };
  const auto inside = [&](const Facet& side, const mesh::Point& arm) {
    return side.normal.dot(pole_ + arm) - side.offset;
  };
  const mesh::Point start = arm_after(0.0), way = way_at(start);
  const Facet* exit = nullptr;
  double turn = std::numeric_limits<double>::infinity();
  for (const Facet& side : triangle.sides) {
    const double approach = -side.normal.dot(way);
    if (!(approach > 0.0)) continue;
    const double estimate = inside(side, start) / approach;
    if (estimate >= turn) continue;
    turn = estimate;
    exit = &side;
  }
  constexpr double small = 0.5, exact = 1e-15, touches = 1e-12;
  bool is_found = exit != nullptr && turn > 0.0 && turn < small;
  mesh::Point arm = start;
  for (int i = 0; is_found && i < 8; ++i) {
    arm = arm_after(turn);
    const double change = inside(*exit, arm) / exit->normal.dot(way_at(arm));
    turn -= change;
    is_found = turn > 0.0 && turn < small;
    if (std::abs(change) <= exact) break;
  }
  const double tolerance = touches * radius;
  for (const Facet& side : triangle.sides) {
    is_found = is_found && inside(side, arm) > -tolerance;
  }
  if (is_found) return {exit, turn};
  exit = nullptr;
  turn = std::numeric_limits<double>::infinity();
  for (const Facet& side : triangle.sides) {
    const double distance = side.normal.dot(pole_) - side.offset;
    const double leaves = turn_to_leave(distance, side.angle, angle, radius, growth);
    if (leaves >= turn) continue;
    turn = leaves;
    exit = &side;
  }
  return {exit, turn};
}

// Back along the spiral through one triangle after the other; the piece of outline it ends at.
std::optional<int> BlockGround::follow(int triangle, double angle, double radius) {
  const double begin = angle;
  // One that only touches a corner or a side is of no use.
  int standing = 0;
  constexpr int most_standing = 4;
  const std::size_t most = 4 * triangles_.size();
  for (std::size_t count = 0; count < most && standing < most_standing; ++count) {
    const Facets& here = triangles_[static_cast<std::size_t>(triangle)];
    const double growth = growth_[static_cast<std::size_t>(here.region)];
    const auto [exit, turn] = way_out(here, angle, radius, growth);
    if (exit == nullptr || begin - (angle - turn) > 2.0 * pi) return std::nullopt;
    constexpr double hardly = 1e-14;
    standing = turn > hardly ? 0 : standing + 1;
    add_arc(angle, angle - turn, radius, here.region);
    radius *= std::exp(-growth * turn);
    angle -= turn;
    if (exit->across < 0) return exit->piece;
    if (exit->seam >= 0) crossings_.push_back({exit->seam, pole_ + radius * towards(angle)});
    triangle = exit->across;
  }
  return std::nullopt;
}

void BlockGround::add_weight(const problem::Soil& soil, const mesh::Point& moment, double sign) {
  // Unit angular velocity: at (x, y) from the pole the velocity is (-y, x).
  const auto power = [&](const mesh::Point& pull) {
    return sign * (pull.y() * moment.x() - pull.x() * moment.y());
  };
  powers_.dead += soil.unit_weight * power(problem_.pull);
  powers_.live += soil.live_unit_weight * power(problem_.live_pull);
}

void BlockGround::add_arc(double upper, double lower, double radius, int region) {
  const double growth = growth_[static_cast<std::size_t>(region)];
  const problem::SpiralArc arc{upper, lower, radius, growth};
  add_weight(soil(region), moment_under(arc), 1.0);
  // c cos(phi) times the velocity, which is the radius, along the curve: c r^2 d(angle).
  const double turn = upper - lower, twice = 2.0 * growth * turn;
  const double mean = twice > 1e-12 ? -std::expm1(-twice) / twice : 1.0;
  powers_.dissipation += soil(region).cohesion * radius * radius * turn * mean;
  const bool goes_on = !arcs_.empty() && arcs_.back().growth == growth;
  if (goes_on) {
    arcs_.back().lower = lower;
  } else {
    arcs_.push_back(arc);
  }
}

// From the low end along the outline to the high one; false if something is held on the way.
bool BlockGround::add_outline(std::size_t from, const mesh::Point& low, std::size_t to,
                              const mesh::Point& high) {
  std::size_t at = from;
  mesh::Point first = low;
  const mesh::Point along = pieces_[from].second - pieces_[from].first;
  bool is_round = to == from && (high - low).dot(along) < 0.0;
  for (std::size_t count = 0; count <= pieces_.size(); ++count) {
    const Piece& piece = links_[at];
    if (!pieces_[at].is_free) return false;
    const bool is_last = at == to && !is_round;
    is_round = false;
    const mesh::Point second = is_last ? high : pieces_[at].second;
    const problem::Soil& here = soil(triangles_[static_cast<std::size_t>(piece.triangle)].region);
    const mesh::Point a = first - pole_, b = second - pole_;
    add_weight(here, moment_under(a, b), 1.0);
    // Tractions, constant, on a linear velocity: its middle.
    const problem::Boundary& side = problem_.boundaries[static_cast<std::size_t>(piece.boundary)];
    const mesh::Point way = second - first, middle = (a + b) / 2.0;
    const mesh::Point outward(way.y(), -way.x()), velocity(-middle.y(), middle.x());
    const double across = outward.dot(velocity), slip = way.dot(velocity);
    powers_.dead += side.normal_stress * across + side.shear_stress * slip;
    powers_.live += side.live_normal_stress * across + side.live_shear_stress * slip;
    if (is_last) return true;
    at = static_cast<std::size_t>(piece.next);
    first = pieces_[at].first;
  }
  return false;
}

bool BlockGround::is_in_block(const mesh::Point& place) const {
  const mesh::Point arm = place - pole_;
  double angle = std::atan2(arm.y(), arm.x());
  while (angle > arcs_.front().upper) angle -= 2.0 * pi;
  while (angle < arcs_.back().lower) angle += 2.0 * pi;
  if (angle > arcs_.front().upper) return false;
  const auto arc = std::find_if(arcs_.begin(), arcs_.end(),
                                [&](const problem::SpiralArc& one) { return angle >= one.lower; });
  return arc != arcs_.end() &&
         arm.norm() < arc->radius * std::exp(arc->growth * (angle - arc->upper));
}

// Whether the outline from the low end to the high one, and no other, lies between pole and curve:
// the ground there is the block, then, and all of it.
bool BlockGround::is_seen_from_pole(std::size_t from, const mesh::Point& low, std::size_t to,
                                    const mesh::Point& high) const {
  std::vector<bool> is_between(pieces_.size(), false);
  for (std::size_t at = from; at != to;) {
    at = static_cast<std::size_t>(links_[at].next);
    is_between[at] = true;  // its first end is
  }
  // Of a piece from the line of sight between the pole and an end of the curve.
  const auto hides = [&](const OutlinePiece& piece, const mesh::Point& end) {
    const mesh::Point sight = end - pole_, along = piece.second - piece.first;
    const double size = cross(sight, along);
    if (size == 0.0) return false;
    const mesh::Point to_piece = piece.first - pole_;
    const double of_sight = cross(to_piece, along) / size;
    const double of_piece = cross(to_piece, sight) / size;
    constexpr double touches = 1e-9;
    return of_sight > 0.0 && of_sight < 1.0 - touches && of_piece >= 0.0 && of_piece <= 1.0;
  };
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (hides(pieces_[i], low) || hides(pieces_[i], high)) return false;
    // The low end itself.
    if (i == from && !is_between[i]) continue;
    if (is_in_block(pieces_[i].first) != is_between[i]) return false;
  }
  return true;
}

// Seams within the block: the weight of one side ends there, that of the other begins.
void BlockGround::add_seams() {
  for (std::size_t s = 0; s < seams_.size(); ++s) {
    const Seam& seam = seams_[s];
    std::vector<mesh::Point> ends{seam.first};
    for (const Crossing& crossing : crossings_) {
      if (crossing.seam == static_cast<int>(s)) ends.push_back(crossing.place);
    }
    ends.push_back(seam.second);
    std::sort(ends.begin(), ends.end(), [&](const mesh::Point& a, const mesh::Point& b) {
      return (a - b).dot(seam.second - seam.first) < 0.0;
    });
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (!is_in_block((ends[i] + ends[i + 1]) / 2.0)) continue;
      const mesh::Point moment = moment_under(ends[i] - pole_, ends[i + 1] - pole_);
      add_weight(soil(seam.left), moment, 1.0);
      add_weight(soil(seam.right), moment, -1.0);
    }
  }
}

}  // namespace limit::block

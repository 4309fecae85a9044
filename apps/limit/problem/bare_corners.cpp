#include "limit/problem/bare_corners.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace limit::problem {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double straight = 1e-9;  // off 180 degrees, in which equilibrium is one to rounding

// An end of the triangles around a node of the outline.
struct FanEnd {
  bool is_bare = false;    // a free face, of soil without tension
  bool is_mirror = false;  // held across, free along
  mesh::Point normal{0.0, 0.0};
};

// All triangles around a node from one side of the outline to the next, counterclockwise.
struct Fan {
  std::vector<std::pair<int, int>> corners;  // triangle, corner
  std::vector<double> sides;                 // angles of the inner sides, from the first one
  double angle = 0.0;
  FanEnd first, last;
};

class BareCorners {
 public:
  explicit BareCorners(const Problem& problem)
      : problem_(problem), found_(problem.mesh.triangles.size()) {
    const mesh::Mesh& mesh = problem.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto& nodes = mesh.triangles[t].nodes;
        left_of_[{nodes[i], nodes[(i + 1) % 3]}] = static_cast<int>(t);
      }
    }
    for (const mesh::BoundaryEdge& edge : mesh.boundary) {
      outline_[{edge.first, edge.second}] = edge.boundary;
    }
  }

  std::vector<BareTriangle> found() {
    for (std::size_t t = 0; t < found_.size(); ++t) {
      if (!soil_of(static_cast<int>(t)).stands) continue;
      for (BareCorner& corner : found_[t]) bind(corner, {1.0, 0.0});
    }
    for (const auto& [edge, boundary] : outline_) {
      bind_middle(edge);
      bind_fan(fan_from(edge.first, edge.second));
    }
    return std::move(found_);
  }

 private:
  const mesh::Point& at(int node) const {
    return problem_.mesh.nodes[static_cast<std::size_t>(node)];
  }
  const Soil& soil_of(int triangle) const {
    const int region = problem_.mesh.triangles[static_cast<std::size_t>(triangle)].region;
    return problem_.soils[static_cast<std::size_t>(region)];
  }
  bool is_loose(int triangle) const { return soil_of(triangle).is_loose(); }
  bool bears_no_tension(int triangle) const {
    return soil_of(triangle).tension == 0.0 || is_loose(triangle);
  }

  static void bind(BareCorner& corner, const mesh::Point& normal) {
    if (corner.bears == BareCorner::Bears::nothing) return;
    const bool is_other =
        corner.bears == BareCorner::Bears::along && !is_one_line(corner.normal, normal);
    if (corner.bears == BareCorner::Bears::all) corner.normal = normal;
    corner.bears = is_other ? BareCorner::Bears::nothing : BareCorner::Bears::along;
  }
  BareCorner& corner_of(const std::pair<int, int>& corner) {
    return found_[static_cast<std::size_t>(corner.first)][static_cast<std::size_t>(corner.second)];
  }

  FanEnd end_of(const std::pair<int, int>& edge, int boundary) const {
    const Boundary& conditions = problem_.boundaries[static_cast<std::size_t>(boundary)];
    const mesh::Point along = (at(edge.second) - at(edge.first)).normalized();
    FanEnd end;
    end.normal = {along.y(), -along.x()};
    end.is_bare = is_free(conditions) && bears_no_tension(left_of_.at(edge));
    end.is_mirror = conditions.normal == Known::support &&
                    conditions.tangential == Known::traction && conditions.shear_stress == 0.0 &&
                    conditions.live_shear_stress == 0.0;
    return end;
  }

  // Of the triangle's Bezier point in the middle of a free side.
  void bind_middle(const std::pair<int, int>& edge) {
    const FanEnd end = end_of(edge, outline_.at(edge));
    if (!end.is_bare) return;
    const int t = left_of_.at(edge);
    const int i = mesh::corner_of(problem_.mesh.triangles[static_cast<std::size_t>(t)], edge.first);
    BareCorner& middle = corner_of({t, 3 + i});
    bind(middle, end.normal);
    if (is_loose(t)) middle.bears = BareCorner::Bears::nothing;
  }

  // From a free face on, from one triangle without cohesion to the next.
  template <class Corner>
  void empty_loose(Corner corner, const Corner& end) {
    for (; corner != end && is_loose(corner->first); ++corner) {
      corner_of(*corner).bears = BareCorner::Bears::nothing;
    }
  }

  Fan fan_from(int node, int next) const {
    Fan fan;
    fan.first = end_of({node, next}, outline_.at({node, next}));
    for (;;) {
      const int t = left_of_.at({node, next});
      const mesh::Triangle& triangle = problem_.mesh.triangles[static_cast<std::size_t>(t)];
      const int corner = mesh::corner_of(triangle, node);
      const int other = triangle.nodes[static_cast<std::size_t>((corner + 2) % 3)];
      const mesh::Point a = at(next) - at(node), b = at(other) - at(node);
      fan.angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
      fan.corners.emplace_back(t, corner);
      const auto end = outline_.find({other, node});
      if (end != outline_.end()) {
        fan.last = end_of(end->first, end->second);
        return fan;
      }
      fan.sides.push_back(fan.angle);
      next = other;
    }
  }

  void bind_fan(const Fan& fan) {
    if (!fan.first.is_bare && !fan.last.is_bare) return;
    if (fan.first.is_bare) bind(corner_of(fan.corners.front()), fan.first.normal);
    if (fan.last.is_bare) bind(corner_of(fan.corners.back()), fan.last.normal);
    if (fan.first.is_bare) empty_loose(fan.corners.begin(), fan.corners.end());
    if (fan.last.is_bare) empty_loose(fan.corners.rbegin(), fan.corners.rend());
    const bool is_pure = std::ranges::all_of(
        fan.corners, [&](const auto& corner) { return bears_no_tension(corner.first); });
    const bool mirrors = fan.first.is_mirror || fan.last.is_mirror;
    if (!is_pure || !((fan.first.is_bare && fan.last.is_bare) || mirrors)) return;
    const double whole = mirrors ? 2.0 * fan.angle : fan.angle;
    const mesh::Point& normal = fan.first.is_bare ? fan.first.normal : fan.last.normal;
    if (std::abs(whole - pi) <= straight) {
      for (const auto& corner : fan.corners) bind(corner_of(corner), normal);
      // What is nothing in one of them is so in all; friction alone bears nothing along the face.
      if (std::ranges::none_of(fan.corners, [&](const auto& corner) {
            return corner_of(corner).bears == BareCorner::Bears::nothing || is_loose(corner.first);
          })) {
        return;
      }
    } else if (whole > pi) {
      // Two sides that neither face can see along itself leave room for a stress.
      const auto free = std::ranges::count_if(fan.sides, [&](double side) {
        return side > whole - pi + straight && side < pi - straight;
      });
      if (free >= 2 || mirrors) return;
    }
    for (const auto& corner : fan.corners) {
      corner_of(corner).bears = BareCorner::Bears::nothing;
    }
  }

  const Problem& problem_;
  std::vector<BareTriangle> found_;
  std::map<std::pair<int, int>, int> left_of_;  // the triangle left of a side
  std::map<std::pair<int, int>, int> outline_;  // the boundary on a side
};

}  // namespace

bool is_one_line(const mesh::Point& a, const mesh::Point& b) {
  return std::abs(a.x() * b.y() - a.y() * b.x()) <= straight;
}

bool is_free(const Boundary& boundary) {
  return boundary.normal == Known::traction && boundary.tangential == Known::traction &&
         boundary.normal_stress == 0.0 && boundary.shear_stress == 0.0 &&
         boundary.live_normal_stress == 0.0 && boundary.live_shear_stress == 0.0;
}

std::vector<BareTriangle> bare_corners(const Problem& problem) {
  const bool is_any = std::ranges::any_of(
      problem.soils, [](const Soil& soil) { return soil.tension == 0.0 || soil.is_loose(); });
  if (!is_any) return {};
  return BareCorners(problem).found();
}

}  // namespace limit::problem

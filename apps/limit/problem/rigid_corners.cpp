#include "limit/problem/rigid_corners.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "limit/problem/local_soil.hpp"

namespace limit::problem {

namespace {

constexpr double degree = std::numbers::pi / 180.0;
// Where there is hardly any velocity that leaves both sides, either.
constexpr double room = 5.0 * degree;
// So that cutting ends, whatever the friction.
constexpr double widest = 170.0 * degree;
// Of the sides that meet in a corner, cut off at most; less than half, as both ends may be cut.
constexpr double share = 0.4;

/// What the outline leaves to the soil at one of its nodes, from one side of the outline,
/// counterclockwise, to the other.
struct Corner {
  int node = 0;
  int from = 0, to = 0;        // boundaries
  double opening = 0.0;        // [rad]
  std::vector<int> triangles;  // in it
  std::vector<int> ends;       // of their sides that meet here, one more than triangles
};

class Outline {
 public:
  explicit Outline(const mesh::Mesh& mesh) : mesh_(mesh) {
    for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
      triangle_at_[{edge.first, edge.second}] = edge.left;
      if (edge.right >= 0) triangle_at_[{edge.second, edge.first}] = edge.right;
      if (edge.boundary >= 0) boundary_of_[{edge.first, edge.second}] = edge.boundary;
    }
  }

  // At the first node of a side of the outline.
  [[nodiscard]] Corner corner(const mesh::BoundaryEdge& edge) const {
    Corner corner;
    corner.node = edge.first;
    corner.from = edge.boundary;
    corner.ends = {edge.second};
    const int node = edge.first;
    int next = edge.second;
    for (auto at = triangle_at_.find({node, next}); at != triangle_at_.end();
         at = triangle_at_.find({node, next})) {
      const mesh::Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(at->second)];
      const int beyond =
          triangle.nodes[static_cast<std::size_t>((mesh::corner_of(triangle, node) + 2) % 3)];
      corner.opening += angle(node, next, beyond);
      corner.triangles.push_back(at->second);
      corner.ends.push_back(beyond);
      next = beyond;
    }
    corner.to = boundary_of_.at({next, node});
    return corner;
  }

 private:
  [[nodiscard]] double angle(int node, int first, int second) const {
    const auto place = [&](int i) { return mesh_.nodes[static_cast<std::size_t>(i)]; };
    const mesh::Point a = place(first) - place(node), b = place(second) - place(node);
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }

  const mesh::Mesh& mesh_;
  std::map<std::pair<int, int>, int> triangle_at_, boundary_of_;  // by the side's two nodes
};

const Boundary& boundary_of(const Problem& problem, int side) {
  return problem.boundaries[static_cast<std::size_t>(side)];
}

bool is_rough(const Problem& problem, int side) {
  return boundary_of(problem, side).tangential == Known::support;
}

bool is_narrow(const Problem& problem, const Corner& corner) {
  double friction = 0.0;
  for (const int triangle : corner.triangles) {
    const mesh::Triangle& at = problem.mesh.triangles[static_cast<std::size_t>(triangle)];
    friction = std::max(friction, soil_in(problem, at, Bound::upper).friction_angle);
  }
  double least = 0.0;
  for (const int side : {corner.from, corner.to}) {
    if (boundary_of(problem, side).normal != Known::support) return false;
    if (is_rough(problem, side)) least += friction;
  }
  return least > 0.0 && corner.opening <= std::min(least + room, widest);
}

// Cuts the triangles around a corner in two by a straight line and leaves the corner's parts out.
// What is left opens to more at both ends of the line: the right angle and half of what it was.
void cut_off(Problem& problem, const Corner& corner) {
  mesh::Mesh& mesh = problem.mesh;
  const int rigid = is_rough(problem, corner.from) ? corner.from : corner.to;
  const auto place = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)]; };
  const mesh::Point tip = place(corner.node);
  const auto towards = [&](int node) { return mesh::Point((place(node) - tip).normalized()); };
  const mesh::Point inwards =
      (towards(corner.ends.front()) + towards(corner.ends.back())).normalized();
  double depth = INFINITY;
  for (const int end : corner.ends) {
    depth = std::min(depth, share * inwards.dot(place(end) - tip));
  }
  std::vector<int> cuts;
  for (const int end : corner.ends) {
    const mesh::Point direction = towards(end);
    cuts.push_back(static_cast<int>(mesh.nodes.size()));
    mesh.nodes.emplace_back(tip + depth / inwards.dot(direction) * direction);
  }
  for (std::size_t i = 0; i < corner.triangles.size(); ++i) {
    const int a = cuts[i], b = corner.ends[i], c = corner.ends[i + 1], d = cuts[i + 1];
    mesh::Triangle& outer = mesh.triangles[static_cast<std::size_t>(corner.triangles[i])];
    outer.nodes = {a, b, c};
    mesh.triangles.push_back({{a, c, d}, outer.region});
    mesh.boundary.push_back({d, a, rigid});
  }
  for (mesh::BoundaryEdge& edge : mesh.boundary) {
    if (edge.first == corner.node && edge.second == corner.ends.front()) edge.first = cuts.front();
    if (edge.second == corner.node && edge.first == corner.ends.back()) edge.second = cuts.back();
  }
}

std::optional<Corner> narrow_corner(const Problem& problem) {
  const Outline outline(problem.mesh);
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    Corner corner = outline.corner(edge);
    if (is_narrow(problem, corner)) return corner;
  }
  return std::nullopt;
}

}  // namespace

Problem with_rigid_corners_cut(Problem problem) {
  while (const auto corner = narrow_corner(problem)) cut_off(problem, *corner);
  return problem;
}

}  // namespace limit::problem

#include "limit/mesh/cut.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace limit::mesh {

namespace {

Point& node_at(Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

// Nodes closer to the line than this share of their shortest side go onto it: slivers would be left
// otherwise.
constexpr double almost = 0.2;

// Nodes that may not move along the axis: those on outline that does not run along it, and those on
// earlier lines.
std::vector<bool> held_nodes(const Mesh& mesh, int axis, const std::vector<double>& earlier) {
  std::vector<bool> held(mesh.nodes.size(), false);
  for (const BoundaryEdge& edge : mesh.boundary) {
    const auto first = static_cast<std::size_t>(edge.first);
    const auto second = static_cast<std::size_t>(edge.second);
    if (mesh.nodes[first][1 - axis] == mesh.nodes[second][1 - axis]) continue;
    held[first] = true;
    held[second] = true;
  }
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    if (std::count(earlier.begin(), earlier.end(), mesh.nodes[i][axis]) != 0) held[i] = true;
  }
  return held;
}

void move_onto(Mesh& mesh, int axis, double position, const std::vector<double>& earlier) {
  const std::vector<bool> held = held_nodes(mesh, axis, earlier);
  std::vector<double> shortest(mesh.nodes.size(), std::numeric_limits<double>::infinity());
  for (const Triangle& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangle.nodes[i], b = triangle.nodes[(i + 1) % 3];
      const double length = (node_at(mesh, a) - node_at(mesh, b)).norm();
      for (const int node : {a, b}) {
        double& known = shortest[static_cast<std::size_t>(node)];
        known = std::min(known, length);
      }
    }
  }
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) {
    double& coordinate = mesh.nodes[i][axis];
    if (!held[i] && std::abs(coordinate - position) < almost * shortest[i]) coordinate = position;
  }
}

class Cutter {
 public:
  Cutter(const Mesh& mesh, int axis, double position, const std::vector<double>& earlier)
      : mesh_(mesh), axis_(axis), position_(position) {
    move_onto(mesh_, axis, position, earlier);
  }

  Mesh result() {
    const std::vector<Triangle> triangles = std::exchange(mesh_.triangles, {});
    for (const Triangle& triangle : triangles) divide(triangle);
    const std::vector<BoundaryEdge> outline = std::exchange(mesh_.boundary, {});
    for (const BoundaryEdge& edge : outline) {
      const auto middle = middles_.find(std::minmax(edge.first, edge.second));
      if (middle == middles_.end()) {
        mesh_.boundary.push_back(edge);
      } else {
        mesh_.boundary.push_back({edge.first, middle->second, edge.boundary});
        mesh_.boundary.push_back({middle->second, edge.second, edge.boundary});
      }
    }
    return mesh_;
  }

 private:
  [[nodiscard]] double height(int node) { return node_at(mesh_, node)[axis_] - position_; }

  int crossing(int a, int b) {
    const auto [at, is_new] =
        middles_.emplace(std::minmax(a, b), static_cast<int>(mesh_.nodes.size()));
    if (is_new) {
      const double share = height(a) / (height(a) - height(b));
      Point point = node_at(mesh_, a) + share * (node_at(mesh_, b) - node_at(mesh_, a));
      point[axis_] = position_;
      mesh_.nodes.push_back(point);
    }
    return at->second;
  }

  void divide(const Triangle& triangle) {
    auto [a, b, c] = triangle.nodes;
    const auto add = [&](int i, int j, int k) {
      mesh_.triangles.push_back({{i, j, k}, triangle.region});
    };
    const auto differ = [&](int i, int j) { return height(i) * height(j) < 0.0; };
    // Turned so that, if it is crossed at all, `a` is alone on its side, or on the line.
    for (int turn = 0; turn < 3; ++turn) {
      if (height(a) == 0.0 && differ(b, c)) {
        const int middle = crossing(b, c);
        add(a, b, middle);
        add(a, middle, c);
        return;
      }
      if (differ(a, b) && differ(a, c)) {
        const int ab = crossing(a, b), ac = crossing(a, c);
        add(a, ab, ac);
        add(ab, b, ac);
        add(b, c, ac);
        return;
      }
      std::tie(a, b, c) = std::tuple(b, c, a);
    }
    add(a, b, c);
  }

  Mesh mesh_;
  int axis_;
  double position_;
  std::map<std::pair<int, int>, int> middles_;
};

}  // namespace

Mesh cut(const Mesh& mesh, int axis, double position, const std::vector<double>& earlier) {
  return Cutter(mesh, axis, position, earlier).result();
}

}  // namespace limit::mesh

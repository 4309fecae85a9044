#include "limit/mesh/mesh.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <utility>

namespace limit::mesh {

namespace {

std::string place(const Mesh& mesh, int first, int second) {
  const Point& a = mesh.nodes[static_cast<std::size_t>(first)];
  const Point& b = mesh.nodes[static_cast<std::size_t>(second)];
  return fmt::format("({:.6g}, {:.6g}) - ({:.6g}, {:.6g})", a.x(), a.y(), b.x(), b.y());
}

}  // namespace

double twice_area(const Mesh& mesh, const Triangle& triangle) {
  const Point& a = mesh.nodes[static_cast<std::size_t>(triangle.nodes[0])];
  const Point& b = mesh.nodes[static_cast<std::size_t>(triangle.nodes[1])];
  const Point& c = mesh.nodes[static_cast<std::size_t>(triangle.nodes[2])];
  return (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
}

int corner_of(const Triangle& triangle, int node) {
  for (int corner = 0; corner < 3; ++corner) {
    if (triangle.nodes[static_cast<std::size_t>(corner)] == node) return corner;
  }
  throw std::invalid_argument(fmt::format("node {} is no corner of the triangle", node));
}

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  std::map<std::pair<int, int>, std::size_t> known;  // by the lower and the higher node
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    if (!(twice_area(mesh, triangle) > 0.0)) {
      throw std::invalid_argument("mesh: a triangle without area, or clockwise, at " +
                                  place(mesh, triangle.nodes[0], triangle.nodes[1]));
    }
    for (std::size_t side = 0; side < 3; ++side) {
      const int first = triangle.nodes[side], second = triangle.nodes[(side + 1) % 3];
      const auto [at, is_new] = known.emplace(std::minmax(first, second), edges.size());
      if (is_new) {
        edges.push_back({first, second, static_cast<int>(t), -1, -1});
      } else if (Edge& edge = edges[at->second]; edge.right < 0 && edge.first == second) {
        edge.right = static_cast<int>(t);
      } else {
        throw std::invalid_argument("mesh: triangles overlap at " + place(mesh, first, second));
      }
    }
  }
  for (const BoundaryEdge& outer : mesh.boundary) {
    const auto at = known.find(std::minmax(outer.first, outer.second));
    if (at == known.end() || edges[at->second].right >= 0 || edges[at->second].boundary >= 0 ||
        edges[at->second].first != outer.first) {
      throw std::invalid_argument("mesh: no outer side of a triangle, or named twice: " +
                                  place(mesh, outer.first, outer.second));
    }
    edges[at->second].boundary = outer.boundary;
  }
  for (const Edge& edge : edges) {
    if (edge.right < 0 && edge.boundary < 0) {
      throw std::invalid_argument("mesh: the outer side belongs to no boundary: " +
                                  place(mesh, edge.first, edge.second));
    }
  }
  return edges;
}

}  // namespace limit::mesh

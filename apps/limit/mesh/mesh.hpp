#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace limit::mesh {

using Point = Eigen::Vector2d;

/// Three nodes, counterclockwise, and the soil region the triangle belongs to.
struct Triangle {
  std::array<int, 3> nodes{};
  int region = 0;
};

/// One side of a triangle on the outline of the body, which lies to the left of first -> second.
struct BoundaryEdge {
  int first = 0;
  int second = 0;
  int boundary = 0;  // index of the boundary (see Problem::boundaries)
};

/// A conforming triangulation of a plane body with straight sides.
struct Mesh {
  std::vector<Point> nodes;  // [m] or in a unit length, as the problem says
  std::vector<Triangle> triangles;
  std::vector<BoundaryEdge> boundary;
  /// What bisection takes for as long as it is high: lengths along x count by the inverse of this.
  double stretch = 1.0;
};

/// A side between two triangles, or on the outline. It runs counterclockwise around `left`.
struct Edge {
  int first = 0;
  int second = 0;
  int left = 0;
  int right = -1;     // -1 on the outline
  int boundary = -1;  // -1 inside
};

/// Twice the signed area of a triangle; positive if its nodes run counterclockwise.
[[nodiscard]] double twice_area(const Mesh& mesh, const Triangle& triangle);

/// Position (0, 1, 2) of a node in a triangle.
/// @throws std::invalid_argument if it is no node of the triangle.
[[nodiscard]] int corner_of(const Triangle& triangle, int node);

/// Every side of the mesh once, in the order in which the triangles meet them.
/// @throws std::invalid_argument, naming the place, if a triangle has no area or is clockwise, a
/// side belongs to more than two triangles, or the outline is not exactly `mesh.boundary`.
[[nodiscard]] std::vector<Edge> edges_of(const Mesh& mesh);

}  // namespace limit::mesh

#include "limit/velocity_shapes.hpp"

namespace limit {

VelocityTriangle velocity_triangle(const Mesh& mesh, const Triangle& triangle) {
  VelocityTriangle shapes;
  const double area2 = twice_area(mesh, triangle);
  shapes.area = area2 / 2.0;
  std::array<Point, 3> gradient;  // of the barycentric coordinates L
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& b = mesh.nodes[static_cast<std::size_t>(triangle.nodes[(i + 1) % 3])];
    const Point& c = mesh.nodes[static_cast<std::size_t>(triangle.nodes[(i + 2) % 3])];
    gradient[i] = Point(b.y() - c.y(), c.x() - b.x()) / area2;
  }
  // N_i = L_i (2 L_i - 1), N_ij = 4 L_i L_j, at the corner where its own L is one.
  for (std::size_t corner = 0; corner < 3; ++corner) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      shapes.slopes[corner][i] = (i == corner ? 3.0 : -1.0) * gradient[i];
      shapes.slopes[corner][3 + i] =
          4.0 * ((i == corner ? 1.0 : 0.0) * gradient[j] + (j == corner ? 1.0 : 0.0) * gradient[i]);
    }
  }
  return shapes;
}

std::array<int, 3> places_along(const Mesh& mesh, int triangle, const Edge& edge) {
  const Triangle& nodes = mesh.triangles[static_cast<std::size_t>(triangle)];
  const int first = corner_of(nodes, edge.first), second = corner_of(nodes, edge.second);
  // The middle of the side from corner i to the next has the number 3 + i.
  const int middle = (first + 1) % 3 == second ? 3 + first : 3 + second;
  return {6 * triangle + first, 6 * triangle + middle, 6 * triangle + second};
}

Point rigid_velocity(const Point& arm, int motion) {
  return motion == 0 ? Point(1, 0) : motion == 1 ? Point(0, 1) : Point(-arm.y(), arm.x());
}

}  // namespace limit

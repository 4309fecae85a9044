#include "limit/programme/velocity_shapes.hpp"

namespace limit::programme {

VelocityTriangle velocity_triangle(const mesh::Mesh& mesh, const mesh::Triangle& triangle) {
  VelocityTriangle shapes;
  const double area2 = mesh::twice_area(mesh, triangle);
  shapes.area = area2 / 2.0;
  std::array<mesh::Point, 3> gradient;  // of the barycentric coordinates L
  for (std::size_t i = 0; i < 3; ++i) {
    const mesh::Point& b = mesh.nodes[static_cast<std::size_t>(triangle.nodes[(i + 1) % 3])];
    const mesh::Point& c = mesh.nodes[static_cast<std::size_t>(triangle.nodes[(i + 2) % 3])];
    gradient[i] = mesh::Point(b.y() - c.y(), c.x() - b.x()) / area2;
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

std::array<int, 3> places_along(const mesh::Mesh& mesh, int triangle, const mesh::Edge& edge) {
  const mesh::Triangle& nodes = mesh.triangles[static_cast<std::size_t>(triangle)];
  const int first = mesh::corner_of(nodes, edge.first),
            second = mesh::corner_of(nodes, edge.second);
  // The middle of the side from corner i to the next has the number 3 + i.
  const int middle = (first + 1) % 3 == second ? 3 + first : 3 + second;
  return {6 * triangle + first, 6 * triangle + middle, 6 * triangle + second};
}

mesh::Point rigid_velocity(const mesh::Point& arm, int motion) {
  return motion == 0   ? mesh::Point(1, 0)
         : motion == 1 ? mesh::Point(0, 1)
                       : mesh::Point(-arm.y(), arm.x());
}

}  // namespace limit::programme

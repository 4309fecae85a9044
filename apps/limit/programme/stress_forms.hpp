#pragma once

#include <Eigen/Core>

#include "limit/mesh/mesh.hpp"

namespace limit::programme {

/// A linear form in one corner's (p, d, t).
using Form = Eigen::Vector3d;

inline Form stress_xx() {
  return {1, 1, 0};
}
inline Form stress_yy() {
  return {1, -1, 0};
}
inline Form stress_xy() {
  return {0, 0, 1};
}
/// Traction along `direction` on a plane of normal `normal`.
inline Form traction(const mesh::Point& normal, const mesh::Point& direction) {
  return normal.x() * direction.x() * stress_xx() + normal.y() * direction.y() * stress_yy() +
         (normal.x() * direction.y() + normal.y() * direction.x()) * stress_xy();
}

/// Outward unit normal of a counterclockwise side, and its length.
struct SideFrame {
  SideFrame(const mesh::Mesh& mesh, const mesh::Edge& edge)
      : first(mesh.nodes[static_cast<std::size_t>(edge.first)]),
        second(mesh.nodes[static_cast<std::size_t>(edge.second)]) {
    const mesh::Point along = second - first;
    length = along.norm();
    tangent = along / length;
    normal = mesh::Point(tangent.y(), -tangent.x());
  }
  mesh::Point first, second, tangent, normal;
  double length;
};

}  // namespace limit::programme

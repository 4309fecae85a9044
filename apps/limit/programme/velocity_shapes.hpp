#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "limit/problem/problem.hpp"

namespace limit::programme {

/// A six-node triangle with straight sides: corners 0 1 2, then the middles of the sides 01 12 20;
/// the gradients of their shape functions in each corner.
struct VelocityTriangle {
  std::array<std::array<mesh::Point, 6>, 3> slopes{};
  double area = 0.0;
};

[[nodiscard]] VelocityTriangle velocity_triangle(const mesh::Mesh& mesh,
                                                 const mesh::Triangle& triangle);

/// The velocities along a side of a triangle, first node, middle, second node, in the numbering in
/// which triangle t has 6 t to 6 t + 5.
[[nodiscard]] std::array<int, 3> places_along(const mesh::Mesh& mesh, int triangle,
                                              const mesh::Edge& edge);

/// Where a rigid motion (0, 1 along x, y; 2 about its centre) takes a point, per unit of it;
/// `arm`: the point less the centre.
[[nodiscard]] mesh::Point rigid_velocity(const mesh::Point& arm, int motion);

}  // namespace limit::programme

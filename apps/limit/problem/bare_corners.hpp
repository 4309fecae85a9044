#pragma once

#include <array>
#include <vector>

#include "limit/problem/problem.hpp"

namespace limit::problem {

/// What is known of the stress in one corner of a triangle.
struct BareCorner {
  enum class Bears { all, along, nothing };
  Bears bears = Bears::all;
  mesh::Point normal{0.0, 0.0};  // along: no traction on the plane of this normal
};

/// Of the corners of a triangle and the middles of its sides 01 12 20.
using BareTriangle = std::array<BareCorner, 6>;

/// Whether two directions of length one are one line, either way: what is meant to turn turns by
/// more, and what turns by less than this leaves equilibrium as it is, to rounding.
[[nodiscard]] bool is_one_line(const mesh::Point& a, const mesh::Point& b);

/// Whether nothing acts on a side, neither given nor growing, and nothing holds it.
[[nodiscard]] bool is_free(const Boundary& boundary);

/// Where soil that bears no tension at all, or has no cohesion, has no choice at free faces,
/// triangle by triangle; empty if no soil is such.
///
/// Soil without cohesion bears nothing in any corner at a free face: there is no traction on the
/// face, nor then on the next side around the node, and a stress without traction on one plane is
/// along it, which friction alone does not bear.
///
/// A stress that is linear in triangles, carries no tension and leaves a straight free face alone
/// is, in all corners at a node of it, a pressure along the face: from side to side around the node
/// it changes by a pressure or tension along the side, and what these have across the face adds up
/// to nothing with weights of one sign and never is a tension. At an edge that juts out it is
/// nothing, and at one that is turned inwards only the triangles beside the faces are so bound; so
/// it is at a smooth wall, which mirrors the face. Soil that stands by itself (Soil::stands) bears
/// along uprights only. Whoever holds to this loses nothing elsewhere, and what is left lies
/// strictly within the cone of no tension.
[[nodiscard]] std::vector<BareTriangle> bare_corners(const Problem& problem);

}  // namespace limit::problem

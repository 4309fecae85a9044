#pragma once

#include <array>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/problem/problem.hpp"

namespace limit::problem {

/// A pore pressure that is linear in parts of the plane, which are not the soils'.
class PorePressure {
 public:
  PorePressure() = default;
  PorePressure(const PorePressure&) = delete;
  PorePressure& operator=(const PorePressure&) = delete;
  virtual ~PorePressure() = default;

  /// A place [m] and the pressure there [Pa].
  struct Corner {
    mesh::Point place{0.0, 0.0};
    double pressure = 0.0;
  };
  /// [Pa] At a place, [m].
  [[nodiscard]] virtual double at(const mesh::Point& place) const = 0;
  /// The corners of the parts of a triangle in each of which it is linear.
  [[nodiscard]] virtual std::vector<Corner> corners_in(
      const std::array<mesh::Point, 3>& triangle) const = 0;
  /// [Pa] The largest of all.
  [[nodiscard]] virtual double largest() const = 0;
};

/// A pressure that is linear in every triangle of a mesh, and continuous; in the problem's units,
/// and per unit of the multiplier if the problem's is live.
struct MeshPressure {
  std::vector<double> nodes;
  std::vector<mesh::Point> forces;  // of each triangle, less the gradient

  [[nodiscard]] bool is_there() const { return !forces.empty(); }
  [[nodiscard]] mesh::Point force(std::size_t triangle) const {
    return forces.empty() ? mesh::Point(mesh::Point::Zero()) : forces[triangle];
  }
};

/// One that stands for a problem's pore pressure: the same on the outline where tractions are
/// known, elsewhere nowhere less, for a lower bound, and nowhere more, for an upper one. It is
/// nothing where a problem has none.
///
/// Ground bears the more, the less pressure is in its pores: with p as in Soil, the stresses that
/// it bears under a pressure are among those under a smaller one. A stress field under no less is
/// one under the pressure itself, and what fails under no more does so under that.
/// @throws std::logic_error  where a side that is not on that outline has both its nodes there and
/// the pressure is not linear along it: give it one first (with_inner_nodes)
[[nodiscard]] MeshPressure pressure_on_mesh(const Problem& problem, Bound bound);

/// The mesh of a problem, each side between two nodes of outline where tractions are known that is
/// not on that outline itself halved by a node, and so the triangles beside it. Bisecting it
/// further makes no such side.
[[nodiscard]] mesh::Mesh with_inner_nodes(const Problem& problem);

}  // namespace limit::problem

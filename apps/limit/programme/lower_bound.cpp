#include "limit/programme/lower_bound.hpp"

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "limit/problem/pore_pressure.hpp"
#include "limit/programme/stress_points.hpp"

namespace limit::programme {

namespace {

/// The equations of equilibrium, and the programme with them.
class Builder {
 public:
  Builder(const problem::Problem& problem, const Parabolas& parabolas)
      : problem_(problem),
        water_(pressure_on_mesh(problem, problem::Bound::lower)),
        edges_(mesh::edges_of(problem.mesh)),
        points_(problem, parabolas, edges_) {}

  ConeProgram program() {
    equilibrium_of_triangles();
    equilibrium_of_sides();
    equilibrium_of_footing();
    points_.equations(equations_);
    const Eigen::Index variables = multiplier() + 1;
    ConeProgram program;
    program.cones = points_.cones();
    program.equations = equations_.matrix(variables);
    program.right_side = equations_.right_side();
    program.objective = Eigen::VectorXd::Unit(variables, multiplier());
    program.start = Eigen::VectorXd::Zero(variables);
    for (std::size_t k = 0; k < program.cones.size(); ++k) {
      program.start.segment<3>(3 * static_cast<Eigen::Index>(k)) = points_.starts()[k];
    }
    points_.tell(program);
    return program;
  }

 private:
  Eigen::Index multiplier() const { return points_.multiplier(); }
  const mesh::Point& node_of(const mesh::Triangle& triangle, int i) const {
    return problem_.mesh
        .nodes[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i % 3)])];
  }

  void begin_equation(double right_side) { equations_.begin(right_side); }
  void add(Eigen::Index variable, double coefficient) { equations_.add(variable, coefficient); }
  void add(Eigen::Index stress, const Form& form, double factor = 1.0) {
    add_form(equations_, stress, form, factor);
  }

  // div sigma + gamma pull = 0, gamma dead and live, with the constant gradients of the corners'
  // shape functions; of a quadratic stress, whose divergence is linear, in every corner.
  void equilibrium_of_triangles() {
    const mesh::Mesh& mesh = problem_.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const mesh::Triangle& triangle = mesh.triangles[t];
      const double area2 = mesh::twice_area(mesh, triangle);
      const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(triangle.region)];
      mesh::Point dead_water = water_.force(t), live_water = mesh::Point::Zero();
      if (problem_.pressure_is_live) std::swap(dead_water, live_water);
      std::array<mesh::Point, 3> gradients;
      for (int i = 0; i < 3; ++i) {
        const mesh::Point &next = node_of(triangle, i + 1), &last = node_of(triangle, i + 2);
        gradients[static_cast<std::size_t>(i)] =
            mesh::Point(next.y() - last.y(), last.x() - next.x()) / area2;
      }
      const Eigen::Index first = 9 * static_cast<Eigen::Index>(t);
      const bool is_linear = points_.middles(t) < 0;
      for (std::size_t at = 0; at < (is_linear ? 1U : 3U); ++at) {
        const mesh::Point& place = node_of(triangle, static_cast<int>(at));
        for (int row = 0; row < 2; ++row) {
          begin_equation(-problem_.force(soil, place)[row] - dead_water[row]);
          add(multiplier(), problem_.live_force(soil, place)[row] + live_water[row]);
          for (std::size_t i = 0; i < 3; ++i) {
            // Of the Bezier points only the corner and the middles next to it have slopes there.
            const Eigen::Index stress =
                is_linear || i == at
                    ? first + 3 * static_cast<Eigen::Index>(i)
                    : points_.middles(t) +
                          3 * static_cast<Eigen::Index>((at + 1) % 3 == i ? at : i);
            add(stress, divergence(gradients[i], row), is_linear ? 1.0 : 2.0);
          }
        }
      }
    }
  }

  static Form divergence(const mesh::Point& gradient, int row) {
    return row == 0 ? Form(gradient.x() * stress_xx() + gradient.y() * stress_xy())
                    : Form(gradient.x() * stress_xy() + gradient.y() * stress_yy());
  }

  void equilibrium_of_sides() {
    for (const mesh::Edge& edge : edges_) {
      const SideFrame side(problem_.mesh, edge);
      const auto at = [&](int triangle, int node) {
        return triangle < 0 ? StressPoints::Shares()
                            : StressPoints::Shares{{points_.corner(triangle, node), 1.0}};
      };
      for (const int node : {edge.first, edge.second}) {
        equilibrium_at(edge, side, at(edge.left, node), at(edge.right, node));
      }
      if (!points_.is_quadratic(edge.left) && !points_.is_quadratic(edge.right)) continue;
      equilibrium_at(edge, side, points_.middle(edge.left, edge),
                     edge.right < 0 ? StressPoints::Shares() : points_.middle(edge.right, edge));
    }
  }

  // Whether there is no traction in a direction on a plane, by what is known of a stress.
  static bool follows(const problem::BareCorner& bare, const mesh::Point& normal,
                      const mesh::Point& direction) {
    if (bare.bears == problem::BareCorner::Bears::nothing) return true;
    // It bears across that normal only.
    return problem::is_one_line(bare.normal, normal) ||
           problem::is_one_line(bare.normal, direction);
  }

  // The one normal of planes without traction of all these stresses; nothing if they have none in
  // common, zero if none of them bears anything.
  std::optional<mesh::Point> bare_normal(const StressPoints::Shares& stresses) const {
    mesh::Point normal(0.0, 0.0);
    for (const auto& [stress, share] : stresses) {
      const problem::BareCorner* bare = points_.bare(stress);
      if (bare == nullptr) return std::nullopt;
      if (bare->bears == problem::BareCorner::Bears::nothing) continue;
      if (normal.isZero(0.0)) normal = bare->normal;
      if (!problem::is_one_line(normal, bare->normal)) return std::nullopt;
    }
    return normal;
  }

  // Of two stresses that bear along one face only, or nothing, what equilibrium is left: their
  // pressures are equal. Equations that follow from others would spoil the Newton systems.
  bool match_bare(const StressPoints::Shares& left, const StressPoints::Shares& right,
                  const SideFrame& side) {
    const std::optional<mesh::Point> first = bare_normal(left), second = bare_normal(right);
    if (!first || !second) return false;
    if (first->isZero(0.0) && second->isZero(0.0)) return true;
    if (!first->isZero(0.0) && !second->isZero(0.0) && !problem::is_one_line(*first, *second)) {
      return false;
    }
    const mesh::Point& normal = first->isZero(0.0) ? *second : *first;
    const mesh::Point along(-normal.y(), normal.x());
    if (problem::is_one_line(along, side.tangent)) return true;
    begin_equation(0.0);
    if (!first->isZero(0.0)) add_all(left, traction(along, along), 1.0);
    if (!second->isZero(0.0)) add_all(right, traction(along, along), -1.0);
    return true;
  }

  void add_all(const StressPoints::Shares& stresses, const Form& form, double sign) {
    for (const auto& [stress, share] : stresses) add(stress, form, sign * share);
  }

  // Tractions at a place of a side agree, or are the ones given. They are linear along it, and so
  // the same if they are at both ends; or quadratic, and the same if their Bezier points are.
  void equilibrium_at(const mesh::Edge& edge, const SideFrame& side,
                      const StressPoints::Shares& left, const StressPoints::Shares& right) {
    if (edge.right >= 0) {
      if (match_bare(left, right, side)) return;
      for (const mesh::Point& direction : {side.normal, side.tangent}) {
        begin_equation(0.0);
        add_all(left, traction(side.normal, direction), 1.0);
        add_all(right, traction(side.normal, direction), -1.0);
      }
      return;
    }
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    const problem::BareCorner* bare = points_.bare(left.front().first);
    bool is_told = false;
    const auto tell = [&](const mesh::Point& direction, double dead, double live) {
      const bool is_known = bare != nullptr && follows(*bare, side.normal, direction);
      // Of what bears along one line only, one equation says all, or none if nothing does.
      if (dead == 0.0 && live == 0.0 && (is_known || (bare != nullptr && is_told))) return;
      begin_equation(dead);
      add(multiplier(), -live);
      add_all(left, traction(side.normal, direction), 1.0);
      is_told = true;
    };
    if (boundary.normal == problem::Known::traction) {
      tell(side.normal, boundary.normal_stress, boundary.live_normal_stress);
    }
    if (boundary.tangential == problem::Known::traction) {
      tell(side.tangent, boundary.shear_stress, boundary.live_shear_stress);
    }
  }

  void equilibrium_of_footing() {
    const problem::Footing& footing = problem_.footing;
    for (int motion = 0; motion < 3; ++motion) {
      if (!footing.may_move[static_cast<std::size_t>(motion)]) continue;
      begin_equation(footing.dead_load[static_cast<std::size_t>(motion)]);
      for (const mesh::Edge& edge : edges_) {
        if (edge.boundary >= 0) add_resultant(edge, motion);
      }
      add(multiplier(), -footing.live_load[static_cast<std::size_t>(motion)]);
    }
  }

  // The traction's power on a rigid motion, over one side; both are linear along it, or the
  // traction is quadratic.
  void add_resultant(const mesh::Edge& edge, int motion) {
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (boundary.normal != problem::Known::footing &&
        boundary.tangential != problem::Known::footing)
      return;
    const SideFrame side(problem_.mesh, edge);
    const auto velocity = [&](const mesh::Point& at) {
      const mesh::Point arm = at - problem_.footing.centre;
      return motion == 0   ? mesh::Point(1, 0)
             : motion == 1 ? mesh::Point(0, 1)
                           : mesh::Point(-arm.y(), arm.x());
    };
    const mesh::Point first = velocity(side.first), second = velocity(side.second);
    if (points_.is_quadratic(edge.left)) {
      add(points_.corner(edge.left, edge.first),
          traction(side.normal, side.length / 12 * (3 * first + second)));
      add(points_.middle(edge.left, edge).front().first,
          traction(side.normal, side.length / 6 * (first + second)));
      add(points_.corner(edge.left, edge.second),
          traction(side.normal, side.length / 12 * (first + 3 * second)));
      return;
    }
    add(points_.corner(edge.left, edge.first),
        traction(side.normal, side.length / 6 * (2 * first + second)));
    add(points_.corner(edge.left, edge.second),
        traction(side.normal, side.length / 6 * (first + 2 * second)));
  }

  const problem::Problem& problem_;
  problem::MeshPressure water_;
  std::vector<mesh::Edge> edges_;
  StressPoints points_;
  algebra::EquationBuilder equations_;
};

}  // namespace

ConeProgram lower_bound_program(const problem::Problem& problem, const Parabolas& parabolas) {
  return Builder(problem, parabolas).program();
}

problem::StressField stress_field(const problem::Problem& problem,
                                  const Eigen::VectorXd& variables) {
  problem::StressField field(problem.mesh.triangles.size());
  auto middles = static_cast<Eigen::Index>(9 * field.size());
  for (std::size_t t = 0; t < field.size(); ++t) {
    const int region = problem.mesh.triangles[t].region;
    const bool is_quadratic = problem.soils[static_cast<std::size_t>(region)].has_uneven_weight();
    field[t].resize(3, is_quadratic ? 6 : 3);
    for (Eigen::Index i = 0; i < field[t].cols(); ++i) {
      const Eigen::Index at = i < 3 ? 9 * static_cast<Eigen::Index>(t) + 3 * i : middles;
      if (i >= 3) middles += 3;
      const Eigen::Vector3d x = variables.segment<3>(at);
      field[t].col(i) << x[0] + x[1], x[0] - x[1], x[2];
    }
  }
  return field;
}

}  // namespace limit::programme

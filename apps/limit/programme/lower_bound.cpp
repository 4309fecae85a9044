#include "limit/programme/lower_bound.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "limit/problem/bare_corners.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/programme/polygon_cones.hpp"
#include "limit/programme/stress_forms.hpp"
#include "limit/programme/yield_cones.hpp"

namespace limit::programme {

namespace {

// So that a solver's answer lies inside the true cone even after it was moved, by its tolerance,
// into equilibrium: much more than that of the solver, much less than a bracket.
constexpr double reserve = 1e-6;

class Builder {
 public:
  Builder(const problem::Problem& problem, const Polygons& polygons)
      : problem_(problem),
        polygons_(polygons),
        edges_(mesh::edges_of(problem.mesh)),
        overburden_(problem),
        bare_(problem::bare_corners(problem)) {
    add_cones();
    curves_.add_others();
    for (std::size_t corner = 0; corner < cuts_.size(); ++corner) add_cut(corner);
    for (std::size_t point = 0; point < cuts_.size(); ++point) add_pressure(point);
    for (const mesh::Edge& edge : edges_) add_contacts(edge);
    if (problem.most_multiplier) {
      cones_.push_back(half_line_cone(*problem.most_multiplier));
      starts_.push_back(inner_point(cones_.back(), 0.0));
    }
  }

  ConeProgram program() {
    equilibrium_of_triangles();
    equilibrium_of_sides();
    equilibrium_of_footing();
    stresses_of_contacts();
    stresses_of_cuts();
    stresses_of_bare_corners();
    curves_.equations([&](double right_side) { begin_equation(right_side); },
                      [&](Eigen::Index variable, double factor) { add(variable, factor); });
    end_of_multiplier();
    const Eigen::Index variables = multiplier() + 1;
    ConeProgram program;
    program.cones = cones_;
    program.equations.resize(static_cast<Eigen::Index>(right_side_.size()), variables);
    program.equations.setFromTriplets(entries_.begin(), entries_.end());
    program.right_side = Eigen::Map<const Eigen::VectorXd>(
        right_side_.data(), static_cast<Eigen::Index>(right_side_.size()));
    program.objective = Eigen::VectorXd::Unit(variables, multiplier());
    program.start = Eigen::VectorXd::Zero(variables);
    for (std::size_t k = 0; k < cones_.size(); ++k) {
      program.start.segment<3>(3 * static_cast<Eigen::Index>(k)) = starts_[k];
    }
    curves_.tell(program);
    return program;
  }

 private:
  // First variable of a triangle's corner.
  static Eigen::Index corner(int triangle, int corner) { return 9 * triangle + 3 * corner; }
  Eigen::Index corner_at(int triangle, int node) const {
    return corner(triangle, mesh::corner_of(
                                problem_.mesh.triangles[static_cast<std::size_t>(triangle)], node));
  }
  Eigen::Index multiplier() const { return 3 * static_cast<Eigen::Index>(cones_.size()); }

  // A cohesion is linear, as the stress is, so that the corners decide; under a weight that is
  // linear the stress is quadratic, and its Bezier points do: of a linear cohesion they are its
  // values at the middles of sides.
  void add_cones() {
    const auto& triangles = problem_.mesh.triangles;
    std::vector<problem::Soil> soils;
    for (const mesh::Triangle& triangle : triangles) {
      soils.push_back(problem::soil_in(problem_, triangle, problem::Bound::lower));
      const std::size_t t = soils.size() - 1;
      for (int i = 0; i < 3; ++i) {
        if (soils.back().is_curved()) {
          add_curved(triangle, i);
        } else {
          add_cone(soils.back(), node_of(triangle, i), bare_at(t, i));
        }
      }
    }
    middles_.assign(triangles.size(), -1);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      if (!soils[t].has_uneven_weight()) continue;
      middles_[t] = multiplier();
      for (int i = 0; i < 3; ++i) {
        add_cone(soils[t], (node_of(triangles[t], i) + node_of(triangles[t], i + 1)) / 2.0,
                 bare_at(t, 3 + i));
      }
    }
  }

  const mesh::Point& node_of(const mesh::Triangle& triangle, int i) const {
    return problem_.mesh
        .nodes[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i % 3)])];
  }

  // The Bezier point of the middle of a side, from inside a triangle: a variable of its own or the
  // mean of the ends'.
  std::vector<std::pair<Eigen::Index, double>> middle_of(int triangle,
                                                         const mesh::Edge& edge) const {
    const Eigen::Index first = corner_at(triangle, edge.first),
                       second = corner_at(triangle, edge.second);
    const Eigen::Index own = middles_[static_cast<std::size_t>(triangle)];
    if (own < 0) return {{first, 0.5}, {second, 0.5}};
    const auto i = (first - corner(triangle, 0)) / 3, j = (second - corner(triangle, 0)) / 3;
    return {{own + 3 * ((i + 1) % 3 == j ? i : j), 1.0}};
  }
  bool is_quadratic(int triangle) const {
    return triangle >= 0 && middles_[static_cast<std::size_t>(triangle)] >= 0;
  }

  const problem::BareCorner* bare_at(std::size_t triangle, int point) const {
    if (bare_.empty()) return nullptr;
    const problem::BareCorner& corner = bare_[triangle][static_cast<std::size_t>(point)];
    return corner.bears == problem::BareCorner::Bears::all ? nullptr : &corner;
  }

  void add_curved(const mesh::Triangle& triangle, int i) {
    const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(triangle.region)];
    const mesh::Point& place = node_of(triangle, i);
    const mesh::Point centre =
        (node_of(triangle, 0) + node_of(triangle, 1) + node_of(triangle, 2)) / 3.0;
    const CurvedPoint point{0, triangle.region, false, towards(place, centre)};
    const double load = overburden_.at(soil, place);
    const double guess = load + soil.envelope.unconfined() / 2.0;
    curves_.add(polygons_.lines(soil, point, guess, Polygon::chords), point, load, reserve);
    cuts_.emplace_back();
    bare_points_.push_back(nullptr);
  }

  void add_cone(const problem::Soil& local, const mesh::Point& place,
                const problem::BareCorner* bare) {
    const problem::Soil soil = local.with_cohesion(local.cohesion_at(place));
    const double load = overburden_.at(soil, place);
    cones_.push_back(yield_cone(soil, load, reserve));
    starts_.push_back(inner_point(cones_.back(), load));
    const bool is_cut = soil.cuts_tension() && bare == nullptr;
    cuts_.push_back(is_cut ? std::optional(tension_cone(soil, load, reserve)) : std::nullopt);
    bare_points_.push_back(bare);
  }

  // The stress of a corner once more, in Rankine's cone.
  void add_cut(std::size_t corner) {
    if (!cuts_[corner]) return;
    copies_.emplace_back(static_cast<Eigen::Index>(3 * corner), multiplier());
    cones_.push_back(*cuts_[corner]);
    starts_.push_back(inner_point(cones_.back(), -starts_[corner][0]));
  }

  void stresses_of_cuts() {
    for (const auto& [stress, copy] : copies_) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        begin_equation(0.0);
        add(stress + i, 1.0);
        add(copy + i, -1.0);
      }
    }
  }

  // What a corner at a free face bears is a pressure along it, or nothing.
  void add_pressure(std::size_t point) {
    const problem::BareCorner* bare = bare_points_[point];
    if (bare == nullptr || bare->bears == problem::BareCorner::Bears::nothing) return;
    contacts_.push_back({static_cast<Eigen::Index>(3 * point), multiplier(),
                         mesh::Point(-bare->normal.y(), bare->normal.x())});
    cones_.push_back(half_line_cone(cones_[point].scale));
    starts_.push_back(inner_point(cones_.back(), 0.0));
  }

  void stresses_of_bare_corners() {
    for (std::size_t point = 0; point < bare_points_.size(); ++point) {
      const problem::BareCorner* bare = bare_points_[point];
      if (bare == nullptr) continue;
      const auto stress = static_cast<Eigen::Index>(3 * point);
      const mesh::Point &normal = bare->normal, along(-normal.y(), normal.x());
      const bool is_nothing = bare->bears == problem::BareCorner::Bears::nothing;
      const mesh::Point axes[] = {normal, along};
      for (const mesh::Point& direction : axes) {
        begin_equation(0.0);
        add(stress, traction(normal, direction));
      }
      if (!is_nothing) continue;
      begin_equation(0.0);
      add(stress, traction(along, along));
    }
  }

  // Cones of the normal stress at both ends of a side that may open.
  void add_contacts(const mesh::Edge& edge) {
    if (edge.boundary < 0) return;
    if (!problem_.boundaries[static_cast<std::size_t>(edge.boundary)].may_open) return;
    const mesh::Point normal = SideFrame(problem_.mesh, edge).normal;
    std::vector<Eigen::Index> stresses{corner_at(edge.left, edge.first),
                                       corner_at(edge.left, edge.second)};
    if (is_quadratic(edge.left)) stresses.push_back(middle_of(edge.left, edge).front().first);
    for (const Eigen::Index stress : stresses) {
      contacts_.push_back({stress, multiplier(), normal});
      cones_.push_back(contact_cone(cones_[static_cast<std::size_t>(stress / 3)].scale, reserve));
      starts_.push_back(inner_point(cones_.back(), 0.0));
    }
  }

  void stresses_of_contacts() {
    for (const Contact& contact : contacts_) {
      begin_equation(0.0);
      add(contact.stress, traction(contact.normal, contact.normal));
      add(contact.variable, -1.0);
    }
  }

  // What is left to the most, in a cone of its own, the last one.
  void end_of_multiplier() {
    if (!problem_.most_multiplier) return;
    begin_equation(*problem_.most_multiplier);
    add(multiplier(), 1.0);
    add(multiplier() - 3, -1.0);
  }

  void begin_equation(double right_side) { right_side_.push_back(right_side); }

  // To the equation begun last.
  void add(Eigen::Index variable, double coefficient) {
    if (coefficient == 0.0) return;
    entries_.emplace_back(static_cast<Eigen::Index>(right_side_.size()) - 1, variable, coefficient);
  }

  void add(Eigen::Index variables, const Form& form, double factor = 1.0) {
    for (Eigen::Index i = 0; i < 3; ++i) add(variables + i, factor * form[i]);
  }

  // div sigma + gamma pull = 0, gamma dead and live, with the constant gradients of the corners'
  // shape functions; of a quadratic stress, whose divergence is linear, in every corner.
  void equilibrium_of_triangles() {
    const mesh::Mesh& mesh = problem_.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const mesh::Triangle& triangle = mesh.triangles[t];
      const double area2 = mesh::twice_area(mesh, triangle);
      const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(triangle.region)];
      std::array<mesh::Point, 3> gradients;
      for (int i = 0; i < 3; ++i) {
        const mesh::Point &next = node_of(triangle, i + 1), &last = node_of(triangle, i + 2);
        gradients[static_cast<std::size_t>(i)] =
            mesh::Point(next.y() - last.y(), last.x() - next.x()) / area2;
      }
      const Eigen::Index first = corner(static_cast<int>(t), 0);
      const bool is_linear = middles_[t] < 0;
      for (std::size_t at = 0; at < (is_linear ? 1U : 3U); ++at) {
        const mesh::Point& place = node_of(triangle, static_cast<int>(at));
        for (int row = 0; row < 2; ++row) {
          begin_equation(-problem_.force(soil, place)[row]);
          add(multiplier(), problem_.live_force(soil, place)[row]);
          for (std::size_t i = 0; i < 3; ++i) {
            // Of the Bezier points only the corner and the middles next to it have slopes there.
            const Eigen::Index stress =
                is_linear || i == at
                    ? first + 3 * static_cast<Eigen::Index>(i)
                    : middles_[t] + 3 * static_cast<Eigen::Index>((at + 1) % 3 == i ? at : i);
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
      for (const int node : {edge.first, edge.second}) {
        const Eigen::Index left = corner_at(edge.left, node);
        if (edge.right >= 0) {
          const Eigen::Index right = corner_at(edge.right, node);
          if (match_bare(left, right, side)) continue;
          for (const mesh::Point& direction : {side.normal, side.tangent}) {
            begin_equation(0.0);
            add(left, traction(side.normal, direction));
            add(right, traction(side.normal, direction), -1.0);
          }
          continue;
        }
        const problem::Boundary& boundary =
            problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
        if (is_bare_across(left, side.normal)) continue;
        if (boundary.normal == problem::Known::traction) {
          begin_equation(boundary.normal_stress);
          add(multiplier(), -boundary.live_normal_stress);
          add(left, traction(side.normal, side.normal));
        }
        if (boundary.tangential == problem::Known::traction) {
          begin_equation(boundary.shear_stress);
          add(multiplier(), -boundary.live_shear_stress);
          add(left, traction(side.normal, side.tangent));
        }
      }
      if (is_quadratic(edge.left) || is_quadratic(edge.right)) equilibrium_of_middle(edge, side);
    }
  }

  const problem::BareCorner* bare_of(Eigen::Index stress) const {
    return bare_points_[static_cast<std::size_t>(stress / 3)];
  }

  // Whether what is known of a corner is all that equilibrium with a free side asks for.
  bool is_bare_across(Eigen::Index stress, const mesh::Point& normal) const {
    const problem::BareCorner* bare = bare_of(stress);
    if (bare == nullptr) return false;
    return bare->bears == problem::BareCorner::Bears::nothing || is_one_line(bare->normal, normal);
  }
  static bool is_one_line(const mesh::Point& a, const mesh::Point& b) {
    constexpr double same = 1e-9;
    return std::abs(a.x() * b.y() - a.y() * b.x()) < same;
  }

  // Of two corners that bear along one face only, or nothing, what equilibrium is left: their
  // pressures are equal. Equations that follow from others would spoil the Newton systems.
  bool match_bare(Eigen::Index left, Eigen::Index right, const SideFrame& side) {
    using Bears = problem::BareCorner::Bears;
    const problem::BareCorner *first = bare_of(left), *second = bare_of(right);
    if (first == nullptr || second == nullptr) return false;
    const bool first_bears = first->bears == Bears::along,
               second_bears = second->bears == Bears::along;
    if (!first_bears && !second_bears) return true;
    if (first_bears && second_bears && !is_one_line(first->normal, second->normal)) return false;
    const mesh::Point& normal = first_bears ? first->normal : second->normal;
    const mesh::Point along(-normal.y(), normal.x());
    if (is_one_line(along, side.tangent)) return true;
    begin_equation(0.0);
    if (first_bears) add(left, traction(along, along));
    if (second_bears) add(right, traction(along, along), -1.0);
    return true;
  }

  // Tractions that are quadratic along a side are the same if their Bezier points are.
  void equilibrium_of_middle(const mesh::Edge& edge, const SideFrame& side) {
    const auto add_all = [&](int triangle, const mesh::Point& direction, double sign) {
      for (const auto& [stress, share] : middle_of(triangle, edge)) {
        add(stress, traction(side.normal, direction), sign * share);
      }
    };
    if (edge.right >= 0) {
      for (const mesh::Point& direction : {side.normal, side.tangent}) {
        begin_equation(0.0);
        add_all(edge.left, direction, 1.0);
        add_all(edge.right, direction, -1.0);
      }
      return;
    }
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (boundary.normal == problem::Known::traction) {
      begin_equation(boundary.normal_stress);
      add(multiplier(), -boundary.live_normal_stress);
      add_all(edge.left, side.normal, 1.0);
    }
    if (boundary.tangential == problem::Known::traction) {
      begin_equation(boundary.shear_stress);
      add(multiplier(), -boundary.live_shear_stress);
      add_all(edge.left, side.tangent, 1.0);
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
    if (is_quadratic(edge.left)) {
      add(corner_at(edge.left, edge.first),
          traction(side.normal, side.length / 12 * (3 * first + second)));
      add(middle_of(edge.left, edge).front().first,
          traction(side.normal, side.length / 6 * (first + second)));
      add(corner_at(edge.left, edge.second),
          traction(side.normal, side.length / 12 * (first + 3 * second)));
      return;
    }
    add(corner_at(edge.left, edge.first),
        traction(side.normal, side.length / 6 * (2 * first + second)));
    add(corner_at(edge.left, edge.second),
        traction(side.normal, side.length / 6 * (first + 2 * second)));
  }

  const problem::Problem& problem_;
  const Polygons& polygons_;
  std::vector<mesh::Edge> edges_;
  Overburden overburden_;
  std::vector<YieldCone> cones_;
  std::vector<Eigen::Vector3d> starts_;
  PolygonCones curves_{cones_, starts_};
  std::vector<Eigen::Index> middles_;  // first variable of a triangle's three; -1: none
  // The stress of a corner, and the variable that is its normal component.
  struct Contact {
    Eigen::Index stress, variable;
    mesh::Point normal;
  };
  std::vector<Contact> contacts_;
  std::vector<std::optional<YieldCone>> cuts_;                 // of the corners
  std::vector<problem::BareTriangle> bare_;                    // of the triangles
  std::vector<const problem::BareCorner*> bare_points_;        // as the cones of the stresses
  std::vector<std::pair<Eigen::Index, Eigen::Index>> copies_;  // first variables
  std::vector<Eigen::Triplet<double, Eigen::Index>> entries_;  // of the equations, row by row
  std::vector<double> right_side_;
};

}  // namespace

ConeProgram lower_bound_program(const problem::Problem& problem, const Polygons& polygons) {
  return Builder(problem, polygons).program();
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

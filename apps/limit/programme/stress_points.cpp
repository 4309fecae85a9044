#include "limit/programme/stress_points.hpp"

#include <algorithm>

#include "limit/problem/local_soil.hpp"

namespace limit::programme {

namespace {

// So that a solver's answer lies inside the true cone even after it was moved, by its tolerance,
// into equilibrium: much more than that of the solver, much less than a bracket.
constexpr double reserve = 1e-6;

}  // namespace

void add_form(algebra::EquationBuilder& equations, Eigen::Index stress, const Form& form,
              double factor) {
  for (Eigen::Index i = 0; i < 3; ++i) equations.add(stress + i, factor * form[i]);
}

StressPoints::StressPoints(const problem::Problem& problem, const Parabolas& parabolas,
                           const std::vector<mesh::Edge>& edges)
    : problem_(problem),
      parabolas_(parabolas),
      overburden_(problem),
      given_pressures_(given_pressures()),
      bare_(problem::bare_corners(problem)) {
  for (const problem::Soil& soil : problem.soils) {
    unconfined_.push_back(soil.is_curved() ? soil.envelope.unconfined() : 0.0);
  }
  add_cones();
  curves_.add_others();
  for (std::size_t point = 0; point < cuts_.size(); ++point) add_cut(point);
  for (std::size_t point = 0; point < cuts_.size(); ++point) add_pressure(point);
  for (const mesh::Edge& edge : edges) add_contacts(edge);
  if (problem.most_multiplier) {
    cones_.push_back(half_line_cone(*problem.most_multiplier));
    starts_.push_back(inner_point(cones_.back(), 0.0));
  }
}

Eigen::Index StressPoints::corner(int triangle, int node) const {
  const mesh::Triangle& nodes = problem_.mesh.triangles[static_cast<std::size_t>(triangle)];
  return 9 * triangle + 3 * mesh::corner_of(nodes, node);
}

const mesh::Point& StressPoints::node_of(const mesh::Triangle& triangle, int i) const {
  return problem_.mesh
      .nodes[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i % 3)])];
}

StressPoints::Shares StressPoints::middle(int triangle, const mesh::Edge& edge) const {
  const Eigen::Index first = corner(triangle, edge.first), second = corner(triangle, edge.second);
  const Eigen::Index own = middles_[static_cast<std::size_t>(triangle)];
  if (own < 0) return {{first, 0.5}, {second, 0.5}};
  const Eigen::Index i = first / 3 - 3 * triangle, j = second / 3 - 3 * triangle;
  return {{own + 3 * ((i + 1) % 3 == j ? i : j), 1.0}};
}

const problem::BareCorner* StressPoints::bare_at(std::size_t triangle, int point) const {
  if (bare_.empty()) return nullptr;
  const problem::BareCorner& corner = bare_[triangle][static_cast<std::size_t>(point)];
  return corner.bears == problem::BareCorner::Bears::all ? nullptr : &corner;
}

// A cohesion is linear, as the stress is, so that the corners decide; under a weight that is
// linear the stress is quadratic, and its Bezier points do: of a linear cohesion they are its
// values at the middles of sides.
void StressPoints::add_cones() {
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

std::vector<std::optional<double>> StressPoints::given_pressures() const {
  std::vector<std::optional<double>> given(problem_.mesh.nodes.size());
  for (const mesh::BoundaryEdge& edge : problem_.mesh.boundary) {
    const problem::Boundary& side = problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (side.normal != problem::Known::traction) continue;
    for (const int node : {edge.first, edge.second}) {
      std::optional<double>& pressure = given[static_cast<std::size_t>(node)];
      pressure = std::min(pressure.value_or(-side.normal_stress), -side.normal_stress);
    }
  }
  return given;
}

// The parabola that touches at a pressure bears nothing at some lower one, and may end above what a
// face allows: more than half the unconfined strength above it is no guess there, whatever is
// heaped up beside it.
double StressPoints::guess(const problem::Soil& soil, int region, int node) const {
  const double beside_none = unconfined_[static_cast<std::size_t>(region)] / 2.0;
  if (parabolas_.guesses_least()) return beside_none;
  const auto& given = given_pressures_[static_cast<std::size_t>(node)];
  const mesh::Point& place = problem_.mesh.nodes[static_cast<std::size_t>(node)];
  return beside_none + (given ? *given : overburden_.at(soil, place));
}

void StressPoints::add_curved(const mesh::Triangle& triangle, int i) {
  const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(triangle.region)];
  const mesh::Point& place = node_of(triangle, i);
  const mesh::Point centre =
      (node_of(triangle, 0) + node_of(triangle, 1) + node_of(triangle, 2)) / 3.0;
  const CurvedPoint point{0, triangle.region, false, towards(place, centre)};
  const double pressure = guess(soil, triangle.region, triangle.nodes[static_cast<std::size_t>(i)]);
  curves_.add(soil.envelope, parabolas_.at(soil, point, pressure, problem::Bound::lower), point,
              reserve);
  cuts_.emplace_back();
  bare_points_.push_back(nullptr);
}

void StressPoints::add_cone(const problem::Soil& local, const mesh::Point& place,
                            const problem::BareCorner* bare) {
  const problem::Soil soil = local.with_cohesion(local.cohesion_at(place));
  const double load = overburden_.at(soil, place);
  cones_.push_back(yield_cone(soil, load, reserve));
  // What is nothing anyway is to lie within a cone.
  if (bare != nullptr && bare->bears == problem::BareCorner::Bears::nothing && soil.is_loose()) {
    cones_.back() = {1.0, cones_.back().slope, 1.0};
  }
  starts_.push_back(inner_point(cones_.back(), load));
  const bool is_cut = soil.cuts_tension() && bare == nullptr;
  cuts_.push_back(is_cut ? std::optional(tension_cone(soil, load, reserve)) : std::nullopt);
  bare_points_.push_back(bare);
}

// The stress of a corner once more, in Rankine's cone.
void StressPoints::add_cut(std::size_t corner) {
  if (!cuts_[corner]) return;
  copies_.emplace_back(static_cast<Eigen::Index>(3 * corner), multiplier());
  cones_.push_back(*cuts_[corner]);
  starts_.push_back(inner_point(cones_.back(), -starts_[corner][0]));
}

// What a corner at a free face bears is a pressure along it, or nothing.
void StressPoints::add_pressure(std::size_t point) {
  const problem::BareCorner* bare = bare_points_[point];
  if (bare == nullptr || bare->bears == problem::BareCorner::Bears::nothing) return;
  contacts_.push_back({static_cast<Eigen::Index>(3 * point), multiplier(),
                       mesh::Point(-bare->normal.y(), bare->normal.x())});
  cones_.push_back(half_line_cone(cones_[point].scale));
  starts_.push_back(inner_point(cones_.back(), 0.0));
}

// Cones of the normal stress at both ends of a side that may open.
void StressPoints::add_contacts(const mesh::Edge& edge) {
  if (edge.boundary < 0) return;
  if (!problem_.boundaries[static_cast<std::size_t>(edge.boundary)].may_open) return;
  // Soil without cohesion bears no tension by itself.
  const mesh::Triangle& left = problem_.mesh.triangles[static_cast<std::size_t>(edge.left)];
  if (problem_.soils[static_cast<std::size_t>(left.region)].is_loose()) return;
  const mesh::Point normal = SideFrame(problem_.mesh, edge).normal;
  std::vector<Eigen::Index> stresses{corner(edge.left, edge.first), corner(edge.left, edge.second)};
  if (is_quadratic(edge.left)) stresses.push_back(middle(edge.left, edge).front().first);
  for (const Eigen::Index stress : stresses) {
    contacts_.push_back({stress, multiplier(), normal});
    cones_.push_back(contact_cone(cones_[static_cast<std::size_t>(stress / 3)].scale, reserve));
    starts_.push_back(inner_point(cones_.back(), 0.0));
  }
}

void StressPoints::copies(algebra::EquationBuilder& equations) const {
  for (const auto& [stress, copy] : copies_) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      equations.begin(0.0);
      equations.add(stress + i, 1.0);
      equations.add(copy + i, -1.0);
    }
  }
}

void StressPoints::contacts(algebra::EquationBuilder& equations) const {
  for (const Contact& contact : contacts_) {
    equations.begin(0.0);
    add_form(equations, contact.stress, traction(contact.normal, contact.normal));
    equations.add(contact.variable, -1.0);
  }
}

void StressPoints::bare_corners(algebra::EquationBuilder& equations) const {
  for (std::size_t point = 0; point < bare_points_.size(); ++point) {
    const problem::BareCorner* bare = bare_points_[point];
    if (bare == nullptr) continue;
    const auto stress = static_cast<Eigen::Index>(3 * point);
    const bool is_nothing = bare->bears == problem::BareCorner::Bears::nothing;
    // A corner between others may have no face of its own.
    const mesh::Point normal = is_nothing ? mesh::Point(1.0, 0.0) : bare->normal,
                      along(-normal.y(), normal.x());
    const mesh::Point axes[] = {normal, along};
    for (const mesh::Point& direction : axes) {
      equations.begin(0.0);
      add_form(equations, stress, traction(normal, direction));
    }
    if (!is_nothing) continue;
    equations.begin(0.0);
    add_form(equations, stress, traction(along, along));
  }
}

void StressPoints::equations(algebra::EquationBuilder& equations) const {
  contacts(equations);
  copies(equations);
  bare_corners(equations);
  curves_.equations(equations);
  if (!problem_.most_multiplier) return;
  // What is left to the most, in a cone of its own, the last one.
  equations.begin(*problem_.most_multiplier);
  equations.add(multiplier(), 1.0);
  equations.add(multiplier() - 3, -1.0);
}

}  // namespace limit::programme

#include "limit/certificate/ceilings.hpp"

#include <algorithm>
#include <cmath>

#include "limit/problem/local_soil.hpp"

namespace limit::certificate {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

// @param whole  the soil that `soil` is that of a triangle of; what is curved does not change
void add_ceilings(Eigen::Index point, const problem::Soil& soil, const problem::Soil& whole,
                  const mesh::Point& place, std::vector<Ceiling>& ceilings) {
  Ceiling ceiling{point, Ceiling::Kind::yield};
  ceiling.cohesive = soil.cohesion_at(place) * std::cos(soil.friction_angle);
  ceiling.sine = std::sin(soil.friction_angle);
  ceiling.tension = soil.tension;
  ceiling.is_loose = whole.is_loose();
  if (whole.is_curved()) ceiling.curve = &whole.envelope;
  ceilings.push_back(ceiling);
  if (!soil.cuts_tension()) return;
  ceiling.kind = Ceiling::Kind::tension;
  ceilings.push_back(ceiling);
}

// Where soil without tension bears along a face or nothing, traction on the face is a matter of
// equilibrium, whose residual it is in: no stress there is strictly within the cone.
void keep_to_bare_points(const problem::Problem& problem, const StressLayout& layout,
                         std::vector<Ceiling>& ceilings) {
  const std::map<Eigen::Index, problem::BareCorner> bare = bare_points(problem, layout);
  std::erase_if(ceilings, [&](Ceiling& ceiling) {
    const auto found = bare.find(ceiling.point);
    if (found == bare.end()) return false;
    if (ceiling.kind == Ceiling::Kind::yield) {
      return ceiling.is_loose && found->second.bears == problem::BareCorner::Bears::nothing;
    }
    if (ceiling.kind != Ceiling::Kind::tension) return false;
    ceiling.kind = Ceiling::Kind::along;
    ceiling.normal = found->second.normal;
    return found->second.bears == problem::BareCorner::Bears::nothing;
  });
}

}  // namespace

std::map<Eigen::Index, problem::BareCorner> bare_points(const problem::Problem& problem,
                                                        const StressLayout& layout) {
  std::map<Eigen::Index, problem::BareCorner> points;
  const std::vector<problem::BareTriangle> bare = problem::bare_corners(problem);
  for (std::size_t t = 0; t < bare.size(); ++t) {
    for (std::size_t i = 0; i < 6; ++i) {
      if (bare[t][i].bears == problem::BareCorner::Bears::all) continue;
      if (i >= 3 && layout.middles(t) < 0) continue;
      const Eigen::Index at = i < 3 ? static_cast<Eigen::Index>(9 * t + 3 * i)
                                    : layout.middles(t) + static_cast<Eigen::Index>(3 * i - 9);
      points.emplace(at, bare[t][i]);
    }
  }
  return points;
}

std::vector<Ceiling> ceilings_of(const problem::Problem& problem) {
  std::vector<Ceiling> ceilings;
  const mesh::Mesh& mesh = problem.mesh;
  const StressLayout layout(problem);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    // No stronger than the triangle is anywhere.
    const problem::Soil soil = problem::soil_in(problem, mesh.triangles[t], problem::Bound::lower);
    const problem::Soil& whole = problem.soils[static_cast<std::size_t>(mesh.triangles[t].region)];
    const auto corner = [&](Eigen::Index i) -> const mesh::Point& {
      return node_at(mesh, mesh.triangles[t].nodes[static_cast<std::size_t>(i % 3)]);
    };
    for (Eigen::Index i = 0; i < 3; ++i) {
      add_ceilings(static_cast<Eigen::Index>(9 * t) + 3 * i, soil, whole, corner(i), ceilings);
      if (layout.middles(t) < 0) continue;
      add_ceilings(layout.middles(t) + 3 * i, soil, whole, (corner(i) + corner(i + 1)) / 2.0,
                   ceilings);
    }
  }
  keep_to_bare_points(problem, layout, ceilings);
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    if (edge.boundary < 0) continue;
    if (!problem.boundaries[static_cast<std::size_t>(edge.boundary)].may_open) continue;
    // Soil without cohesion bears no tension: yield says so.
    const auto left = static_cast<std::size_t>(edge.left);
    if (problem.soils[static_cast<std::size_t>(mesh.triangles[left].region)].is_loose()) continue;
    const mesh::Point along = (node_at(mesh, edge.second) - node_at(mesh, edge.first)).normalized();
    Ceiling ceiling{0, Ceiling::Kind::contact};
    ceiling.normal = {along.y(), -along.x()};
    std::vector<Eigen::Index> points{corner_index(mesh, edge.left, edge.first),
                                     corner_index(mesh, edge.left, edge.second)};
    if (layout.is_quadratic(edge.left)) {
      points.push_back(layout.middle(edge.left, edge.first, edge.second).front().first);
    }
    for (const Eigen::Index point : points) {
      ceiling.point = point;
      ceilings.push_back(ceiling);
    }
  }
  return ceilings;
}

double excess(const Ceiling& ceiling, const Eigen::VectorXd& field) {
  const auto stress = field.segment<3>(ceiling.point);
  if (ceiling.kind == Ceiling::Kind::contact) {
    const mesh::Point& n = ceiling.normal;
    return n.x() * n.x() * stress[0] + n.y() * n.y() * stress[1] + 2.0 * n.x() * n.y() * stress[2];
  }
  if (ceiling.kind == Ceiling::Kind::along) {
    const mesh::Point& n = ceiling.normal;
    return n.y() * n.y() * stress[0] + n.x() * n.x() * stress[1] - 2.0 * n.x() * n.y() * stress[2];
  }
  const double mean = (stress[0] + stress[1]) / 2.0;
  const double radius = std::hypot((stress[0] - stress[1]) / 2.0, stress[2]);
  if (ceiling.kind == Ceiling::Kind::tension) {
    return mean + radius - ceiling.tension;
  }
  if (ceiling.curve != nullptr) {
    const double beyond = mean - ceiling.curve->apex();
    return radius - ceiling.curve->radius_about(-mean) + std::max(0.0, beyond);
  }
  return radius - (ceiling.cohesive - mean * ceiling.sine);
}

double share_of_rest(const Ceiling& ceiling, const Eigen::VectorXd& field,
                     const Eigen::VectorXd& rest) {
  const double here = excess(ceiling, field), resting = excess(ceiling, rest);
  // Convex: at the share t of rest the excess is at most (1 - t) here + t resting.
  if (ceiling.curve == nullptr || ceiling.kind != Ceiling::Kind::yield) {
    return here / (here - resting);
  }
  // The excess of a curved envelope is not, but what is within it is convex.
  double outside = 0.0, inside = 1.0;
  constexpr double close = 1e-12;
  while (inside - outside > close) {
    const double middle = (inside + outside) / 2.0;
    const Eigen::VectorXd point =
        (1.0 - middle) * field.segment<3>(ceiling.point) + middle * rest.segment<3>(ceiling.point);
    Ceiling alone = ceiling;
    alone.point = 0;
    (excess(alone, point) > 0.0 ? outside : inside) = middle;
  }
  return inside;
}

}  // namespace limit::certificate

#include "limit/certificate/lower_certificate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "limit/algebra/equation_builder.hpp"
#include "limit/algebra/least_change.hpp"
#include "limit/certificate/stress_layout.hpp"
#include "limit/problem/bare_corners.hpp"
#include "limit/problem/local_soil.hpp"

namespace limit::certificate {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

// Where soil without tension bears along a free face alone, or nothing, by the place of its stress.
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

/// All the equations of equilibrium in the corners' (xx, yy, xy); the multiplier is given.
class BalanceEquations {
 public:
  BalanceEquations(const problem::Problem& problem, double multiplier)
      : problem_(problem), layout_(problem), multiplier_(multiplier) {
    const mesh::Mesh& mesh = problem.mesh;
    const std::vector<mesh::Edge> edges = mesh::edges_of(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (layout_.middles(t) < 0) {
        balance(static_cast<int>(t));
      } else {
        balance_everywhere(t);
      }
    }
    for (const mesh::Edge& edge : edges) {
      for (const int node : {edge.first, edge.second}) {
        match(edge, {{corner_index(mesh, edge.left, node), 1.0}},
              {{edge.right < 0 ? -1 : corner_index(mesh, edge.right, node), 1.0}});
      }
      if (!layout_.is_quadratic(edge.left) && !layout_.is_quadratic(edge.right)) continue;
      match(edge, layout_.middle(edge.left, edge.first, edge.second),
            edge.right < 0 ? Shares() : layout_.middle(edge.right, edge.first, edge.second));
    }
    leave_free_faces_bare();
    for (std::size_t motion = 0; motion < 3; ++motion) {
      const problem::Footing& footing = problem.footing;
      if (!footing.may_move[motion]) continue;
      equations_.begin(footing.dead_load[motion] + multiplier * footing.live_load[motion]);
      for (const mesh::Edge& edge : edges) {
        if (edge.boundary >= 0) resultant(edge, static_cast<int>(motion));
      }
    }
  }

  [[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> matrix() const {
    return equations_.matrix(layout_.size());
  }
  [[nodiscard]] Eigen::VectorXd right_side() const { return equations_.right_side(); }

 private:
  using Shares = std::vector<std::pair<Eigen::Index, double>>;

  // direction . sigma . normal of a corner
  void add(Eigen::Index corner, const mesh::Point& normal, const mesh::Point& direction,
           double factor) {
    equations_.add(corner, factor * normal.x() * direction.x());
    equations_.add(corner + 1, factor * normal.y() * direction.y());
    equations_.add(corner + 2, factor * (normal.x() * direction.y() + normal.y() * direction.x()));
  }

  // The forces on the outline of a triangle carry its weight.
  void balance(int triangle) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Triangle& nodes = mesh.triangles[static_cast<std::size_t>(triangle)];
    double perimeter = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      perimeter += (node_at(mesh, nodes.nodes[i]) - node_at(mesh, nodes.nodes[(i + 1) % 3])).norm();
    }
    const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(nodes.region)];
    const mesh::Point weight = force(soil, soil.centre) * mesh::twice_area(mesh, nodes) / 2.0;
    for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
      equations_.begin(-direction.dot(weight) / perimeter);
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = nodes.nodes[i], b = nodes.nodes[(i + 1) % 3];
        const mesh::Point along = node_at(mesh, b) - node_at(mesh, a);
        const mesh::Point outward(along.y(), -along.x());
        add(corner_index(mesh, triangle, a), outward, direction, 0.5 / perimeter);
        add(corner_index(mesh, triangle, b), outward, direction, 0.5 / perimeter);
      }
    }
  }

  [[nodiscard]] mesh::Point force(const problem::Soil& soil, const mesh::Point& place) const {
    return soil.unit_weight_at(place) * problem_.pull + soil.seepage +
           multiplier_ * (soil.live_unit_weight_at(place) * problem_.live_pull + soil.live_seepage);
  }

  // The divergence of a quadratic stress is linear: it is the weight everywhere if it is in the
  // corners. There it is the slopes along the two sides that meet, each twice the way from the
  // corner's Bezier point to the side's.
  void balance_everywhere(std::size_t triangle) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Triangle& nodes = mesh.triangles[triangle];
    const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(nodes.region)];
    const double area = mesh::twice_area(mesh, nodes) / 2.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const mesh::Point &a = node_at(mesh, nodes.nodes[i]), &b = node_at(mesh, nodes.nodes[j]),
                        &c = node_at(mesh, nodes.nodes[k]);
      Eigen::Matrix2d sides;
      sides.row(0) = (b - a).transpose();
      sides.row(1) = (c - a).transpose();
      const Eigen::Matrix2d back = sides.inverse();  // gradient = back x slopes along the sides
      const double scale = area / ((b - a).norm() + (c - b).norm() + (a - c).norm());
      const mesh::Point to_b = 2.0 * scale * back.col(0), to_c = 2.0 * scale * back.col(1);
      const auto own = static_cast<Eigen::Index>(9 * triangle + 3 * i);
      const Eigen::Index at_b = layout_.middles(triangle) + 3 * static_cast<Eigen::Index>(i),
                         at_c = layout_.middles(triangle) + 3 * static_cast<Eigen::Index>(k);
      for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
        equations_.begin(-scale * direction.dot(force(soil, a)));
        add(own, to_b + to_c, direction, -1.0);
        add(at_b, to_b, direction, 1.0);
        add(at_c, to_c, direction, 1.0);
      }
    }
  }

  // No equations of equilibrium, but without them rounding would make tensions of them.
  void leave_free_faces_bare() {
    for (const auto& [at, corner] : bare_points(problem_, layout_)) {
      if (corner.bears == problem::BareCorner::Bears::nothing) {
        for (Eigen::Index row = 0; row < 3; ++row) {
          equations_.begin(0.0);
          equations_.add(at + row, 1.0);
        }
        continue;
      }
      for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
        equations_.begin(0.0);
        add(at, corner.normal, direction, 1.0);
      }
    }
  }

  // Both sides' tractions agree, or the side's is the one prescribed.
  void match(const mesh::Edge& edge, const Shares& left, const Shares& right) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Point tangent =
        (node_at(mesh, edge.second) - node_at(mesh, edge.first)).normalized();
    const mesh::Point normal(tangent.y(), -tangent.x());
    const auto add_all = [&](const Shares& points, const mesh::Point& direction, double sign) {
      for (const auto& [at, share] : points) add(at, normal, direction, sign * share);
    };
    if (edge.right >= 0) {
      for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
        equations_.begin(0.0);
        add_all(left, direction, 1.0);
        add_all(right, direction, -1.0);
      }
      return;
    }
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (boundary.normal == problem::Known::traction) {
      equations_.begin(boundary.normal_stress + multiplier_ * boundary.live_normal_stress);
      add_all(left, normal, 1.0);
    }
    if (boundary.tangential == problem::Known::traction) {
      equations_.begin(boundary.shear_stress + multiplier_ * boundary.live_shear_stress);
      add_all(left, tangent, 1.0);
    }
  }

  // Simpson's rule on traction x motion, both linear; a quadratic traction is (t0 + 2 t1 + t2) / 4
  // in the middle, and the rule is exact for cubics.
  void resultant(const mesh::Edge& edge, int motion) {
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (boundary.normal != problem::Known::footing &&
        boundary.tangential != problem::Known::footing)
      return;
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Point &a = node_at(mesh, edge.first), &b = node_at(mesh, edge.second);
    const mesh::Point outward((b - a).y(), -(b - a).x());
    const auto motion_at = [&](const mesh::Point& at) {
      if (motion < 2) return mesh::Point(motion == 0 ? 1 : 0, motion == 0 ? 0 : 1);
      return mesh::Point(problem_.footing.centre.y() - at.y(),
                         at.x() - problem_.footing.centre.x());
    };
    const Eigen::Index first = corner_index(mesh, edge.left, edge.first);
    const Eigen::Index second = corner_index(mesh, edge.left, edge.second);
    const mesh::Point middle = motion_at((a + b) / 2.0);
    if (layout_.is_quadratic(edge.left)) {
      add(first, outward, motion_at(a) + middle, 1.0 / 6.0);
      add(second, outward, motion_at(b) + middle, 1.0 / 6.0);
      add(layout_.middle(edge.left, edge.first, edge.second).front().first, outward, middle,
          2.0 / 6.0);
      return;
    }
    add(first, outward, motion_at(a) + 2.0 * middle, 1.0 / 6.0);
    add(second, outward, motion_at(b) + 2.0 * middle, 1.0 / 6.0);
  }

  const problem::Problem& problem_;
  StressLayout layout_;
  double multiplier_;
  algebra::EquationBuilder equations_;
};

// What no stress may exceed: yield in each triangle's corner, tension where it is cut off (along
// the face alone where nothing else is borne), none where a footing may lift off.
struct Ceiling {
  enum class Kind { yield, tension, along, contact };
  Eigen::Index point = 0;
  Kind kind = Kind::yield;
  double cohesive = 0.0, sine = 0.0;         // c cos(phi), linear as the stress between points is
  double tension = 0.0;                      // the soil's
  mesh::Point normal{0.0, 0.0};              // of a contact, of a face
  const problem::Envelope* curve = nullptr;  // of a yield that is not c and phi's
};

// @param whole  the soil that `soil` is that of a triangle of; what is curved does not change
void add_ceilings(Eigen::Index point, const problem::Soil& soil, const problem::Soil& whole,
                  const mesh::Point& place, std::vector<Ceiling>& ceilings) {
  Ceiling ceiling{point, Ceiling::Kind::yield};
  ceiling.cohesive = soil.cohesion_at(place) * std::cos(soil.friction_angle);
  ceiling.sine = std::sin(soil.friction_angle);
  ceiling.tension = soil.tension;
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
    if (ceiling.kind != Ceiling::Kind::tension || found == bare.end()) return false;
    ceiling.kind = Ceiling::Kind::along;
    ceiling.normal = found->second.normal;
    return found->second.bears == problem::BareCorner::Bears::nothing;
  });
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

// Radius of Mohr's circle less the one that yields, over a stress that cannot vanish; or tension,
// of the larger principal stress less the soil's.
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

// How far a stress that is outside has to be drawn towards one that is strictly within.
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

Eigen::VectorXd as_vector(const problem::Problem& problem, const problem::StressField& field) {
  const StressLayout layout(problem);
  Eigen::VectorXd x(layout.size());
  for (std::size_t t = 0; t < field.size(); ++t) {
    x.segment<9>(static_cast<Eigen::Index>(9 * t)) = field[t].leftCols<3>().reshaped();
    if (layout.middles(t) < 0) continue;
    auto middles = x.segment<9>(layout.middles(t));
    if (field[t].cols() == 6) {
      middles = field[t].rightCols<3>().reshaped();
      continue;
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
      middles.segment<3>(3 * i) = (field[t].col(i) + field[t].col((i + 1) % 3)) / 2.0;
    }
  }
  return x;
}

problem::StressField as_field(const problem::Problem& problem, const Eigen::VectorXd& x) {
  const StressLayout layout(problem);
  problem::StressField field(problem.mesh.triangles.size());
  for (std::size_t t = 0; t < field.size(); ++t) {
    field[t].resize(3, layout.middles(t) < 0 ? 3 : 6);
    field[t].leftCols<3>() = x.segment<9>(static_cast<Eigen::Index>(9 * t)).reshaped(3, 3);
    if (layout.middles(t) < 0) continue;
    field[t].rightCols<3>() = x.segment<9>(layout.middles(t)).reshaped(3, 3);
  }
  return field;
}

/// Every column of soil under its own dead weight and the largest surcharge, equal in all
/// directions.
problem::StressField geostatic(const problem::Problem& problem) {
  const mesh::Mesh& mesh = problem.mesh;
  double top = mesh.nodes.front().y();
  for (const mesh::Point& node : mesh.nodes) top = std::max(top, node.y());
  double surcharge = 0.0;
  for (const problem::Boundary& boundary : problem.boundaries) {
    surcharge = std::max(surcharge, -boundary.normal_stress);
  }
  problem::StressField field(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const mesh::Triangle& triangle = mesh.triangles[t];
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(triangle.region)];
    // The mean weight above a place is that half way up.
    const auto stress_at = [&](const mesh::Point& place) {
      const mesh::Point half_way(place.x(), (place.y() + top) / 2.0);
      const double weight = -problem.pull.y() * soil.unit_weight_at(half_way) - soil.seepage.y();
      return -surcharge - weight * (top - place.y());
    };
    field[t].setZero(3, soil.has_uneven_weight() ? 6 : 3);
    for (Eigen::Index i = 0; i < field[t].cols(); ++i) {
      const mesh::Point &a = node_at(mesh, triangle.nodes[static_cast<std::size_t>(i % 3)]),
                        &b = node_at(mesh, triangle.nodes[static_cast<std::size_t>((i + 1) % 3)]);
      const double stress =
          i < 3 ? stress_at(a)
                : 2.0 * stress_at((a + b) / 2.0) - (stress_at(a) + stress_at(b)) / 2.0;
      field[t].col(i) << stress, stress, 0.0;
    }
  }
  return field;
}

/// A state in equilibrium that needs little or no strength, and its multiplier.
struct Rest {
  Eigen::VectorXd stress;
  double multiplier = 0.0;
};

/// Level ground under its weight and surcharge, or nothing at all where no dead load is; none if
/// neither is in equilibrium at any multiplier, as under a slope.
std::optional<Rest> rest_of(const problem::Problem& problem) {
  const BalanceEquations equilibrium(problem, 0.0);
  const auto equations = equilibrium.matrix();
  const Eigen::VectorXd live =
      BalanceEquations(problem, 1.0).right_side() - equilibrium.right_side();
  const problem::StressField nothing(problem.mesh.triangles.size(), Eigen::Matrix3d::Zero());
  for (const problem::StressField& field : {geostatic(problem), nothing}) {
    const Eigen::VectorXd x = as_vector(problem, field);
    const Eigen::VectorXd carried = equations * x - equilibrium.right_side();
    const double multiplier = carried.dot(live) / live.squaredNorm();
    constexpr double balanced = 1e-9;
    if ((carried - multiplier * live).lpNorm<Eigen::Infinity>() < balanced) {
      return Rest{x, multiplier};
    }
  }
  return std::nullopt;
}

}  // namespace

LowerCertificate certify_lower(const problem::Problem& problem,
                               const problem::StressField& proposed, double multiplier) {
  LowerCertificate certificate;
  certificate.proposed = multiplier;
  certificate.multiplier = multiplier;
  const BalanceEquations equilibrium(problem, multiplier);
  const auto equations = equilibrium.matrix();
  Eigen::VectorXd x = as_vector(problem, proposed);
  certificate.residual = algebra::satisfy(equations, equilibrium.right_side(), x);

  const std::optional<Rest> rest = rest_of(problem);
  const std::vector<Ceiling> ceilings = ceilings_of(problem);
  certificate.yield_excess = -INFINITY;
  double drawn = 0.0;
  bool inside = true;
  for (const Ceiling& ceiling : ceilings) {
    const double here = excess(ceiling, x);
    certificate.yield_excess = std::max(certificate.yield_excess, here);
    if (here <= 0.0) continue;
    inside = inside && rest && excess(ceiling, rest->stress) < 0.0;
    if (inside) drawn = std::max(drawn, share_of_rest(ceiling, x, rest->stress));
  }
  if (drawn > 0.0 && inside) {
    constexpr double more = 1.0 + 1e-6;  // so that rounding does not undo it
    drawn = std::min(1.0, drawn * more);
    certificate.kept = 1.0 - drawn;
    x = certificate.kept * x + drawn * rest->stress;
    certificate.multiplier = certificate.kept * multiplier + drawn * rest->multiplier;
    const BalanceEquations after(problem, certificate.multiplier);
    certificate.residual = (after.matrix() * x - after.right_side()).lpNorm<Eigen::Infinity>();
    for (const Ceiling& ceiling : ceilings) inside = inside && excess(ceiling, x) <= 0.0;
  }
  certificate.field = as_field(problem, x);
  // Relative to stresses up to the multiplier's size, in the problem's units of order one.
  const double rounding = 1e-10 * std::max(1.0, std::abs(multiplier));
  certificate.holds = inside && certificate.residual < rounding;
  return certificate;
}

}  // namespace limit::certificate

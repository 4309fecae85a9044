#include "limit/certificate/lower_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "limit/algebra/equation_builder.hpp"
#include "limit/algebra/least_change.hpp"

namespace limit::certificate {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

Eigen::Index corner_index(const mesh::Mesh& mesh, int triangle, int node) {
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(triangle)].nodes;
  return 9 * triangle + 3 * (std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
}

/// All the equations of equilibrium in the corners' (xx, yy, xy); the multiplier is given.
class BalanceEquations {
 public:
  BalanceEquations(const problem::Problem& problem, double multiplier)
      : problem_(problem), multiplier_(multiplier) {
    const mesh::Mesh& mesh = problem.mesh;
    const std::vector<mesh::Edge> edges = mesh::edges_of(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) balance(static_cast<int>(t));
    for (const mesh::Edge& edge : edges) {
      for (const int node : {edge.first, edge.second}) match(edge, node);
    }
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
    return equations_.matrix(static_cast<Eigen::Index>(9 * problem_.mesh.triangles.size()));
  }
  [[nodiscard]] Eigen::VectorXd right_side() const { return equations_.right_side(); }

 private:
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
    const mesh::Point force =
        (soil.unit_weight * problem_.pull + soil.seepage +
         multiplier_ * (soil.live_unit_weight * problem_.live_pull + soil.live_seepage)) *
        mesh::twice_area(mesh, nodes) / 2.0;
    for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
      equations_.begin(-direction.dot(force) / perimeter);
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = nodes.nodes[i], b = nodes.nodes[(i + 1) % 3];
        const mesh::Point along = node_at(mesh, b) - node_at(mesh, a);
        const mesh::Point outward(along.y(), -along.x());
        add(corner_index(mesh, triangle, a), outward, direction, 0.5 / perimeter);
        add(corner_index(mesh, triangle, b), outward, direction, 0.5 / perimeter);
      }
    }
  }

  // Both sides' tractions agree, or the side's is the one prescribed.
  void match(const mesh::Edge& edge, int node) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Point tangent =
        (node_at(mesh, edge.second) - node_at(mesh, edge.first)).normalized();
    const mesh::Point normal(tangent.y(), -tangent.x());
    const Eigen::Index left = corner_index(mesh, edge.left, node);
    if (edge.right >= 0) {
      const Eigen::Index right = corner_index(mesh, edge.right, node);
      for (const mesh::Point& direction : {mesh::Point(1, 0), mesh::Point(0, 1)}) {
        equations_.begin(0.0);
        add(left, normal, direction, 1.0);
        add(right, normal, direction, -1.0);
      }
      return;
    }
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (boundary.normal == problem::Known::traction) {
      equations_.begin(boundary.normal_stress + multiplier_ * boundary.live_normal_stress);
      add(left, normal, normal, 1.0);
    }
    if (boundary.tangential == problem::Known::traction) {
      equations_.begin(boundary.shear_stress + multiplier_ * boundary.live_shear_stress);
      add(left, normal, tangent, 1.0);
    }
  }

  // Simpson's rule on traction x motion, both linear.
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
    add(first, outward, motion_at(a) + 2.0 * middle, 1.0 / 6.0);
    add(second, outward, motion_at(b) + 2.0 * middle, 1.0 / 6.0);
  }

  const problem::Problem& problem_;
  double multiplier_;
  algebra::EquationBuilder equations_;
};

// What no stress may exceed: yield in each triangle's corner, tension where it is cut off, none
// where a footing may lift off.
struct Ceiling {
  Eigen::Index corner = 0;
  const problem::Soil* soil = nullptr;  // none: no tension
  double cohesion = 0.0;                // there; linear, as the stress between corners is
  mesh::Point normal{0.0, 0.0};
  bool is_cut = false;  // the soil's cut-off instead of its yield
};

std::vector<Ceiling> ceilings_of(const problem::Problem& problem) {
  std::vector<Ceiling> ceilings;
  const mesh::Mesh& mesh = problem.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(mesh.triangles[t].region)];
    for (int i = 0; i < 3; ++i) {
      const int node = mesh.triangles[t].nodes[static_cast<std::size_t>(i)];
      ceilings.push_back(
          {static_cast<Eigen::Index>(9 * t) + 3 * i, &soil, soil.cohesion_at(node_at(mesh, node))});
      if (!soil.cuts_tension()) continue;
      ceilings.push_back(ceilings.back());
      ceilings.back().is_cut = true;
    }
  }
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    if (edge.boundary < 0) continue;
    if (!problem.boundaries[static_cast<std::size_t>(edge.boundary)].may_open) continue;
    const mesh::Point along = (node_at(mesh, edge.second) - node_at(mesh, edge.first)).normalized();
    for (const int node : {edge.first, edge.second}) {
      ceilings.push_back(
          {corner_index(mesh, edge.left, node), nullptr, 0.0, mesh::Point(along.y(), -along.x())});
    }
  }
  return ceilings;
}

// Radius of Mohr's circle less the one that yields, over a stress that cannot vanish; or tension,
// of the larger principal stress less the soil's.
double excess(const Ceiling& ceiling, const Eigen::VectorXd& field) {
  const auto stress = field.segment<3>(ceiling.corner);
  if (ceiling.soil == nullptr) {
    const mesh::Point& n = ceiling.normal;
    return n.x() * n.x() * stress[0] + n.y() * n.y() * stress[1] + 2.0 * n.x() * n.y() * stress[2];
  }
  const double mean = (stress[0] + stress[1]) / 2.0;
  const double radius = std::hypot((stress[0] - stress[1]) / 2.0, stress[2]);
  const problem::Soil& soil = *ceiling.soil;
  if (ceiling.is_cut) return mean + radius - soil.tension;
  if (soil.is_curved()) {
    const double beyond = mean - soil.envelope.apex();
    return radius - soil.envelope.radius_about(-mean) + std::max(0.0, beyond);
  }
  const double strength =
      ceiling.cohesion * std::cos(soil.friction_angle) - mean * std::sin(soil.friction_angle);
  return radius - strength;
}

// How far a stress that is outside has to be drawn towards one that is strictly within.
double share_of_rest(const Ceiling& ceiling, const Eigen::VectorXd& field,
                     const Eigen::VectorXd& rest) {
  const double here = excess(ceiling, field), resting = excess(ceiling, rest);
  // Convex: at the share t of rest the excess is at most (1 - t) here + t resting.
  if (ceiling.soil == nullptr || !ceiling.soil->is_curved()) return here / (here - resting);
  // The excess of a curved envelope is not, but what is within it is convex.
  double outside = 0.0, inside = 1.0;
  constexpr double close = 1e-12;
  while (inside - outside > close) {
    const double middle = (inside + outside) / 2.0;
    const Eigen::VectorXd corner = (1.0 - middle) * field.segment<3>(ceiling.corner) +
                                   middle * rest.segment<3>(ceiling.corner);
    Ceiling alone = ceiling;
    alone.corner = 0;
    (excess(alone, corner) > 0.0 ? outside : inside) = middle;
  }
  return inside;
}

Eigen::VectorXd as_vector(const problem::StressField& field) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(9 * field.size()));
  for (std::size_t t = 0; t < field.size(); ++t) {
    x.segment<9>(static_cast<Eigen::Index>(9 * t)) = field[t].reshaped();
  }
  return x;
}

problem::StressField as_field(const Eigen::VectorXd& x) {
  problem::StressField field(static_cast<std::size_t>(x.size() / 9));
  for (std::size_t t = 0; t < field.size(); ++t) {
    field[t] = x.segment<9>(static_cast<Eigen::Index>(9 * t)).reshaped(3, 3);
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
    const double weight = -problem.pull.y() * soil.unit_weight - soil.seepage.y();
    for (std::size_t i = 0; i < 3; ++i) {
      const double stress = -surcharge - weight * (top - node_at(mesh, triangle.nodes[i]).y());
      field[t].col(static_cast<Eigen::Index>(i)) << stress, stress, 0.0;
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
    const Eigen::VectorXd x = as_vector(field);
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
  Eigen::VectorXd x = as_vector(proposed);
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
  certificate.field = as_field(x);
  // Relative to stresses up to the multiplier's size, in the problem's units of order one.
  const double rounding = 1e-10 * std::max(1.0, std::abs(multiplier));
  certificate.holds = inside && certificate.residual < rounding;
  return certificate;
}

}  // namespace limit::certificate

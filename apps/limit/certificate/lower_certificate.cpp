#include "limit/certificate/lower_certificate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "limit/algebra/equation_builder.hpp"
#include "limit/algebra/least_change.hpp"
#include "limit/certificate/ceilings.hpp"
#include "limit/certificate/stress_layout.hpp"
#include "limit/problem/bare_corners.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/problem/pore_pressure.hpp"

namespace limit::certificate {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

/// All the equations of equilibrium in the corners' (xx, yy, xy); the multiplier is given.
class BalanceEquations {
 public:
  BalanceEquations(const problem::Problem& problem, const problem::MeshPressure& water,
                   double multiplier)
      : problem_(problem), layout_(problem), water_(water), multiplier_(multiplier) {
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
    const mesh::Point weight = force(static_cast<std::size_t>(triangle), soil.centre) *
                               mesh::twice_area(mesh, nodes) / 2.0;
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

  [[nodiscard]] mesh::Point force(std::size_t triangle, const mesh::Point& place) const {
    const int region = problem_.mesh.triangles[triangle].region;
    const problem::Soil& soil = problem_.soils[static_cast<std::size_t>(region)];
    const double times = problem_.pressure_is_live ? multiplier_ : 1.0;
    return soil.unit_weight_at(place) * problem_.pull + soil.seepage +
           multiplier_ *
               (soil.live_unit_weight_at(place) * problem_.live_pull + soil.live_seepage) +
           times * water_.force(triangle);
  }

  // The divergence of a quadratic stress is linear: it is the weight everywhere if it is in the
  // corners. There it is the slopes along the two sides that meet, each twice the way from the
  // corner's Bezier point to the side's.
  void balance_everywhere(std::size_t triangle) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Triangle& nodes = mesh.triangles[triangle];
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
        equations_.begin(-scale * direction.dot(force(triangle, a)));
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
  const problem::MeshPressure& water_;
  double multiplier_;
  algebra::EquationBuilder equations_;
};

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
problem::StressField geostatic(const problem::Problem& problem,
                               const problem::MeshPressure& water) {
  const mesh::Mesh& mesh = problem.mesh;
  double top = mesh.nodes.front().y();
  for (const mesh::Point& node : mesh.nodes) top = std::max(top, node.y());
  double surcharge = 0.0;
  for (const problem::Boundary& boundary : problem.boundaries) {
    surcharge = std::max(surcharge, -boundary.normal_stress);
  }
  // In pores whose pressure is dead; of quadratic stresses the rest is not one of ground with such.
  const auto borne_at = [&](const mesh::Triangle& triangle, Eigen::Index corner) {
    if (!water.is_there() || problem.pressure_is_live) return 0.0;
    return water.nodes[static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(corner)])];
  };
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
      const double borne = i < 3 ? borne_at(triangle, i) : 0.0;
      field[t].col(i) << stress + borne, stress + borne, 0.0;
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
std::optional<Rest> rest_of(const problem::Problem& problem, const problem::MeshPressure& water) {
  const BalanceEquations equilibrium(problem, water, 0.0);
  const auto equations = equilibrium.matrix();
  const Eigen::VectorXd live =
      BalanceEquations(problem, water, 1.0).right_side() - equilibrium.right_side();
  const problem::StressField nothing(problem.mesh.triangles.size(), Eigen::Matrix3d::Zero());
  for (const problem::StressField& field : {geostatic(problem, water), nothing}) {
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
  const problem::MeshPressure water = pressure_on_mesh(problem, problem::Bound::lower);
  const BalanceEquations equilibrium(problem, water, multiplier);
  const auto equations = equilibrium.matrix();
  Eigen::VectorXd x = as_vector(problem, proposed);
  certificate.residual = algebra::satisfy(equations, equilibrium.right_side(), x);

  const std::optional<Rest> rest = rest_of(problem, water);
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
    const BalanceEquations after(problem, water, certificate.multiplier);
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

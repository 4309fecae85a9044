#include "limit/certificate/upper_certificate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "limit/algebra/equation_builder.hpp"
#include "limit/algebra/least_change.hpp"
#include "limit/certificate/curved_power.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/problem/pore_pressure.hpp"

namespace limit::certificate {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

// A linear form in all velocities: 12 per triangle and the footing's 3.
using Terms = std::vector<std::pair<Eigen::Index, double>>;

double value(const Terms& terms, const Eigen::VectorXd& velocities) {
  double sum = 0.0;
  for (const auto& [index, factor] : terms) sum += factor * velocities[index];
  return sum;
}

/// A place where soil flows: a corner of a triangle or a control point of a jump. It must dilate by
/// at least `ratio` times the shear, or, if it may not dilate, not at all, and dissipates, times
/// `weight`, `per_dilation` times the dilation, `per_shear` times the shear and `per_excess` times
/// what the shear is more than the dilation.
///
/// Where tension is cut off at T, the mean stress p and the radius R of Mohr's circle, whose power
/// is p dilation + R shear, are in a polygon with one corner at p = T, R = 0 and another where
/// Rankine meets Coulomb, R = (c cos(phi) - T sin(phi)) / (1 - sin(phi)), p = T - R: the power is
/// at most T dilation, and R (shear - dilation) more if that is positive. It is linear in the
/// cohesion.
struct FlowPoint {
  Terms dilation;
  std::array<Terms, 2> shear;  // the root of the sum of their squares
  double ratio = 0.0;
  bool may_dilate = false;
  double per_dilation = 0.0, per_shear = 0.0, per_excess = 0.0;
  bool is_layer = false;  // a jump: of a thin layer, whose shear is the root of both components'
  /// Under a contact that may open, of soil whose tension is cut off: the traction's circle.
  bool is_contact = false;
  double circle_middle = 0.0, circle_radius = 0.0;
  /// Of soil with a curved envelope; under a contact that may open, its strength without pressure.
  std::optional<problem::Envelope> envelope = std::nullopt;
  double without_pressure = 0.0;
  double weight = 0.0;
  std::size_t triangle = 0;
};

class Flow {
 public:
  explicit Flow(const problem::Problem& problem)
      : problem_(problem),
        water_(pressure_on_mesh(problem, problem::Bound::upper)),
        footing_(static_cast<Eigen::Index>(12 * problem.mesh.triangles.size())) {
    for (std::size_t t = 0; t < problem.mesh.triangles.size(); ++t) {
      soils_.push_back(problem::soil_in(problem, problem.mesh.triangles[t], problem::Bound::upper));
      corners(t);
      weigh(t);
    }
    for (const mesh::Edge& edge : mesh::edges_of(problem.mesh)) {
      jumps(edge);
      if (edge.boundary >= 0) tractions(edge);
    }
    for (Eigen::Index motion = 0; motion < 3; ++motion) {
      const auto i = static_cast<std::size_t>(motion);
      dead_.emplace_back(footing_ + motion, problem.footing.dead_load[i]);
      live_.emplace_back(footing_ + motion, problem.footing.live_load[i]);
    }
  }

  [[nodiscard]] const std::vector<FlowPoint>& points() const { return points_; }
  [[nodiscard]] const Terms& dead_power() const { return dead_; }
  [[nodiscard]] const Terms& live_power() const { return live_; }

 private:
  // No weaker than the triangle is anywhere.
  const problem::Soil& soil_of(std::size_t triangle) const { return soils_[triangle]; }
  static Eigen::Index velocity(std::size_t triangle, std::size_t place) {
    return static_cast<Eigen::Index>(12 * triangle + 2 * place);
  }

  FlowPoint point(std::size_t triangle, const problem::Soil& soil, double cohesion, double ratio,
                  double weight) const {
    FlowPoint point;
    point.ratio = ratio;
    point.weight = weight;
    point.triangle = triangle;
    if (soil.is_curved()) {
      // Any dilation at all bounds the power; next to none, for rounding's sake.
      constexpr double least = 1e-4;
      point.ratio = ratio > 0.0 ? least : 0.0;
      point.may_dilate = true;
      point.envelope = soil.envelope;
      return point;
    }
    point.may_dilate = soil.friction_angle > 0.0 || soil.cuts_tension();
    if (soil.cuts_tension()) {
      const double sine = std::sin(soil.friction_angle);
      point.per_dilation = soil.tension;
      point.per_excess =
          (cohesion * std::cos(soil.friction_angle) - soil.tension * sine) / (1.0 - sine);
    } else if (point.may_dilate) {
      point.per_dilation = cohesion / std::tan(soil.friction_angle);
    } else {
      point.per_shear = cohesion;
    }
    return point;
  }

  // Of a triangle, weighted by what is one in a corner and falls to nothing at the side across: the
  // cohesion half way from the middle of the triangle to the corner's, by its moment, is
  // (c_i + the mean of all three times three) / 4.
  double mean_cohesion(std::size_t t, std::size_t corner) const {
    const auto& nodes = problem_.mesh.triangles[t].nodes;
    const problem::Soil& soil = soil_of(t);
    const mesh::Point middle =
        (node_at(problem_.mesh, nodes[0]) + node_at(problem_.mesh, nodes[1]) +
         node_at(problem_.mesh, nodes[2])) /
        3.0;
    const mesh::Point& place = node_at(problem_.mesh, nodes[corner]);
    return soil.cohesion_at(middle + (place - middle) / 4.0);
  }

  // Strain rates from the slopes of the two sides that meet in a corner: of a quadratic through
  // begin, middle and end, the slope at the begin is (-3 u0 + 4 u1 - u2) / length.
  void corners(std::size_t t) {
    const mesh::Mesh& mesh = problem_.mesh;
    const auto& nodes = mesh.triangles[t].nodes;
    const double area = mesh::twice_area(mesh, mesh.triangles[t]) / 2.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      Eigen::Matrix2d sides;
      sides.row(0) = (node_at(mesh, nodes[j]) - node_at(mesh, nodes[i])).transpose();
      sides.row(1) = (node_at(mesh, nodes[k]) - node_at(mesh, nodes[i])).transpose();
      const Eigen::Matrix2d back = sides.inverse();  // gradient = back x slopes along the sides
      FlowPoint corner = point(t, soil_of(t), mean_cohesion(t, i),
                               std::sin(soil_of(t).friction_angle), area / 3.0);
      for (const auto& [place, along_j, along_k] :
           {std::array<double, 3>{static_cast<double>(i), -3.0, -3.0},
            {static_cast<double>(3 + i), 4.0, 0.0},
            {static_cast<double>(j), -1.0, 0.0},
            {static_cast<double>(3 + k), 0.0, 4.0},
            {static_cast<double>(k), 0.0, -1.0}}) {
        const Eigen::Vector2d gradient = back * Eigen::Vector2d(along_j, along_k);
        const Eigen::Index x = velocity(t, static_cast<std::size_t>(place)), y = x + 1;
        corner.dilation.emplace_back(x, gradient.x());
        corner.dilation.emplace_back(y, gradient.y());
        corner.shear[0].emplace_back(x, gradient.x());
        corner.shear[0].emplace_back(y, -gradient.y());
        corner.shear[1].emplace_back(x, gradient.y());
        corner.shear[1].emplace_back(y, gradient.x());
      }
      points_.push_back(corner);
    }
  }

  // The rule for cubics with a twentieth in the corners, two fifteenths in the middles of sides and
  // nine twentieths in the centre, where a quadratic is four ninths of the middles' sum less one
  // ninth of the corners'.
  void weigh(std::size_t t) {
    const mesh::Mesh& mesh = problem_.mesh;
    const auto& nodes = mesh.triangles[t].nodes;
    const double area = mesh::twice_area(mesh, mesh.triangles[t]) / 2.0;
    const mesh::Point centre =
        (node_at(mesh, nodes[0]) + node_at(mesh, nodes[1]) + node_at(mesh, nodes[2])) / 3.0;
    const auto add = [&](std::size_t place, const mesh::Point& at, double share, double of_centre) {
      const problem::Soil& soil = soil_of(t);
      const auto weigh_by = [&](double here, double there, const mesh::Point& pull,
                                const mesh::Point& water, Terms& power) {
        for (const Eigen::Index xy : {0, 1}) {
          const double force =
              pull[xy] * (share * here + of_centre * there) + water[xy] * (share + of_centre);
          if (force != 0.0) power.emplace_back(velocity(t, place) + xy, force * area);
        }
      };
      const mesh::Point force = water_.force(t);
      mesh::Point dead = soil.seepage, live = soil.live_seepage;
      (problem_.pressure_is_live ? live : dead) += force;
      weigh_by(soil.unit_weight_at(at), soil.unit_weight_at(centre), problem_.pull, dead, dead_);
      weigh_by(soil.live_unit_weight_at(at), soil.live_unit_weight_at(centre), problem_.live_pull,
               live, live_);
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const mesh::Point &first = node_at(mesh, nodes[i]), &next = node_at(mesh, nodes[(i + 1) % 3]);
      add(3 + i, (first + next) / 2.0, 2.0 / 15.0, 0.2);
      if (soil_of(t).has_uneven_weight()) add(i, first, 0.05, -0.05);
    }
  }

  // Velocities of a triangle along a side, from the side's first node to its second.
  std::array<Eigen::Index, 3> along(int triangle, const mesh::Edge& edge) const {
    const auto t = static_cast<std::size_t>(triangle);
    const auto& nodes = problem_.mesh.triangles[t].nodes;
    const auto find = [&](int node) {
      return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    const std::size_t a = find(edge.first), b = find(edge.second);
    const std::size_t middle = (a + 1) % 3 == b ? a : b;
    return {velocity(t, a), velocity(t, 3 + middle), velocity(t, b)};
  }

  // A jump across which no traction pulls.
  static void let_open(FlowPoint& jump, const problem::Soil& soil, double cohesion) {
    if (soil.is_curved()) {
      jump.is_contact = true;
      jump.without_pressure = soil.envelope.under(0.0).shear;
      return;
    }
    jump.per_shear = cohesion;
    if (!soil.cuts_tension()) {
      // The largest power of a traction that yields and does not pull: that of the cohesion.
      jump.may_dilate = true;
      jump.per_dilation = 0.0;
      return;
    }
    jump.is_contact = true;
    jump.circle_radius = jump.per_excess;
    jump.circle_middle = soil.tension - jump.circle_radius;
    if (jump.circle_middle + jump.circle_radius * std::sin(soil.friction_angle) < 0.0) {
      jump.per_shear = std::sqrt((jump.circle_radius - jump.circle_middle) *
                                 (jump.circle_radius + jump.circle_middle));
    }
  }

  void jumps(const mesh::Edge& edge) {
    bool slips_freely = false, may_open = false;
    if (edge.boundary >= 0) {
      const problem::Boundary& boundary =
          problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
      if (boundary.normal == problem::Known::traction) return;
      slips_freely = boundary.tangential == problem::Known::traction;
      may_open = boundary.may_open;
    }
    const mesh::Mesh& mesh = problem_.mesh;
    const auto t = static_cast<std::size_t>(edge.left);
    const problem::Soil soil = problem::soil_across(problem_, edge);
    const mesh::Point &a = node_at(mesh, edge.first), &b = node_at(mesh, edge.second);
    const mesh::Point tangent = (b - a).normalized(), normal(tangent.y(), -tangent.x());
    // The quadratic is (1-s)^2 c0 + 2 s (1-s) c1 + s^2 c2.
    const std::array<std::array<double, 3>, 3> control{{{1, 0, 0}, {-0.5, 2, -0.5}, {0, 0, 1}}};
    // Centres of gravity of the three Bernstein polynomials.
    double centre = 0.0;
    for (const auto& weights : control) {
      centre += 0.25;
      const double cohesion = soil.cohesion_at(a + centre * (b - a));
      FlowPoint jump = point(t, soil, cohesion, slips_freely ? 0.0 : std::tan(soil.friction_angle),
                             (b - a).norm() / 3.0);
      jump.is_layer = true;
      if (may_open) let_open(jump, soil, cohesion);
      const auto add = [&](Eigen::Index x, const mesh::Point& unit, double factor) {
        jump.dilation.emplace_back(x, factor * unit.dot(normal));
        if (!slips_freely) jump.shear[0].emplace_back(x, factor * unit.dot(tangent));
      };
      const auto add_velocities = [&](int triangle, double sign) {
        const auto places = along(triangle, edge);
        for (std::size_t i = 0; i < 3; ++i) {
          add(places[i], mesh::Point(1, 0), sign * weights[i]);
          add(places[i] + 1, mesh::Point(0, 1), sign * weights[i]);
        }
      };
      add_velocities(edge.left, -1.0);
      if (edge.right >= 0) {
        add_velocities(edge.right, 1.0);
      } else {
        const problem::Boundary& boundary =
            problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
        const mesh::Point at = weights[0] * a + weights[1] * (a + b) / 2.0 + weights[2] * b;
        const mesh::Point arm = at - problem_.footing.centre;
        const mesh::Point turned(-arm.y(), arm.x());
        for (Eigen::Index motion = 0; motion < 3; ++motion) {
          const mesh::Point moved = motion == 0   ? mesh::Point(1, 0)
                                    : motion == 1 ? mesh::Point(0, 1)
                                                  : turned;
          if (boundary.normal == problem::Known::footing) {
            jump.dilation.emplace_back(footing_ + motion, moved.dot(normal));
          }
          if (boundary.tangential == problem::Known::footing) {
            jump.shear[0].emplace_back(footing_ + motion, moved.dot(tangent));
          }
        }
      }
      points_.push_back(jump);
    }
  }

  void tractions(const mesh::Edge& edge) {
    const problem::Boundary& boundary =
        problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
    const mesh::Point way =
        node_at(problem_.mesh, edge.second) - node_at(problem_.mesh, edge.first);
    const mesh::Point outward(way.y(), -way.x());
    mesh::Point dead(0, 0), live(0, 0);
    if (boundary.normal == problem::Known::traction) {
      dead += boundary.normal_stress * outward;
      live += boundary.live_normal_stress * outward;
    }
    if (boundary.tangential == problem::Known::traction) {
      dead += boundary.shear_stress * way;
      live += boundary.live_shear_stress * way;
    }
    const auto places = along(edge.left, edge);
    const std::array<double, 3> simpson{1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    for (std::size_t i = 0; i < 3; ++i) {
      for (Eigen::Index xy = 0; xy < 2; ++xy) {
        dead_.emplace_back(places[i] + xy, simpson[i] * dead[xy]);
        live_.emplace_back(places[i] + xy, simpson[i] * live[xy]);
      }
    }
  }

  const problem::Problem& problem_;
  problem::MeshPressure water_;
  Eigen::Index footing_;
  std::vector<problem::Soil> soils_;  // of triangles
  std::vector<FlowPoint> points_;
  Terms dead_, live_;
};

Eigen::VectorXd as_vector(const problem::VelocityField& field) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(12 * field.triangles.size() + 3));
  for (std::size_t t = 0; t < field.triangles.size(); ++t) {
    x.segment<12>(static_cast<Eigen::Index>(12 * t)) = field.triangles[t].reshaped();
  }
  x.tail<3>() = field.footing;
  return x;
}

problem::VelocityField as_field(const Eigen::VectorXd& x) {
  problem::VelocityField field;
  for (Eigen::Index at = 0; at + 12 <= x.size(); at += 12) {
    field.triangles.emplace_back(x.segment<12>(at).reshaped(2, 6));
  }
  field.footing = x.tail<3>();
  return field;
}

double shear_of(const FlowPoint& point, const Eigen::VectorXd& x) {
  return std::hypot(value(point.shear[0], x), value(point.shear[1], x));
}

// Times its weight.
double power_of(const FlowPoint& point, const Eigen::VectorXd& x) {
  const double dilation = value(point.dilation, x), shear = shear_of(point, x);
  const double size = point.is_layer ? std::hypot(dilation, shear) : shear;
  if (point.envelope) {
    return point.is_contact
               ? curved_contact_power(*point.envelope, point.without_pressure, dilation, shear)
               : curved_power(*point.envelope, dilation, size);
  }
  if (point.is_contact) {
    // Of the tractions on the circle that do not pull, or of their last one, with no pressure.
    const bool presses = point.circle_middle * size + point.circle_radius * dilation < 0.0;
    return presses ? point.circle_middle * dilation + point.circle_radius * size
                   : point.per_shear * shear;
  }
  return point.per_dilation * dilation + point.per_shear * shear +
         point.per_excess * std::max(0.0, size - dilation);
}

// What a point that may dilate lacks of the dilation its shear demands.
double lack(const FlowPoint& point, const Eigen::VectorXd& x) {
  return point.ratio * shear_of(point, x) - value(point.dilation, x);
}

// No dilation where there may be none, the footing's immovable motions at rest.
double without_dilation(const problem::Problem& problem, const std::vector<FlowPoint>& points,
                        Eigen::VectorXd& x) {
  algebra::EquationBuilder equations;
  for (const FlowPoint& point : points) {
    if (point.may_dilate) continue;
    double norm = 0.0;
    for (const auto& term : point.dilation) norm += term.second * term.second;
    equations.begin(0.0);
    for (const auto& [index, factor] : point.dilation) {
      equations.add(index, factor / std::sqrt(norm));
    }
  }
  for (Eigen::Index motion = 0; motion < 3; ++motion) {
    if (problem.footing.may_move[static_cast<std::size_t>(motion)]) continue;
    equations.begin(0.0);
    equations.add(x.size() - 3 + motion, 1.0);
  }
  return algebra::satisfy(equations.matrix(x.size()), equations.right_side(), x);
}

}  // namespace

UpperCertificate certify_upper(const problem::Problem& problem,
                               const problem::VelocityField& proposed,
                               const problem::VelocityField& dilating) {
  const Flow flow(problem);
  UpperCertificate certificate;
  Eigen::VectorXd x = as_vector(proposed), inner = as_vector(dilating);
  certificate.violation = -INFINITY;
  for (const FlowPoint& point : flow.points()) {
    certificate.violation =
        std::max(certificate.violation,
                 point.may_dilate ? lack(point, x) : std::abs(value(point.dilation, x)));
  }
  certificate.residual = without_dilation(problem, flow.points(), x);
  without_dilation(problem, flow.points(), inner);

  double mixed = 0.0;
  bool holds = true;
  for (const FlowPoint& point : flow.points()) {
    const double here = lack(point, x);
    if (!point.may_dilate || here <= 0.0) continue;
    const double there = lack(point, inner);
    holds = holds && there < 0.0;
    mixed = std::max(mixed, here / (here - there));
  }
  if (mixed > 0.0 && holds) {
    // So that rounding does not undo it, nor is all there is to be mended.
    constexpr double more = 1.0 + 1e-6, least = 1e-9;
    mixed = std::min(1.0, mixed * more + least);
    x = (1.0 - mixed) * x + mixed * inner;
    certificate.kept = 1.0 - mixed;
    for (const FlowPoint& point : flow.points()) {
      holds = holds && (!point.may_dilate || lack(point, x) <= 0.0);
    }
  }
  const double live = value(flow.live_power(), x);
  holds = holds && live > 0.0;
  x /= live;
  certificate.of_triangle.assign(problem.mesh.triangles.size(), 0.0);
  for (const FlowPoint& point : flow.points()) {
    const double power = point.weight * power_of(point, x);
    certificate.dissipation += power;
    certificate.of_triangle[point.triangle] += power;
  }
  certificate.multiplier = certificate.dissipation - value(flow.dead_power(), x);
  certificate.field = as_field(x);
  constexpr double rounding = 1e-11;
  certificate.holds =
      holds && certificate.residual < rounding && std::isfinite(certificate.multiplier);
  return certificate;
}

}  // namespace limit::certificate

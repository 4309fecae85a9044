// The bounds of small strips proved again in 50 digits, by equations written down here once more
// and for this case alone: nothing of limit's assembly and certificates is used but their fields.
#include <gmock/gmock.h>

#include <Eigen/SparseCholesky>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <numbers>

#include "limit/bracket.hpp"
#include "limit/strip.hpp"

namespace {

using namespace limit;
using Real = boost::multiprecision::cpp_bin_float_50;

// Far below double precision, far above the last of 50 digits.
const Real exact = Real("1e-38");

struct Row {
  std::vector<std::pair<std::size_t, Real>> terms;
  Real right_side = 0;

  Real residual(const std::vector<Real>& x) const {
    Real sum = right_side;
    for (const auto& [i, factor] : terms) sum -= factor * x[i];
    return sum;
  }
};

// Least change of x that satisfies the rows: the correction's direction comes from a factorisation
// in double, its size from residuals in 50 digits, again and again.
Real satisfy_exactly(std::vector<Row> rows, std::vector<Real>& x) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Real largest = 0;
    for (const auto& term : rows[r].terms) largest = std::max<Real>(largest, abs(term.second));
    rows[r].right_side /= largest;
    for (auto& [i, factor] : rows[r].terms) {
      factor /= largest;
      entries.emplace_back(static_cast<int>(r), static_cast<int>(i), static_cast<double>(factor));
    }
  }
  Eigen::SparseMatrix<double> matrix(static_cast<int>(rows.size()), static_cast<int>(x.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> normal = matrix * Eigen::SparseMatrix<double>(matrix.transpose());
  for (int i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += 1e-10;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(normal);
  Real largest = 0;
  for (int repetition = 0; repetition < 100; ++repetition) {
    std::vector<Real> residual;
    largest = 0;
    for (const Row& row : rows) {
      residual.push_back(row.residual(x));
      largest = std::max<Real>(largest, abs(residual.back()));
    }
    if (largest < exact) break;
    Eigen::VectorXd scaled(static_cast<int>(rows.size()));
    for (std::size_t r = 0; r < rows.size(); ++r) {
      scaled[static_cast<int>(r)] = static_cast<double>(residual[r] / largest);
    }
    const Eigen::VectorXd change = matrix.transpose() * solver.solve(scaled);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += largest * Real(change[static_cast<int>(i)]);
    }
  }
  return largest;
}

struct Plane {
  Real x, y;
};

Plane node(const Mesh& mesh, int i) {
  const Point& at = mesh.nodes[static_cast<std::size_t>(i)];
  return {Real(at.x()), Real(at.y())};
}

std::size_t corner(const Mesh& mesh, int triangle, int of_node) {
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(triangle)].nodes;
  return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), of_node) - nodes.begin());
}

bool is(const Edge& edge, FanBoundary which) {
  return edge.boundary == static_cast<int>(which);
}

// Equilibrium of a strip's half (length unit: half width) in (xx, yy, xy) of each corner.
std::vector<Row> equilibrium(const Problem& problem, const Real& pressure) {
  const Mesh& mesh = problem.mesh;
  const Real weight(problem.soils[0].unit_weight);
  std::vector<Row> rows;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& n = mesh.triangles[t].nodes;
    Row x, y;
    Real area2 = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Plane a = node(mesh, n[i]), b = node(mesh, n[(i + 1) % 3]),
                  c = node(mesh, n[(i + 2) % 3]);
      const Real dx = b.y - c.y, dy = c.x - b.x;  // 2 area x gradient
      const std::size_t at = 9 * t + 3 * i;
      x.terms.emplace_back(at, dx);
      x.terms.emplace_back(at + 2, dy);
      y.terms.emplace_back(at + 2, dx);
      y.terms.emplace_back(at + 1, dy);
      area2 += a.x * b.y - b.x * a.y;
    }
    y.right_side = weight * area2;
    rows.push_back(x);
    rows.push_back(y);
  }
  Row base;
  for (const Edge& edge : edges_of(mesh)) {
    const Plane a = node(mesh, edge.first), b = node(mesh, edge.second);
    const Real nx = b.y - a.y, ny = a.x - b.x;  // outward of the left triangle, times the length
    for (const int end : {edge.first, edge.second}) {
      const std::size_t left =
          9 * static_cast<std::size_t>(edge.left) + 3 * corner(mesh, edge.left, end);
      if (edge.right >= 0) {
        const std::size_t right =
            9 * static_cast<std::size_t>(edge.right) + 3 * corner(mesh, edge.right, end);
        rows.push_back({{{left, nx}, {left + 2, ny}, {right, -nx}, {right + 2, -ny}}, 0});
        rows.push_back({{{left + 2, nx}, {left + 1, ny}, {right + 2, -nx}, {right + 1, -ny}}, 0});
      } else if (is(edge, FanBoundary::surface)) {
        rows.push_back({{{left + 1, Real(1)}}, Real(problem.boundaries[1].normal_stress)});
        rows.push_back({{{left + 2, Real(1)}}, 0});
      } else if (is(edge, FanBoundary::axis)) {
        rows.push_back({{{left + 2, Real(1)}}, 0});
      } else if (is(edge, FanBoundary::base)) {
        base.terms.emplace_back(left + 1, ny / 2);
        if (problem.boundaries[0].tangential == Known::traction) {
          rows.push_back({{{left + 2, Real(1)}}, 0});
        }
      }
    }
  }
  base.right_side = -pressure;
  rows.push_back(base);
  return rows;
}

struct Strength {
  Real cohesion, sine, cosine;
};

Strength strength_of(const Problem& problem) {
  const Real phi(problem.soils[0].friction_angle);
  return {Real(problem.soils[0].cohesion), sin(phi), cos(phi)};
}

// Gradient of a quadratic's six values in one corner of its triangle, by its two sides' slopes.
using SixTerms = std::vector<std::array<Real, 3>>;  // place, d/dx, d/dy

SixTerms gradient(const Mesh& mesh, std::size_t t, std::size_t i) {
  const auto& n = mesh.triangles[t].nodes;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const Plane a = node(mesh, n[i]), b = node(mesh, n[j]), c = node(mesh, n[k]);
  const Real bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
  const Real det = bx * cy - by * cx;
  const auto term = [&](std::size_t place, int to_b, int to_c) {
    return std::array<Real, 3>{Real(place), (cy * to_b - by * to_c) / det,
                               (bx * to_c - cx * to_b) / det};
  };
  return {term(i, -3, -3), term(3 + i, 4, 0), term(j, -1, 0), term(3 + k, 0, 4), term(k, 0, -1)};
}

// Where soil flows: dilation, two measures of shear, weight; `rolls`: without shear strength.
struct Flow {
  Row dilation;
  std::array<Row, 2> shear;
  Real weight, ratio;
};

std::vector<Flow> flows(const Problem& problem) {
  const Mesh& mesh = problem.mesh;
  const Strength soil = strength_of(problem);
  std::vector<Flow> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      Flow flow;
      flow.ratio = soil.sine;
      flow.weight = Real(twice_area(mesh, mesh.triangles[t])) / 6;
      for (const auto& [place, dx, dy] : gradient(mesh, t, i)) {
        const std::size_t x = 12 * t + 2 * static_cast<std::size_t>(place);
        flow.dilation.terms.emplace_back(x, dx);
        flow.dilation.terms.emplace_back(x + 1, dy);
        flow.shear[0].terms.emplace_back(x, dx);
        flow.shear[0].terms.emplace_back(x + 1, -dy);
        flow.shear[1].terms.emplace_back(x, dy);
        flow.shear[1].terms.emplace_back(x + 1, dx);
      }
      all.push_back(flow);
    }
  }
  const std::size_t footing = 12 * mesh.triangles.size() + 1;  // its velocity along y
  for (const Edge& edge : edges_of(mesh)) {
    if (is(edge, FanBoundary::surface)) continue;
    const bool rolls =
        is(edge, FanBoundary::axis) ||
        (is(edge, FanBoundary::base) && problem.boundaries[0].tangential == Known::traction);
    const Plane a = node(mesh, edge.first), b = node(mesh, edge.second);
    const Real length = sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    const Real tx = (b.x - a.x) / length, ty = (b.y - a.y) / length;
    const auto places = [&](int triangle) {
      const std::size_t i = corner(mesh, triangle, edge.first);
      const std::size_t j = corner(mesh, triangle, edge.second);
      const std::size_t start = 12 * static_cast<std::size_t>(triangle);
      return std::array<std::size_t, 3>{start + 2 * i, start + 2 * (3 + ((i + 1) % 3 == j ? i : j)),
                                        start + 2 * j};
    };
    for (int control = 0; control < 3; ++control) {
      std::array<Real, 3> share{};
      if (control == 1) share = {Real(-0.5), Real(2), Real(-0.5)};
      if (control != 1) share[static_cast<std::size_t>(control)] = 1;
      Flow flow;
      flow.ratio = rolls ? Real(0) : Real(soil.sine / soil.cosine);
      flow.weight = length / 3;
      const auto add = [&](std::size_t index, const Real& x_share, const Real& y_share) {
        flow.dilation.terms.emplace_back(index, x_share * ty - y_share * tx);
        if (!rolls) flow.shear[0].terms.emplace_back(index, x_share * tx + y_share * ty);
      };
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t inside = places(edge.left)[i];
        add(inside, -share[i], Real(0));
        add(inside + 1, Real(0), -share[i]);
        if (edge.right < 0) continue;
        const std::size_t outside = places(edge.right)[i];
        add(outside, share[i], Real(0));
        add(outside + 1, Real(0), share[i]);
      }
      if (is(edge, FanBoundary::base)) add(footing, Real(0), Real(1));
      all.push_back(flow);
    }
  }
  return all;
}

Real value(const Row& row, const std::vector<Real>& x) {
  return -(row.residual(x) - row.right_side);
}

struct CaseOf {
  const char* name;
  double phi, weight, surcharge;
  bool rough;
};

class ExtendedPrecision : public ::testing::TestWithParam<CaseOf> {
 protected:
  Bracket solved() const {
    BracketOptions options;
    options.max_triangles = 1;
    return bracket(problem(even_fan(4.0, 2.0, 9, 4, 1.5)), problem(even_fan(4.0, 2.0, 9, 4, 2.0)),
                   options);
  }
  Problem problem(const Fan& fan) const {
    Strip strip;
    strip.soil = {1.0, GetParam().phi * std::numbers::pi / 180.0, GetParam().weight};
    strip.surcharge = GetParam().surcharge;
    strip.rough = GetParam().rough;
    return strip_problem(strip, fan);
  }
};

TEST_P(ExtendedPrecision, AStressFieldBalancesTheLowerBoundNowhereBeyondYield) {
  const Bracket found = solved();
  ASSERT_TRUE(found.lower);
  Problem strip = problem(even_fan(4.0, 2.0, 9, 4, 1.5));
  strip.mesh = found.lower->mesh;
  std::vector<Real> stress;
  for (const Eigen::Matrix3d& corners : found.lower->certificate.field) {
    for (const double component : corners.reshaped()) stress.emplace_back(component);
  }
  const Real bound(found.lower_bound());
  ASSERT_LT(satisfy_exactly(equilibrium(strip, bound), stress), exact);
  const Strength soil = strength_of(strip);
  for (std::size_t at = 0; at < stress.size(); at += 3) {
    const Real mean = (stress[at] + stress[at + 1]) / 2, half = (stress[at] - stress[at + 1]) / 2;
    const Real strength = soil.cohesion * soil.cosine - mean * soil.sine;
    ASSERT_GE(strength, 0);
    ASSERT_LE(half * half + stress[at + 2] * stress[at + 2], strength * strength);
  }
}

TEST_P(ExtendedPrecision, AMechanismFailsUnderTheUpperBound) {
  const Bracket found = solved();
  ASSERT_TRUE(found.upper);
  Problem strip = problem(even_fan(4.0, 2.0, 9, 4, 2.0));
  strip.mesh = found.upper->mesh;
  std::vector<Real> velocity;
  for (const auto& triangle : found.upper->certificate.field.triangles) {
    for (const double component : triangle.reshaped()) velocity.emplace_back(component);
  }
  for (const double motion : found.upper->certificate.field.footing) velocity.emplace_back(motion);
  const std::vector<Flow> points = flows(strip);
  const Strength soil = strength_of(strip);
  if (soil.sine == 0) {
    std::vector<Row> still;
    for (const Flow& flow : points) still.push_back(flow.dilation);
    ASSERT_LT(satisfy_exactly(still, velocity), exact);
  }
  Real power = 0;
  for (const Flow& flow : points) {
    const Real dilation = value(flow.dilation, velocity);
    const Real first = value(flow.shear[0], velocity), second = value(flow.shear[1], velocity);
    const Real shear = sqrt(first * first + second * second);
    if (soil.sine > 0) {
      ASSERT_GE(dilation, flow.ratio * shear);
      power += flow.weight * soil.cohesion * soil.cosine / soil.sine * dilation;
    } else {
      power += flow.weight * soil.cohesion * shear;
    }
  }
  // Less the power of weight and surcharge: quadratics by their middles, and by Simpson's rule.
  const Mesh& mesh = strip.mesh;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Real share = Real(twice_area(mesh, mesh.triangles[t])) / 6 * strip.soils[0].unit_weight;
    for (std::size_t i = 3; i < 6; ++i) power += share * velocity[12 * t + 2 * i + 1];
  }
  for (const Edge& edge : edges_of(mesh)) {
    if (!is(edge, FanBoundary::surface)) continue;
    const Real push = (node(mesh, edge.second).x - node(mesh, edge.first).x) *
                      Real(strip.boundaries[1].normal_stress);
    const std::size_t i = corner(mesh, edge.left, edge.first);
    const std::size_t j = corner(mesh, edge.left, edge.second);
    const std::size_t start = 12 * static_cast<std::size_t>(edge.left) + 1;
    const std::size_t middle = 3 + ((i + 1) % 3 == j ? i : j);
    // The surface runs to the left: `push` is the load times the length.
    power +=
        push *
        (velocity[start + 2 * i] + 4 * velocity[start + 2 * middle] + velocity[start + 2 * j]) / 6;
  }
  const Real down = -velocity[12 * mesh.triangles.size() + 1];
  ASSERT_GT(down, 0);
  EXPECT_LE(power / down, Real(found.upper_bound()));
}

INSTANTIATE_TEST_SUITE_P(Strips, ExtendedPrecision,
                         ::testing::Values(CaseOf{"tresca", 0.0, 1.0, 0.0, true},
                                           CaseOf{"rough", 20.0, 2.0, 0.0, true},
                                           CaseOf{"smooth", 30.0, 0.0, 0.5, false}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace

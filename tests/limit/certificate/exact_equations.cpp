#include "limit/certificate/exact_equations.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "limit/mesh/mesh.hpp"

using namespace limit;

namespace exact_equations {
namespace {

struct Plane {
  Real x, y;
};

Plane node(const mesh::Mesh& mesh, int i) {
  const mesh::Point& at = mesh.nodes[static_cast<std::size_t>(i)];
  return {Real(at.x()), Real(at.y())};
}

std::size_t corner(const mesh::Mesh& mesh, int triangle, int of_node) {
  const auto& nodes = mesh.triangles[static_cast<std::size_t>(triangle)].nodes;
  return static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), of_node) - nodes.begin());
}

const problem::Boundary& boundary_of(const problem::Problem& problem, const mesh::Edge& edge) {
  return problem.boundaries[static_cast<std::size_t>(edge.boundary)];
}

// Where a rigid motion of the footing takes a place.
Plane rigid(const problem::Problem& problem, int motion, const Plane& at) {
  if (motion < 2) return {Real(motion == 0 ? 1 : 0), Real(motion == 1 ? 1 : 0)};
  return {Real(problem.footing.centre.y()) - at.y, at.x - Real(problem.footing.centre.x())};
}

bool on_footing(const problem::Boundary& boundary) {
  return boundary.normal == problem::Known::footing ||
         boundary.tangential == problem::Known::footing;
}

// Gradient of a quadratic's six values in one corner of its triangle, by its two sides' slopes.
using SixTerms = std::vector<std::array<Real, 3>>;  // place, d/dx, d/dy

SixTerms gradient(const mesh::Mesh& mesh, std::size_t t, std::size_t i) {
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

}  // namespace

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

std::vector<Row> equilibrium(const problem::Problem& problem, const Real& multiplier) {
  const mesh::Mesh& mesh = problem.mesh;
  std::vector<Row> rows;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& n = mesh.triangles[t].nodes;
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(mesh.triangles[t].region)];
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
    y.right_side = (Real(soil.unit_weight) + multiplier * Real(soil.live_unit_weight)) * area2;
    rows.push_back(x);
    rows.push_back(y);
  }
  std::array<Row, 3> resultant;
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    const Plane a = node(mesh, edge.first), b = node(mesh, edge.second);
    const Real nx = b.y - a.y, ny = a.x - b.x;  // outward of the left triangle, times the length
    const Real tx = -ny, ty = nx;
    for (const int end : {edge.first, edge.second}) {
      const std::size_t left =
          9 * static_cast<std::size_t>(edge.left) + 3 * corner(mesh, edge.left, end);
      if (edge.right >= 0) {
        const std::size_t right =
            9 * static_cast<std::size_t>(edge.right) + 3 * corner(mesh, edge.right, end);
        rows.push_back({{{left, nx}, {left + 2, ny}, {right, -nx}, {right + 2, -ny}}, 0});
        rows.push_back({{{left + 2, nx}, {left + 1, ny}, {right + 2, -nx}, {right + 1, -ny}}, 0});
        continue;
      }
      const problem::Boundary& on = boundary_of(problem, edge);
      const Real square = nx * nx + ny * ny;
      if (on.normal == problem::Known::traction) {
        rows.push_back(
            {{{left, nx * nx}, {left + 1, ny * ny}, {left + 2, 2 * nx * ny}},
             square * (Real(on.normal_stress) + multiplier * Real(on.live_normal_stress))});
      }
      if (on.tangential == problem::Known::traction) {
        rows.push_back(
            {{{left, tx * nx}, {left + 1, ty * ny}, {left + 2, tx * ny + ty * nx}},
             square * (Real(on.shear_stress) + multiplier * Real(on.live_shear_stress))});
      }
      if (!on_footing(on)) continue;
      for (int motion = 0; motion < 3; ++motion) {
        const Plane here = rigid(problem, motion, node(mesh, end));
        const Plane there =
            rigid(problem, motion, node(mesh, end == edge.first ? edge.second : edge.first));
        const Real x = (2 * here.x + there.x) / 6, y = (2 * here.y + there.y) / 6;
        auto& terms = resultant[static_cast<std::size_t>(motion)].terms;
        terms.emplace_back(left, x * nx);
        terms.emplace_back(left + 1, y * ny);
        terms.emplace_back(left + 2, x * ny + y * nx);
      }
    }
  }
  for (std::size_t motion = 0; motion < 3; ++motion) {
    if (!problem.footing.may_move[motion]) continue;
    resultant[motion].right_side = Real(problem.footing.dead_load[motion]) +
                                   multiplier * Real(problem.footing.live_load[motion]);
    rows.push_back(resultant[motion]);
  }
  return rows;
}

std::vector<Row> contacts(const problem::Problem& problem) {
  std::vector<Row> rows;
  for (const mesh::Edge& edge : mesh::edges_of(problem.mesh)) {
    if (edge.right >= 0 || !boundary_of(problem, edge).may_open) continue;
    const Plane a = node(problem.mesh, edge.first), b = node(problem.mesh, edge.second);
    const Real nx = b.y - a.y, ny = a.x - b.x;
    for (const int end : {edge.first, edge.second}) {
      const std::size_t at =
          9 * static_cast<std::size_t>(edge.left) + 3 * corner(problem.mesh, edge.left, end);
      rows.push_back({{{at, nx * nx}, {at + 1, ny * ny}, {at + 2, 2 * nx * ny}}, 0});
    }
  }
  return rows;
}

Strength strength_of(const problem::Problem& problem) {
  const Real phi(problem.soils[0].friction_angle);
  return {Real(problem.soils[0].cohesion), sin(phi), cos(phi)};
}

std::vector<Flow> flows(const problem::Problem& problem) {
  const mesh::Mesh& mesh = problem.mesh;
  const Strength soil = strength_of(problem);
  std::vector<Flow> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      Flow flow;
      flow.ratio = soil.sine;
      flow.weight = Real(mesh::twice_area(mesh, mesh.triangles[t])) / 6;
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
  const std::size_t footing = 12 * mesh.triangles.size();  // its three motions
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    if (edge.right < 0 && boundary_of(problem, edge).normal == problem::Known::traction) continue;
    const bool rolls =
        edge.right < 0 && boundary_of(problem, edge).tangential == problem::Known::traction;
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
      flow.opens = edge.right < 0 && boundary_of(problem, edge).may_open;
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
      if (edge.right < 0 && on_footing(boundary_of(problem, edge))) {
        const Real middle_x = (a.x + b.x) / 2, middle_y = (a.y + b.y) / 2;
        const Plane at{share[0] * a.x + share[1] * middle_x + share[2] * b.x,
                       share[0] * a.y + share[1] * middle_y + share[2] * b.y};
        for (int motion = 0; motion < 3; ++motion) {
          if (!problem.footing.may_move[static_cast<std::size_t>(motion)]) continue;
          const Plane moved = rigid(problem, motion, at);
          const std::size_t index = footing + static_cast<std::size_t>(motion);
          flow.dilation.terms.emplace_back(index, moved.x * ty - moved.y * tx);
          if (!rolls) flow.shear[0].terms.emplace_back(index, moved.x * tx + moved.y * ty);
        }
      }
      all.push_back(flow);
    }
  }
  return all;
}

Real value(const Row& row, const std::vector<Real>& x) {
  return -(row.residual(x) - row.right_side);
}

Power power_of_loads(const problem::Problem& problem, const std::vector<Real>& velocity) {
  const mesh::Mesh& mesh = problem.mesh;
  Power power;
  // A quadratic's integral by its middles, and along a side by Simpson's rule.
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(mesh.triangles[t].region)];
    for (std::size_t i = 3; i < 6; ++i) {
      const Real down =
          -velocity[12 * t + 2 * i + 1] * Real(mesh::twice_area(mesh, mesh.triangles[t])) / 6;
      power.dead += down * Real(soil.unit_weight);
      power.live += down * Real(soil.live_unit_weight);
    }
  }
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    if (edge.right >= 0) continue;
    const problem::Boundary& on = boundary_of(problem, edge);
    const Plane a = node(mesh, edge.first), b = node(mesh, edge.second);
    const Real tx = b.x - a.x, ty = b.y - a.y, nx = ty, ny = -tx;
    const std::size_t i = corner(mesh, edge.left, edge.first);
    const std::size_t j = corner(mesh, edge.left, edge.second);
    const std::size_t start = 12 * static_cast<std::size_t>(edge.left);
    const std::size_t middle = 3 + ((i + 1) % 3 == j ? i : j);
    const auto mean = [&](std::size_t xy) {
      return (velocity[start + 2 * i + xy] + 4 * velocity[start + 2 * middle + xy] +
              velocity[start + 2 * j + xy]) /
             6;
    };
    const Real across = mean(0) * nx + mean(1) * ny, along = mean(0) * tx + mean(1) * ty;
    if (on.normal == problem::Known::traction) {
      power.dead += across * Real(on.normal_stress);
      power.live += across * Real(on.live_normal_stress);
    }
    if (on.tangential == problem::Known::traction) {
      power.dead += along * Real(on.shear_stress);
      power.live += along * Real(on.live_shear_stress);
    }
  }
  for (std::size_t motion = 0; motion < 3; ++motion) {
    if (!problem.footing.may_move[motion]) continue;
    const Real moved = velocity[12 * mesh.triangles.size() + motion];
    power.dead += moved * Real(problem.footing.dead_load[motion]);
    power.live += moved * Real(problem.footing.live_load[motion]);
  }
  return power;
}

}  // namespace exact_equations

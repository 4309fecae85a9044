// A membrane pressed onto an obstacle: min(u - psi, -Laplace(u) + f) = 0, u = 0 on the edge.
//
//   jfnk_obstacle        30 x 30 nodes
//   jfnk_obstacle 100    100 x 100 nodes
//
// The residual has a kink wherever the membrane just touches. Solved from above without and with a
// preconditioner (the Cholesky factor of the Laplacian); no second derivative of anything is
// needed. The check at the end is that of the mathematics: nowhere below the obstacle, and in
// balance wherever it is above.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "jfnk/jfnk.hpp"

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// h^2 times the five-point Laplacian with m x m interior nodes.
Sparse laplacian(int m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < m * m; ++row) {
    entries.emplace_back(row, row, 4.0);
    if (row % m > 0) entries.emplace_back(row, row - 1, -1.0);
    if (row % m < m - 1) entries.emplace_back(row, row + 1, -1.0);
    if (row >= m) entries.emplace_back(row, row - m, -1.0);
    if (row < m * (m - 1)) entries.emplace_back(row, row + m, -1.0);
  }
  Sparse matrix(m * m, m * m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

struct Membrane {
  Sparse minus_laplacian;
  jfnk::Vector obstacle;
  double load;  // f h^2

  void operator()(const jfnk::Vector& u, jfnk::Vector& r) const {
    r.noalias() = minus_laplacian * u;
    r.array() += load;
    r = r.cwiseMin(u - obstacle);
  }
};

struct Cholesky {
  Eigen::SimplicialLLT<Sparse> factor;
  void apply(const jfnk::Vector& r, jfnk::Vector& z) const { z = factor.solve(r); }
};

}  // namespace

int main(int argc, char** argv) {
  const int m = argc > 1 ? std::atoi(argv[1]) : 30;
  if (m < 2) {
    std::fprintf(stderr, "usage: jfnk_obstacle [nodes per side >= 2]\n");
    return 2;
  }
  const double h = 1.0 / (m + 1.0);
  Membrane membrane{laplacian(m), jfnk::Vector(m * m), 8.0 * h * h};
  for (int k = 0; k < m * m; ++k) {
    const double x = (k % m + 1) * h - 0.5;
    const double y = (k / m + 1) * h - 0.5;
    membrane.obstacle[k] = -0.1 - 2.0 * (x * x + y * y);
  }
  const Cholesky cholesky{Eigen::SimplicialLLT<Sparse>(membrane.minus_laplacian)};
  bool all_converged = true;

  const auto run = [&](const char* name, const auto& preconditioner) {
    jfnk::Vector u = jfnk::Vector::Zero(m * m);
    const jfnk::Report report = jfnk::solve(membrane, u, jfnk::Options{}, preconditioner);
    const jfnk::Vector room = u - membrane.obstacle;
    const auto touching = (room.array() < 1e-4).count();
    std::printf("%-24s %4d evaluations, %ld of %d nodes touch, least room %.1e\n", name,
                report.counts.total(), static_cast<long>(touching), m * m, room.minCoeff());
    if (!report.converged()) std::printf("  %s\n", report.reason.c_str());
    all_converged = all_converged && report.converged();
  };
  run("without preconditioner", jfnk::Identity{});
  run("Laplacian factorised", cholesky);
  return all_converged ? 0 : 3;
}

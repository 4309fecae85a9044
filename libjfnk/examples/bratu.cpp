// The Bratu problem: -Laplace(u) = lambda exp(u) on the unit square, u = 0 on its edge.
//
//   jfnk_bratu            32 x 32 unknowns, lambda = 6
//   jfnk_bratu 128 6.8    128 x 128 unknowns, close to the turning point at lambda = 6.808
//
// Solved six times: by the default (the hybrid) with and without learning the Jacobian and with a
// preconditioner, by plain Newton-Krylov without and with it, and by the algorithm of Appendix A of
// Chen, Huang & Lyamin 2020. Every line counts residual evaluations and Jacobian actions, and
// processor time. The preconditioner is the Cholesky factor of the Laplacian alone.
#include <Eigen/SparseCholesky>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
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

struct Bratu {
  Sparse minus_laplacian;
  double weight;  // lambda h^2

  void operator()(const jfnk::Vector& u, jfnk::Vector& r) const {
    r.noalias() = minus_laplacian * u;
    r.array() -= weight * u.array().exp();
  }
};

struct Cholesky {
  Eigen::SimplicialLLT<Sparse> factor;
  void apply(const jfnk::Vector& r, jfnk::Vector& z) const { z = factor.solve(r); }
};

void print(const char* name, const jfnk::Report& report, const jfnk::Vector& u, double seconds) {
  std::printf("%-28s %4d evaluations, %7.3f s, max u = %.6f, %s\n", name, report.counts.total(),
              seconds, u.maxCoeff(), std::string(jfnk::to_string(report.status)).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const int m = argc > 1 ? std::atoi(argv[1]) : 32;
  const double lambda = argc > 2 ? std::atof(argv[2]) : 6.0;
  if (m < 2 || !(lambda > 0.0)) {
    std::fprintf(stderr, "usage: jfnk_bratu [nodes per side >= 2] [lambda > 0]\n");
    return 2;
  }
  const Bratu bratu{laplacian(m), lambda / ((m + 1.0) * (m + 1.0))};
  const Cholesky cholesky{Eigen::SimplicialLLT<Sparse>(bratu.minus_laplacian)};
  bool all_converged = true;

  const auto run = [&](const char* name, const jfnk::Options& options, const auto& preconditioner) {
    jfnk::Vector u = jfnk::Vector::Zero(m * m);
    const std::clock_t begin = std::clock();
    const jfnk::Report report = jfnk::solve(bratu, u, options, preconditioner);
    print(name, report, u, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (!report.converged()) std::printf("  %s\n", report.reason.c_str());
    all_converged = all_converged && report.converged();
  };
  jfnk::Options without_learning;
  without_learning.learning.enabled = false;
  run("default", jfnk::Options{}, jfnk::Identity{});
  run("default, without learning", without_learning, jfnk::Identity{});
  run("default, Laplacian", jfnk::Options{}, cholesky);
  run("Newton-Krylov", jfnk::newton_krylov(), jfnk::Identity{});
  run("Newton-Krylov, Laplacian", jfnk::newton_krylov(), cholesky);
  run("Appendix A, m_max = 200", jfnk::appendix_a(1e-6, 1e-6, 200), jfnk::Identity{});
  return all_converged ? 0 : 3;
}

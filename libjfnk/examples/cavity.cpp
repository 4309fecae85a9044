// Flow in a box whose lid slides: stream function psi and vorticity omega,
//
//   -Laplace(psi) = omega,   -Laplace(omega) / Re + psi_y omega_x - psi_x omega_y = 0,
//
// with the vorticity of the walls after Thom (1933).
//
//   jfnk_cavity            32 x 32 nodes, Re = 100
//   jfnk_cavity 64 1000    64 x 64 nodes, Re = 1000
//
// The preconditioner is jfnk::ColouredJacobian: the sparsity is given, the entries come from
// differences of the residual, one per colour. It is set up at the start, and again only if that
// pays. Ghia, Ghia & Shin (1982) give min psi = -0.1034 at Re = 100 and -0.1179 at Re = 1000.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "jfnk/jfnk.hpp"

namespace {

struct Cavity {
  int m;
  double reynolds;

  [[nodiscard]] int size() const { return 2 * m * m; }
  [[nodiscard]] bool inside(int i, int j) const { return i >= 0 && j >= 0 && i < m && j < m; }
  [[nodiscard]] double psi(const jfnk::Vector& u, int i, int j) const {
    return inside(i, j) ? u[2 * (j * m + i)] : 0.0;
  }
  [[nodiscard]] double omega(const jfnk::Vector& u, int i, int j) const {
    if (inside(i, j)) return u[2 * (j * m + i) + 1];
    const double h = 1.0 / (m + 1.0);
    const double beside = psi(u, std::clamp(i, 0, m - 1), std::clamp(j, 0, m - 1));
    return -2.0 * beside / (h * h) - (j >= m ? 2.0 / h : 0.0);
  }
  void operator()(const jfnk::Vector& u, jfnk::Vector& r) const {
    const double h = 1.0 / (m + 1.0);
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i) {
        const auto minus_laplacian = [&](const auto& f) {
          return 4.0 * f(i, j) - f(i - 1, j) - f(i + 1, j) - f(i, j - 1) - f(i, j + 1);
        };
        const auto p = [&](int a, int b) { return psi(u, a, b); };
        const auto w = [&](int a, int b) { return omega(u, a, b); };
        const double psi_x = 0.5 * (p(i + 1, j) - p(i - 1, j));
        const double psi_y = 0.5 * (p(i, j + 1) - p(i, j - 1));
        const double omega_x = 0.5 * (w(i + 1, j) - w(i - 1, j));
        const double omega_y = 0.5 * (w(i, j + 1) - w(i, j - 1));
        const int k = 2 * (j * m + i);
        r[k] = minus_laplacian(p) - h * h * w(i, j);
        r[k + 1] = minus_laplacian(w) / reynolds + psi_y * omega_x - psi_x * omega_y;
      }
    }
  }
  /// Each equation of a node sees both unknowns of the node, of its four neighbours, and nothing
  /// else.
  [[nodiscard]] jfnk::Sparsity sparsity() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i) {
        for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          if (!inside(i + di, j + dj)) continue;
          const int row = 2 * (j * m + i);
          const int column = 2 * ((j + dj) * m + i + di);
          for (const int a : {0, 1}) {
            for (const int b : {0, 1}) entries.emplace_back(row + a, column + b, 1.0);
          }
        }
      }
    }
    jfnk::Sparsity matrix(size(), size());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }
};

}  // namespace

int main(int argc, char** argv) {
  const int m = argc > 1 ? std::atoi(argv[1]) : 32;
  const double reynolds = argc > 2 ? std::atof(argv[2]) : 100.0;
  if (m < 4 || !(reynolds > 0.0)) {
    std::fprintf(stderr, "usage: jfnk_cavity [nodes per side >= 4] [Re > 0]\n");
    return 2;
  }
  const Cavity cavity{m, reynolds};
  jfnk::ColouredJacobian jacobian(cavity, cavity.sparsity());
  jfnk::Options options;
  options.setup_cost = jacobian.colours() + 1;
  jfnk::Vector u = jfnk::Vector::Zero(cavity.size());
  const jfnk::Report report = jfnk::solve(cavity, u, options, jacobian);

  double lowest = 0.0;
  for (int k = 0; k < m * m; ++k) lowest = std::min(lowest, u[2 * k]);
  std::printf("%s\nJacobian: %d colours, %d setups, %d evaluations\nmin psi = %.4f\n",
              report.reason.c_str(), jacobian.colours(), report.counts.preconditioner_setups,
              jacobian.evaluations(), lowest);
  return report.converged() ? 0 : 3;
}

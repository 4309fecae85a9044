#include <cmath>

#include "grid.hpp"
#include "problem.hpp"

namespace peers {
namespace {

Problem bratu(const char* name, bool for_tuning, int m, double lambda) {
  const Grid grid{m};
  const double weight = lambda * grid.h() * grid.h();
  return {name, for_tuning, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = grid.minus_laplacian(u, i, j) - weight * std::exp(u[k]);
            });
            return true;
          }};
}

/// -nu Laplace(u) + u u_x + u u_y = 0, u = 1 below and to the left, -1 elsewhere, central.
Problem burgers(const char* name, bool for_tuning, int m, double viscosity) {
  const Grid grid{m};
  const double c = 0.5 * grid.h() / viscosity;
  return {name, for_tuning, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) {
              return grid.inside(i, j) ? u[grid.at(i, j)] : (i < 0 || j < 0 ? 1.0 : -1.0);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double w = at(i - 1, j), e = at(i + 1, j), s = at(i, j - 1), n = at(i, j + 1);
              r[k] = 4.0 * u[k] - w - e - s - n + c * u[k] * (e - w + n - s);
            });
            return true;
          }};
}

/// Lid-driven cavity: stream function and vorticity, Thom's vorticity on the walls.
Problem cavity(const char* name, bool for_tuning, int m, double reynolds) {
  const Grid grid{m};
  const double h = grid.h();
  return {name, for_tuning, Vector::Zero(2 * m * m), [=](const Vector& u, Vector& r) {
            const Eigen::Index half = static_cast<Eigen::Index>(m) * m;
            const auto psi = [&](int i, int j) {
              return grid.inside(i, j) ? u[grid.at(i, j)] : 0.0;
            };
            const auto omega = [&](int i, int j) {
              if (grid.inside(i, j)) return u[half + grid.at(i, j)];
              const int ii = std::min(std::max(i, 0), m - 1);
              const int jj = std::min(std::max(j, 0), m - 1);
              return -2.0 * psi(ii, jj) / (h * h) - (j >= m ? 2.0 / h : 0.0);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = grid.minus_laplacian(u, i, j) - h * h * u[half + k];
              const double laplacian = omega(i - 1, j) + omega(i + 1, j) + omega(i, j - 1) +
                                       omega(i, j + 1) - 4.0 * omega(i, j);
              const double psi_y = 0.5 * (psi(i, j + 1) - psi(i, j - 1));
              const double psi_x = 0.5 * (psi(i + 1, j) - psi(i - 1, j));
              const double omega_x = 0.5 * (omega(i + 1, j) - omega(i - 1, j));
              const double omega_y = 0.5 * (omega(i, j + 1) - omega(i, j - 1));
              r[half + k] = -laplacian / reynolds + psi_y * omega_x - psi_x * omega_y;
            });
            return true;
          }};
}

/// -div(u^3 grad u) = 1, u = 1 around: diffusion that grows with the solution.
Problem nonlinear_diffusion(const char* name, bool for_tuning, int m) {
  const Grid grid{m};
  const double source = 10.0 * grid.h() * grid.h();
  return {name, for_tuning, Vector::Ones(m * m), [=](const Vector& u, Vector& r) {
            const auto flux = [](double a, double b) {
              const double mean = 0.5 * (a + b);
              return mean * mean * mean * (a - b);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = -source;
              for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                r[k] += flux(u[k], grid.value(u, i + di, j + dj, 1.0));
              }
            });
            return true;
          }};
}

/// Predators and prey on 8 x 8 nodes with no flux through the edge: the food web by which the
/// Krylov solvers of KINSOL are shown (Brown & Saad 1990), three species of each.
Problem food_web(const char* name, bool for_tuning, double predators_at_start) {
  constexpr int m = 8;
  constexpr int prey = 3;
  constexpr int species = 2 * prey;
  const Eigen::Index n = static_cast<Eigen::Index>(m) * m * species;
  Vector start(n);
  Vector scale(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const bool is_prey = k % species < prey;
    start[k] = is_prey ? 1.0 : predators_at_start;
    scale[k] = is_prey ? 1.0 : 1e5;
  }
  const auto residual = [](const Vector& c, Vector& r) {
    const auto at = [&](int i, int j, int s) {
      const auto mirrored = [](int k) { return k < 0 ? 1 : (k >= m ? m - 2 : k); };
      return c[(static_cast<Eigen::Index>(mirrored(j)) * m + mirrored(i)) * species + s];
    };
    for (int j = 0; j < m; ++j) {
      for (int i = 0; i < m; ++i) {
        double sum[2] = {0.0, 0.0};
        for (int s = 0; s < species; ++s) sum[s / prey] += at(i, j, s);
        const double growth = 1.0 + i * j / ((m - 1.0) * (m - 1.0));
        for (int s = 0; s < species; ++s) {
          const bool is_prey = s < prey;
          const double diffusion = (is_prey ? 1.0 : 0.5) * (m - 1.0) * (m - 1.0);
          const double rate = is_prey ? growth - at(i, j, s) - 0.5e-6 * sum[1]
                                      : -growth + 1e4 * sum[0] - at(i, j, s);
          r[(static_cast<Eigen::Index>(j) * m + i) * species + s] =
              diffusion * (at(i - 1, j, s) + at(i + 1, j, s) + at(i, j - 1, s) + at(i, j + 1, s) -
                           4.0 * at(i, j, s)) +
              at(i, j, s) * rate;
        }
      }
    }
    return true;
  };
  return {name, for_tuning, start, residual, 1e-6, scale, scale};
}

/// Chandrasekhar's H-equation by the midpoint rule (Kelley 1995, section 5.6).
Problem h_equation(const char* name, bool for_tuning, int n, double albedo) {
  return {name, for_tuning, Vector::Ones(n), [=](const Vector& u, Vector& r) {
            for (int i = 0; i < n; ++i) {
              double sum = 0.0;
              for (int j = 0; j < n; ++j) sum += (i + 0.5) / (i + j + 1.0) * u[j];
              const double denominator = 1.0 - 0.5 * albedo / n * sum;
              if (!(denominator > 0.0)) return false;
              r[i] = u[i] - 1.0 / denominator;
            }
            return true;
          }};
}

}  // namespace

void add_grids(std::vector<Problem>& problems) {
  problems.push_back(bratu("bratu 6", true, 32, 6.0));
  problems.push_back(bratu("bratu 6.8", false, 24, 6.8));
  problems.push_back(burgers("burgers 0.02", true, 24, 0.02));
  problems.push_back(burgers("burgers 0.01", false, 32, 0.01));
  problems.push_back(cavity("cavity 100", true, 16, 100.0));
  problems.push_back(cavity("cavity 500", false, 20, 500.0));
  problems.push_back(nonlinear_diffusion("diffusion u^3", false, 24));
  problems.push_back(food_web("food web", true, 1e5));
  problems.push_back(food_web("food web, few", false, 3e4));
  problems.push_back(h_equation("H-equation 0.9", true, 100, 0.9));
  problems.push_back(h_equation("H-equation 0.9999", false, 100, 0.9999));
}

}  // namespace peers

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fourth_set.hpp"
#include "grid.hpp"

namespace peers {
namespace {

/// An image cleaned by total variation (Vogel & Oman 1996, SIAM J. Sci. Comput. 17, 227): u - z =
/// alpha div(grad u / sqrt(|grad u|^2 + beta)) with no flux through the edge, z a bright disk with
/// noise, from z; sizes in pixels. The least of a strictly convex function.
Problem denoising(const char* name, int m) {
  constexpr double alpha = 0.2, beta = 0.01;
  const Grid grid{m};
  Vector image(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    const double bright = std::hypot(i + 0.5 - 0.5 * m, j + 0.5 - 0.5 * m) < 0.3 * m ? 1.0 : 0.0;
    const double scattered =
        std::fmod(43758.5453 * std::abs(std::sin(12.9898 * i + 78.233 * j)), 1.0);
    image[k] = bright + 0.4 * (scattered - 0.5);
  });
  return {name, false, image, [=](const Vector& u, Vector& r) {
            r = u - image;
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double x = i + 1 < m ? u[k + 1] - u[k] : 0.0;
              const double y = j + 1 < m ? u[k + m] - u[k] : 0.0;
              const double weight = alpha / std::sqrt(x * x + y * y + beta);
              r[k] -= weight * (x + y);
              if (i + 1 < m) r[k + 1] += weight * x;
              if (j + 1 < m) r[k + m] += weight * y;
            });
            return true;
          }};
}

/// A step of u_t = Laplace(u^3) by backward Euler: the porous-medium equation, from Barenblatt's
/// profile at t = 1 that ends at radius 2 and is zero beyond (Vázquez 2007); |x|, |y| < 4.
Problem porous_medium(const char* name, int m, double step) {
  const Grid grid{m};
  const double h = 8.0 * grid.h();
  Vector start(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    const double x = (i + 1) * h - 4.0;
    const double y = (j + 1) * h - 4.0;
    start[k] = std::sqrt(std::max(0.0, 4.0 - x * x - y * y) / 18.0);
  });
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const Vector cube = u.array().cube();
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = u[k] - start[k] + step / (h * h) * grid.minus_laplacian(cube, i, j);
            });
            return true;
          }};
}

/// det Hess(u) = f such that u = exp((x^2 + y^2) / 2), by central differences, times h^2; from the
/// root of Laplace(u) = sqrt(2 f) (Benamou, Froese & Oberman 2010, M2AN 44, 737).
Problem monge_ampere(const char* name, int m) {
  const Grid grid{m};
  const double h = grid.h();
  const auto square = [=](int i, int j) { return h * h * ((i + 1) * (i + 1) + (j + 1) * (j + 1)); };
  const auto f = [=](int i, int j) { return (1.0 + square(i, j)) * std::exp(square(i, j)); };
  const auto edge = [=](int i, int j) { return std::exp(0.5 * square(i, j)); };
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(m * m, m * m);
  Vector right(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    laplacian(k, k) = 4.0;
    right[k] = -h * h * std::sqrt(2.0 * f(i, j));
    for (const auto& [di, dj] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      if (grid.inside(i + di, j + dj)) {
        laplacian(k, grid.at(i + di, j + dj)) = -1.0;
      } else {
        right[k] += edge(i + di, j + dj);
      }
    }
  });
  return {name, false, laplacian.llt().solve(right), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) {
              return grid.inside(i, j) ? u[grid.at(i, j)] : edge(i, j);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double xx = at(i + 1, j) - 2.0 * u[k] + at(i - 1, j);
              const double yy = at(i, j + 1) - 2.0 * u[k] + at(i, j - 1);
              const double xy = 0.25 * (at(i + 1, j + 1) - at(i + 1, j - 1) - at(i - 1, j + 1) +
                                        at(i - 1, j - 1));
              r[k] = (xx * yy - xy * xy) / (h * h) - h * h * f(i, j);
            });
            return true;
          }};
}

/// A step by backward Euler of a liquid film that is about to rupture under van der Waals' forces:
/// h_t = (h^3 p_x)_x with the pressure p = 1 / (3 h^3) - h_xx (Witelski & Bernoff 1999, Phys.
/// Fluids 11, 2443), periodic over the wave that grows fastest. Without a value where it is not
/// positive.
Problem film(const char* name, int n, double step) {
  const double length = 2.0 * std::numbers::pi * std::numbers::sqrt2;
  const double dx = length / n;
  Vector start(n);
  for (int i = 0; i < n; ++i) start[i] = 1.0 - 0.5 * std::cos(2.0 * std::numbers::pi * i / n);
  return {name, false, start, [=](const Vector& u, Vector& r) {
            if (!(u.minCoeff() > 0.0)) return false;
            const Vector cube = u.array().cube();
            const auto around = [=](int i) { return (i + n) % n; };
            Vector pressure(n);
            for (int i = 0; i < n; ++i) {
              const double bend = u[around(i - 1)] - 2.0 * u[i] + u[around(i + 1)];
              pressure[i] = 1.0 / (3.0 * cube[i]) - bend / (dx * dx);
            }
            const auto flow = [&](int from, int to) {
              return 0.5 * (cube[from] + cube[to]) * (pressure[from] - pressure[to]) / dx;
            };
            for (int i = 0; i < n; ++i) {
              r[i] =
                  u[i] - start[i] + step / dx * (flow(i, around(i + 1)) - flow(around(i - 1), i));
            }
            return true;
          }};
}

}  // namespace

/// (1 + Laplace)^2 u + mu u - nu u^2 + u^3 = 0, Swift & Hohenberg's equation with the quadratic
/// term by which hexagons arise (Lloyd et al. 2008, SIAM J. Appl. Dyn. Syst. 7, 1049, with their
/// nu); two by two of them, mirrored at the edges; zero is a root as well. Starts from three waves
/// of the amplitude A at which mu - nu A + 15/4 A^2 = 0, as weakly nonlinear theory has it.
Problem hexagons(const char* name, int m) {
  constexpr double mu = 0.1, nu = 1.6;
  const Grid grid{m};
  const double root3 = std::numbers::sqrt3;
  const double dx = 4.0 * std::numbers::pi / m;
  const double dy = dx / root3;
  const double amplitude = (nu + std::sqrt(nu * nu - 15.0 * mu)) / 7.5;
  Vector start(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    const double x = (i + 0.5) * dx;
    const double y = (j + 0.5) * dy;
    start[k] = amplitude * (std::cos(x) + 2.0 * std::cos(0.5 * x) * std::cos(0.5 * root3 * y));
  });
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto one_plus_laplacian = [&](const Vector& v, int i, int j) {
              const auto at = [&](int a, int b) {
                const auto mirrored = [&](int k) { return k < 0 ? 0 : std::min(k, m - 1); };
                return v[grid.at(mirrored(a), mirrored(b))];
              };
              return at(i, j) + (at(i - 1, j) - 2.0 * at(i, j) + at(i + 1, j)) / (dx * dx) +
                     (at(i, j - 1) - 2.0 * at(i, j) + at(i, j + 1)) / (dy * dy);
            };
            Vector once(m * m);
            for_each_node(
                grid, [&](int i, int j, Eigen::Index k) { once[k] = one_plus_laplacian(u, i, j); });
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = one_plus_laplacian(once, i, j) + u[k] * (mu + u[k] * (u[k] - nu));
            });
            return true;
          }};
}

/// Large deflections w of a clamped plate whose edge is free to slide, with Airy's function phi
/// (von Kármán 1910): Laplace^2(w) = [w, phi] + q, Laplace^2(phi) = -[w, w] / 2 with
/// [a, b] = a_xx b_yy + a_yy b_xx - 2 a_xy b_xy, times h^4.
Problem karman_plate(const char* name, int m, double load) {
  const Grid grid{m};
  const double weight = load * std::pow(grid.h(), 4);
  const Eigen::Index nodes = static_cast<Eigen::Index>(m) * m;
  return {name, false, Vector::Zero(2 * nodes), [=](const Vector& u, Vector& r) {
            const auto at = [&](int field, int i, int j) {
              if (i == -1 || j == -1 || i == m || j == m) return 0.0;
              const auto mirrored = [&](int k) { return k < 0 ? 0 : std::min(k, m - 1); };
              return u[field * nodes + grid.at(mirrored(i), mirrored(j))];
            };
            const auto xx = [&](int f, int i, int j) {
              return at(f, i - 1, j) - 2.0 * at(f, i, j) + at(f, i + 1, j);
            };
            const auto yy = [&](int f, int i, int j) {
              return at(f, i, j - 1) - 2.0 * at(f, i, j) + at(f, i, j + 1);
            };
            const auto xy = [&](int f, int i, int j) {
              return 0.25 * (at(f, i + 1, j + 1) - at(f, i + 1, j - 1) - at(f, i - 1, j + 1) +
                             at(f, i - 1, j - 1));
            };
            const auto laplacian = [&](int f, int i, int j) { return xx(f, i, j) + yy(f, i, j); };
            const auto bilaplacian = [&](int f, int i, int j) {
              return laplacian(f, i - 1, j) + laplacian(f, i + 1, j) + laplacian(f, i, j - 1) +
                     laplacian(f, i, j + 1) - 4.0 * laplacian(f, i, j);
            };
            const auto bracket = [&](int a, int b, int i, int j) {
              return xx(a, i, j) * yy(b, i, j) + yy(a, i, j) * xx(b, i, j) -
                     2.0 * xy(a, i, j) * xy(b, i, j);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = bilaplacian(0, i, j) - bracket(0, 1, i, j) - weight;
              r[nodes + k] = bilaplacian(1, i, j) + 0.5 * bracket(0, 0, i, j);
            });
            return true;
          }};
}

/// Concentration and temperature along a tubular reactor with axial dispersion (Heinemann & Poore
/// 1981, Chem. Eng. Sci. 36, 1411), from those of the feed. Without a value where the temperature
/// is not positive.
Problem tubular_reactor(const char* name, int n) {
  constexpr double peclet = 5.0, gamma = 25.0, heat = 0.5, cooling = 3.5, damkoehler = 0.17;
  const double dx = 1.0 / (n - 1.0);
  return {name, false, Vector::Ones(2 * n), [=](const Vector& u, Vector& r) {
            if (!(u.tail(n).minCoeff() > 0.0)) return false;
            // Of a field that starts at u[first]: dispersion less transport.
            const auto carried = [&](int first, int i) {
              const double here = u[first + i];
              const double after = u[first + (i + 1 < n ? i + 1 : n - 2)];
              const double before =
                  i > 0 ? u[first + i - 1] : u[first + 1] - 2.0 * dx * peclet * (here - 1.0);
              return (before - 2.0 * here + after) / (peclet * dx * dx) -
                     (after - before) / (2.0 * dx);
            };
            for (int i = 0; i < n; ++i) {
              const double rate = damkoehler * u[i] * std::exp(gamma - gamma / u[n + i]);
              r[i] = dx * (carried(0, i) - rate);
              r[n + i] = dx * (carried(n, i) - cooling * (u[n + i] - 1.0) + heat * rate);
            }
            return true;
          }};
}

void add_fourth_grids(std::vector<Problem>& problems) {
  problems.push_back(denoising("denoising", 24));
  problems.push_back(hexagons("hexagons", 20));
  problems.push_back(karman_plate("plate", 14, 5000.0));
  problems.push_back(porous_medium("porous medium", 30, 1.0));
  problems.push_back(monge_ampere("Monge-Ampere", 20));
  problems.push_back(tubular_reactor("reactor", 100));
  problems.push_back(film("film", 100, 0.2));
}

}  // namespace peers

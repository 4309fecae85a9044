#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "grid.hpp"
#include "problem.hpp"
#include "problems.hpp"

namespace peers {
namespace {

/// -Laplace(u) + c u (u_x + u_y) = f by central differences, f such that the root is
/// 10 x y (1 - x) (1 - y) exp(x^4.5) (Kelley 1995, section 6.4, there with c = 20).
Problem convection(const char* name, int m, double c) {
  const Grid grid{m};
  const auto left_side = [=](const Vector& u, Vector& r) {
    for_each_node(grid, [&](int i, int j, Eigen::Index k) {
      const double slope = grid.value(u, i + 1, j) - grid.value(u, i - 1, j) +
                           grid.value(u, i, j + 1) - grid.value(u, i, j - 1);
      r[k] = grid.minus_laplacian(u, i, j) + 0.5 * c * grid.h() * u[k] * slope;
    });
  };
  Vector root(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    const double x = (i + 1) * grid.h();
    const double y = (j + 1) * grid.h();
    root[k] = 10.0 * x * y * (1.0 - x) * (1.0 - y) * std::exp(std::pow(x, 4.5));
  });
  Vector f(m * m);
  left_side(root, f);
  const auto residual = [=](const Vector& u, Vector& r) {
    left_side(u, r);
    r -= f;
    return true;
  };
  return {name, false, Vector::Zero(m * m), residual, 1e-6, {}, {}, 2, root};
}

/// -Laplace(u) = lambda exp(u) in the unit cube.
Problem bratu_in_a_cube(const char* name, int m, double lambda) {
  const double weight = lambda / ((m + 1.0) * (m + 1.0));
  return {name, false, Vector::Zero(m * m * m), [=](const Vector& u, Vector& r) {
            Eigen::Index k = 0;
            for (int z = 0; z < m; ++z) {
              for (int y = 0; y < m; ++y) {
                for (int x = 0; x < m; ++x, ++k) {
                  double sum = 6.0 * u[k] - weight * std::exp(u[k]);
                  if (x > 0) sum -= u[k - 1];
                  if (x < m - 1) sum -= u[k + 1];
                  if (y > 0) sum -= u[k - m];
                  if (y < m - 1) sum -= u[k + m];
                  if (z > 0) sum -= u[k - m * m];
                  if (z < m - 1) sum -= u[k + m * m];
                  r[k] = sum;
                }
              }
            }
            return true;
          }};
}

/// The surface of least area over |x|, |y| < 1.2 that has the edge of Scherk's, log(cos y / cos x).
Problem minimal_surface(const char* name, int m) {
  const Grid grid{m};
  const double h = 2.4 * grid.h();
  return {name, false, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) {
              if (grid.inside(i, j)) return u[grid.at(i, j)];
              return std::log(std::cos((j + 1) * h - 1.2) / std::cos((i + 1) * h - 1.2));
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double x = (at(i + 1, j) - at(i - 1, j)) / (2.0 * h);
              const double y = (at(i, j + 1) - at(i, j - 1)) / (2.0 * h);
              const double xx = at(i + 1, j) - 2.0 * u[k] + at(i - 1, j);
              const double yy = at(i, j + 1) - 2.0 * u[k] + at(i, j - 1);
              const double xy = 0.25 * (at(i + 1, j + 1) - at(i + 1, j - 1) - at(i - 1, j + 1) +
                                        at(i - 1, j - 1));
              r[k] = -(1.0 + y * y) * xx + 2.0 * x * y * xy - (1.0 + x * x) * yy;
            });
            return true;
          }};
}

/// -div(|grad u|^(p - 2) grad u) = 1, the slope of each face from the four nodes beside it.
Problem p_laplacian(const char* name, int m, double p) {
  const Grid grid{m};
  const double h = grid.h();
  return {name, false, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) { return grid.value(u, i, j); };
            const auto flux = [&](int i, int j, int di, int dj) {
              const double along = (at(i + di, j + dj) - at(i, j)) / h;
              const double across = (at(i + dj, j + di) - at(i - dj, j - di) +
                                     at(i + di + dj, j + dj + di) - at(i + di - dj, j + dj - di)) /
                                    (4.0 * h);
              return std::pow(1e-6 + along * along + across * across, 0.5 * (p - 2.0)) * along;
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = flux(i - 1, j, 1, 0) - flux(i, j, 1, 0) + flux(i, j - 1, 0, 1) -
                     flux(i, j, 0, 1) - h;
            });
            return true;
          }};
}

/// Lid-driven cavity by the stream function alone: Laplace^2(psi) = Re (psi_y Laplace(psi)_x -
/// psi_x Laplace(psi)_y), psi mirrored at walls (Brown & Saad 1990, section 5.1); times h^4.
Problem cavity_of_fourth_order(const char* name, int m, double reynolds) {
  const Grid grid{m};
  const double h = grid.h();
  return {
      name, false, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
        const auto psi = [&](int i, int j) {
          if (grid.inside(i, j)) return u[grid.at(i, j)];
          if (i == -1 || j == -1 || i == m || j == m) return 0.0;
          const int ii = i < 0 ? 0 : (i > m ? m - 1 : i);
          const int jj = j < 0 ? 0 : (j > m ? m - 1 : j);
          return u[grid.at(ii, jj)] + (j > m ? 2.0 * h : 0.0);
        };
        const auto laplacian = [&](int i, int j) {
          return psi(i - 1, j) + psi(i + 1, j) + psi(i, j - 1) + psi(i, j + 1) - 4.0 * psi(i, j);
        };
        for_each_node(grid, [&](int i, int j, Eigen::Index k) {
          const double w = laplacian(i - 1, j), e = laplacian(i + 1, j);
          const double s = laplacian(i, j - 1), n = laplacian(i, j + 1);
          const double x = psi(i + 1, j) - psi(i - 1, j);
          const double y = psi(i, j + 1) - psi(i, j - 1);
          r[k] =
              w + e + s + n - 4.0 * laplacian(i, j) - 0.25 * reynolds * (y * (e - w) - x * (n - s));
        });
        return true;
      }};
}

/// Grass, hares and foxes that saturate (Hastings & Powell 1991) on m x m nodes without flux
/// through the edge; the grass grows better towards one corner.
Problem food_chain(const char* name, int m) {
  const Grid grid{m};
  const Eigen::Index nodes = static_cast<Eigen::Index>(m) * m;
  Vector start(3 * nodes);
  start << Vector::Constant(nodes, 0.8), Vector::Constant(nodes, 0.2), Vector::Constant(nodes, 8.0);
  return {name, false, start, [=](const Vector& c, Vector& r) {
            const auto spread = [&](int species, int i, int j) {
              const auto at = [&](int a, int b) {
                const auto mirrored = [&](int k) { return k < 0 ? 0 : (k >= m ? m - 1 : k); };
                return c[species * nodes + grid.at(mirrored(a), mirrored(b))];
              };
              return (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) - 4.0 * at(i, j)) *
                     0.01 * (m * m);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double grass = c[k], hares = c[nodes + k], foxes = c[2 * nodes + k];
              const double grazed = 5.0 * grass * hares / (1.0 + 3.0 * grass);
              const double caught = 0.1 * hares * foxes / (1.0 + 2.0 * hares);
              const double growth = 1.0 + 0.5 * (i + j) * grid.h();
              r[k] = spread(0, i, j) + grass * (growth - grass) - grazed;
              r[nodes + k] = spread(1, i, j) + grazed - caught - 0.4 * hares;
              r[2 * nodes + k] = 10.0 * spread(2, i, j) + caught - 0.01 * foxes;
            });
            return true;
          }};
}

/// Film pressure of a journal bearing that cannot pull: min(p, -div(H^3 grad p) - 3 H') = 0 with
/// the film H = 1 + 0.8 cos(theta) (MINPACK-2), around and along.
Problem bearing(const char* name, int m) {
  const Grid grid{m};
  const double h = grid.h();
  return {name, false, Vector::Zero(m * m), [=](const Vector& p, Vector& r) {
            const auto film = [&](double i) {
              return 1.0 + 0.8 * std::cos(2.0 * std::numbers::pi * (i + 1.0) * h);
            };
            const auto cube = [](double x) { return x * x * x; };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double here = cube(film(i));
              const double flow =
                  cube(film(i - 0.5)) * (p[k] - grid.value(p, i - 1, j)) +
                  cube(film(i + 0.5)) * (p[k] - grid.value(p, i + 1, j)) +
                  here * (2.0 * p[k] - grid.value(p, i, j - 1) - grid.value(p, i, j + 1)) +
                  3.0 * h * (film(i + 0.5) - film(i - 0.5));
              r[k] = std::min(p[k], flow);
            });
            return true;
          }};
}

/// A frame of elastoplastic bars as among the first problems, long and low.
Problem beam_of_bars(const char* name) {
  const auto frame = std::make_shared<jfnk_test::PlasticTruss>(24, 5, 1e-3, 0.02);
  frame->push(0.012);
  return {name, false, Vector::Zero(frame->size()),
          [frame](const Vector& u, Vector& r) { return (*frame)(u, r) == jfnk::Evaluation::ok; }};
}

/// Beads on springs that cannot be stretched to twice the distance of rest and more, hung up at
/// both ends: the force is s / (1 - s^2) of the stretch s, which has no value from s = 1 on. Starts
/// with the first spring all but torn.
Problem beads(const char* name, int n) {
  Vector start(2 * n);
  for (int i = 0; i < n; ++i) {
    start[2 * i] = 1.95 + (n - 1.95) * i / n;
    start[2 * i + 1] = 0.0;
  }
  return {name, false, start, [=](const Vector& u, Vector& r) {
            r.setZero();
            const auto at = [&](int i) -> std::array<double, 2> {
              if (i < 0) return {0.0, 0.0};
              if (i >= n) return {n + 1.0, 0.0};
              return {u[2 * i], u[2 * i + 1]};
            };
            for (int i = 0; i <= n; ++i) {
              const auto a = at(i - 1), b = at(i);
              const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
              const double stretch = length - 1.0;
              if (!(std::abs(stretch) < 1.0)) return false;
              const double pull = stretch / (1.0 - stretch * stretch) / length;
              for (int d = 0; d < 2; ++d) {
                if (i > 0) r[2 * (i - 1) + d] += pull * (b[d] - a[d]);
                if (i < n) r[2 * i + d] -= pull * (b[d] - a[d]);
              }
            }
            for (int i = 0; i < n; ++i) r[2 * i + 1] -= 0.02;  // weight
            return true;
          }};
}

/// u'' = s sinh(s u), u(0) = 0, u(1) = 1 (Troesch), which ends in a boundary layer.
Problem troesch(const char* name, int n, double s) {
  const double h = 1.0 / (n + 1.0);
  return {name, false, Vector::LinSpaced(n, h, 1.0 - h), [=](const Vector& u, Vector& r) {
            for (int i = 0; i < n; ++i) {
              r[i] = 2.0 * u[i] - (i > 0 ? u[i - 1] : 0.0) - (i + 1 < n ? u[i + 1] : 1.0) +
                     h * h * s * std::sinh(s * u[i]);
            }
            return true;
          }};
}

/// Moré, Garbow & Hillstrom 1981, no. 12 with three equations: the root is (1, 10, 1).
bool box(const Vector& x, Vector& r) {
  for (int i = 0; i < 3; ++i) {
    const double t = 0.1 * (i + 1);
    r[i] = std::exp(-t * x[0]) - std::exp(-t * x[1]) - x[2] * (std::exp(-t) - std::exp(-10.0 * t));
  }
  return true;
}

/// No. 18 with six equations: a root is (1, 10, 1, 5, 4, 3).
bool biggs(const Vector& x, Vector& r) {
  for (int i = 0; i < 6; ++i) {
    const double t = 0.1 * (i + 1);
    r[i] = x[2] * std::exp(-t * x[0]) - x[3] * std::exp(-t * x[1]) + x[5] * std::exp(-t * x[4]) -
           (std::exp(-t) - 5.0 * std::exp(-10.0 * t) + 3.0 * std::exp(-4.0 * t));
  }
  return true;
}

}  // namespace

void add_second_set(std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  problems.push_back(convection("convection", 24, 100.0));
  problems.push_back(bratu_in_a_cube("Bratu, cube", 8, 9.5));
  problems.push_back(minimal_surface("minimal surface", 20));
  problems.push_back(p_laplacian("4-Laplacian", 20, 4.0));
  problems.push_back(cavity_of_fourth_order("cavity, 4th order", 16, 200.0));
  problems.push_back(food_chain("food chain", 10));
  problems.push_back(bearing("bearing", 24));
  problems.push_back(beam_of_bars("beam of bars"));
  problems.push_back(beads("beads", 40));
  problems.push_back(troesch("Troesch", 100, 10.0));
  problems.push_back({"Box", false, vector({0.0, 10.0, 20.0}), box});
  problems.back().root = vector({1.0, 10.0, 1.0});
  problems.push_back({"Biggs", false, vector({1.0, 2.0, 1.0, 1.0, 1.0, 1.0}), biggs});
  problems.back().root = vector({1.0, 10.0, 1.0, 5.0, 4.0, 3.0});
  problems.push_back(noisy(minimal_surface("", 12), "noisy surface", false, 1e-6));
  problems.push_back(in_other_units(food_chain("", 6), "chain, 10 decades", false, 10.0));
  for (std::size_t i = before; i < problems.size(); ++i) problems[i].set = 2;
}

}  // namespace peers

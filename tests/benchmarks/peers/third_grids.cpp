#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "grid.hpp"
#include "third_set.hpp"

namespace peers {
namespace {

/// A step of u_t = -Laplace(epsilon^2 Laplace(u) - u^3 + u) by backward Euler, periodic in
/// [0, 2 pi]^2, from the cosines of Church et al. 2019 (Commun. Comput. Phys. 26, 947) with their
/// epsilon. Uniquely solvable, as the step is below 4 epsilon^2.
Problem cahn_hilliard(const char* name, int m, double step) {
  constexpr double epsilon = 0.18;
  const Grid grid{m};
  const double h = 2.0 * std::numbers::pi / m;
  Vector start(m * m);
  for_each_node(grid, [&](int i, int j, Eigen::Index k) {
    const double x = i * h;
    const double y = j * h;
    const double c = std::cos(4.0 * x) * std::cos(3.0 * y);
    start[k] = 0.05 * (std::cos(3.0 * x) * std::cos(4.0 * y) + c * c +
                       std::cos(x - 5.0 * y) * std::cos(2.0 * x - y));
  });
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto laplacian = [&](const Vector& v, int i, int j) {
              const auto at = [&](int a, int b) { return v[grid.at((a + m) % m, (b + m) % m)]; };
              return (at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1) - 4.0 * at(i, j)) /
                     (h * h);
            };
            Vector potential(m * m);
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              potential[k] = epsilon * epsilon * laplacian(u, i, j) - u[k] * u[k] * u[k] + u[k];
            });
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              r[k] = u[k] - start[k] + step * laplacian(potential, i, j);
            });
            return true;
          }};
}

/// Flow between two disks that turn against each other: f'' = w, epsilon w'' + f w' + g g' = 0,
/// epsilon g'' + f g' - f' g = 0, f = f' = 0 and g = -1, 1 at the disks, times h^2; from the flow
/// of infinite viscosity (MINPACK-2; Ascher, Mattheij & Russell 1988).
Problem disks(const char* name, int n, double epsilon) {
  const double h = 1.0 / (n + 1.0);
  Vector start = Vector::Zero(3 * n);
  start.tail(n).setLinSpaced(-1.0 + 2.0 * h, 1.0 - 2.0 * h);
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto f = [&](int i) { return i < 0 || i >= n ? 0.0 : u[i]; };
            const auto w = [&](int i) {
              if (i < 0 || i >= n) return 2.0 * f(i < 0 ? 0 : n - 1) / (h * h);
              return u[n + i];
            };
            const auto g = [&](int i) {
              if (i < 0 || i >= n) return i < 0 ? -1.0 : 1.0;
              return u[2 * n + i];
            };
            for (int i = 0; i < n; ++i) {
              const auto slope = [&](const auto& of) { return 0.5 * h * (of(i + 1) - of(i - 1)); };
              const auto bend = [&](const auto& of) { return of(i - 1) - 2.0 * of(i) + of(i + 1); };
              r[i] = bend(f) - h * h * w(i);
              r[n + i] = epsilon * bend(w) + f(i) * slope(w) + g(i) * slope(g);
              r[2 * n + i] = epsilon * bend(g) + f(i) * slope(g) - g(i) * slope(f);
            }
            return true;
          }};
}

/// A step of water that infiltrates dry soil by backward Euler, heads [cm] unknown: van Genuchten's
/// soil and the heads of Celia, Bouloutas & Zarba 1990 (Water Resour. Res. 26, 1483), whose column
/// of 100 cm is kept at -75 cm above and -1000 cm below.
Problem richards(const char* name, int n, double seconds) {
  constexpr double dry = -1000.0;
  const double dz = 100.0 / (n + 1.0);
  const auto wetness = [](double h) {  // 1 + (alpha |h|)^2
    const double x = 0.0335 * std::min(h, 0.0);
    return 1.0 + x * x;
  };
  const auto content = [=](double h) { return 0.102 + (0.368 - 0.102) / std::sqrt(wetness(h)); };
  const auto conductivity = [=](double h) {  // [cm/s], Mualem
    const double w = wetness(h);
    const double pores = 1.0 - std::sqrt((w - 1.0) / w);
    return 0.00922 * pores * pores / std::pow(w, 0.25);
  };
  return {name, false, Vector::Constant(n, dry), [=](const Vector& u, Vector& r) {
            const auto down = [&](int i) {  // from node i - 1 to node i
              const double above = i > 0 ? u[i - 1] : -75.0;
              const double below = i < n ? u[i] : dry;
              return 0.5 * (conductivity(above) + conductivity(below)) *
                     ((above - below) / dz + 1.0);
            };
            for (int i = 0; i < n; ++i) {
              r[i] = dz * (content(u[i]) - content(dry)) - seconds * (down(i) - down(i + 1));
            }
            return true;
          }};
}

}  // namespace

/// -Laplace(psi) = (1 - |psi|^2) psi / epsilon^2 for a complex psi that turns once along the edge:
/// one vortex (Bethuel, Brezis & Hélein 1994).
Problem ginzburg_landau(const char* name, int m, double epsilon) {
  const Grid grid{m};
  const Eigen::Index nodes = static_cast<Eigen::Index>(m) * m;
  const double weight = grid.h() * grid.h() / (epsilon * epsilon);
  return {name, false, Vector::Zero(2 * nodes), [=](const Vector& u, Vector& r) {
            const auto at = [&](int part, int i, int j) {
              if (grid.inside(i, j)) return u[part * nodes + grid.at(i, j)];
              const double x = (i + 1) * grid.h() - 0.5;
              const double y = (j + 1) * grid.h() - 0.5;
              return (part == 0 ? x : y) / std::hypot(x, y);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double lack = 1.0 - u[k] * u[k] - u[nodes + k] * u[nodes + k];
              for (int part = 0; part < 2; ++part) {
                r[part * nodes + k] = (4.0 - weight * lack) * at(part, i, j) - at(part, i - 1, j) -
                                      at(part, i + 1, j) - at(part, i, j - 1) - at(part, i, j + 1);
              }
            });
            return true;
          }};
}

/// Potential, electrons and holes of a diode with an abrupt junction in the middle, without
/// recombination: Scharfetter & Gummel's scheme 1969 for the scaled equations of Markowich,
/// Ringhofer & Schmeiser 1990, Debye length sqrt(1e-3), intrinsic density 1e-6 of the doping.
/// Starts neutral, the forward bias [thermal voltages] taken by the left half.
Problem diode(const char* name, int n, double bias) {
  constexpr double debye_squared = 1e-3;
  constexpr double intrinsic = 1e-6;
  const double h = 1.0 / (n + 1.0);
  const auto doping = [=](int i) { return 2 * i < n - 1 ? -1.0 : (2 * i > n - 1 ? 1.0 : 0.0); };
  // Potential, electrons and holes where they are neutral.
  const auto neutral = [=](int i) -> std::array<double, 3> {
    const double swing = std::asinh(0.5 * doping(i) / intrinsic);
    return {swing + (doping(i) < 0.0 ? bias : 0.0), intrinsic * std::exp(swing),
            intrinsic * std::exp(-swing)};
  };
  Vector start(3 * n);
  for (int i = 0; i < n; ++i) {
    start.segment<3>(3 * i) = Eigen::Map<const Eigen::Vector3d>(neutral(i).data());
  }
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto at = [&](int i) -> std::array<double, 3> {
              if (i < 0 || i >= n) return neutral(i);
              return {u[3 * i], u[3 * i + 1], u[3 * i + 2]};
            };
            const auto bernoulli = [](double x) { return x == 0.0 ? 1.0 : x / std::expm1(x); };
            // Currents of electrons and holes between nodes i - 1 and i.
            const auto current = [&](int i) -> std::array<double, 2> {
              const auto a = at(i - 1), b = at(i);
              const double rise = b[0] - a[0];
              return {(b[1] * bernoulli(rise) - a[1] * bernoulli(-rise)) / h,
                      (a[2] * bernoulli(rise) - b[2] * bernoulli(-rise)) / h};
            };
            for (int i = 0; i < n; ++i) {
              const auto here = at(i);
              const double bend = at(i - 1)[0] - 2.0 * here[0] + at(i + 1)[0];
              r[3 * i] = debye_squared / (h * h) * bend - here[1] + here[2] + doping(i);
              const auto in = current(i), out = current(i + 1);
              r[3 * i + 1] = out[0] - in[0];
              r[3 * i + 2] = out[1] - in[1];
            }
            return true;
          }};
}

/// Air in a square between a warm wall to the left and a cold one, insulated above and below (de
/// Vahl Davis 1983): stream function, Thom's vorticity on the walls, temperature; times h^2. Starts
/// at rest, the temperature linear.
Problem warm_cavity(const char* name, int m, double rayleigh) {
  constexpr double prandtl = 0.71;
  const Grid grid{m};
  const double h = grid.h();
  const Eigen::Index nodes = static_cast<Eigen::Index>(m) * m;
  Vector start = Vector::Zero(3 * nodes);
  for_each_node(grid,
                [&](int i, int, Eigen::Index k) { start[2 * nodes + k] = 1.0 - (i + 1) * h; });
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto psi = [&](int i, int j) {
              return grid.inside(i, j) ? u[grid.at(i, j)] : 0.0;
            };
            const auto omega = [&](int i, int j) {
              if (grid.inside(i, j)) return u[nodes + grid.at(i, j)];
              const int ii = std::min(std::max(i, 0), m - 1);
              const int jj = std::min(std::max(j, 0), m - 1);
              return -2.0 * psi(ii, jj) / (h * h);
            };
            const auto warmth = [&](int i, int j) {
              const auto inside = [&](int jj) { return u[2 * nodes + grid.at(i, jj)]; };
              if (i < 0 || i >= m) return i < 0 ? 1.0 : 0.0;
              if (j < 0) return (4.0 * inside(0) - inside(1)) / 3.0;
              if (j >= m) return (4.0 * inside(m - 1) - inside(m - 2)) / 3.0;
              return inside(j);
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const auto east = [&](const auto& f) { return f(i + 1, j) - f(i - 1, j); };
              const auto north = [&](const auto& f) { return f(i, j + 1) - f(i, j - 1); };
              const auto spread = [&](const auto& f) {
                return 4.0 * f(i, j) - f(i - 1, j) - f(i + 1, j) - f(i, j - 1) - f(i, j + 1);
              };
              const auto carried = [&](const auto& f) {
                return 0.25 * (north(psi) * east(f) - east(psi) * north(f));
              };
              r[k] = spread(psi) - h * h * omega(i, j);
              r[nodes + k] = prandtl * spread(omega) + carried(omega) -
                             0.5 * h * prandtl * rayleigh * east(warmth);
              r[2 * nodes + k] = spread(warmth) + carried(warmth);
            });
            return true;
          }};
}

/// Total and direct correlation h and c of a liquid of Lennard-Jones particles: h - c = rho h * c
/// (Ornstein & Zernike) and h + 1 = exp(-beta U + h - c) (hypernetted chain), convolved by sine
/// transforms (Kelley & Pettitt 2004, J. Comput. Phys. 197, 491).
Problem ornstein_zernike(const char* name, int n) {
  constexpr double beta = 10.0, density = 0.2, depth = 0.1, diameter = 2.0, radius = 9.0;
  const double dr = radius / (n + 1.0);
  const double dk = std::numbers::pi / radius;
  Eigen::MatrixXd sine(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      sine(i, j) = std::sin(std::numbers::pi * (i + 1.0) * (j + 1.0) / (n + 1.0));
    }
  }
  const Vector r_of = Vector::LinSpaced(n, dr, n * dr);
  const Vector k_of = Vector::LinSpaced(n, dk, n * dk);
  const Vector sixth = (diameter / r_of.array()).pow(6);
  const Vector boltzmann = (-beta * 4.0 * depth * sixth.array() * (sixth.array() - 1.0)).exp();
  return {name, false, Vector::Zero(2 * n), [=](const Vector& u, Vector& r) {
            const auto transform = [&](const Vector& f) -> Vector {
              const Vector weighted = f.cwiseProduct(r_of);
              return 4.0 * std::numbers::pi * dr * (sine * weighted).cwiseQuotient(k_of);
            };
            const Vector h = u.head(n);
            const Vector c = u.tail(n);
            const Vector product = transform(h).cwiseProduct(transform(c)).cwiseProduct(k_of);
            const Vector convolved = dk / (2.0 * std::numbers::pi * std::numbers::pi) *
                                     (sine * product).cwiseQuotient(r_of);
            r.head(n) = h - c - density * convolved;
            r.tail(n) = boltzmann.array() * (h - c).array().exp() - h.array() - 1.0;
            return true;
          }};
}

void add_third_grids(std::vector<Problem>& problems) {
  problems.push_back(cahn_hilliard("Cahn-Hilliard", 24, 0.1));
  problems.push_back(ginzburg_landau("vortex", 20, 0.1));
  problems.push_back(disks("disks", 99, 0.01));
  problems.push_back(diode("diode", 99, 10.0));
  problems.push_back(richards("Richards", 99, 720.0));
  problems.push_back(warm_cavity("warm cavity", 16, 1e4));
  problems.push_back(ornstein_zernike("liquid", 100));
}

}  // namespace peers

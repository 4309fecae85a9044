#include "fourth_set.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace peers {
namespace {

/// Singular at the root, two exponents of four above one: (exp x - y)^2, 10 (y - z)^3,
/// tan(z - w)^2, w - 1 (Cragg & Levy 1969, J. Optim. Theory Appl. 4, 191; extended by Lukšan &
/// Vlček 1998).
bool cragg_levy(const Vector& x, Vector& r) {
  for (Eigen::Index i = 0; i + 3 < x.size(); i += 4) {
    const double a = std::exp(x[i]) - x[i + 1];
    const double b = x[i + 1] - x[i + 2];
    const double c = std::tan(x[i + 2] - x[i + 3]);
    r[i] = a * a;
    r[i + 1] = 10.0 * b * b * b;
    r[i + 2] = c * c;
    r[i + 3] = x[i + 3] - 1.0;
  }
  return true;
}

Problem cragg_levy_of(const char* name, int times) {
  Problem problem{name, false, vector({1.0, 2.0, 2.0, 2.0}).replicate(times, 1), cragg_levy};
  problem.root = vector({0.0, 1.0, 1.0, 1.0}).replicate(times, 1);
  return problem;
}

/// Temperatures of two stirred tanks in series of which a part flows back, with several steady
/// states (Ferraris & Tronconi 1986, Comput. Chem. Eng. 10, 129; Floudas et al. 1999, problem
/// 14.1.8).
bool two_tanks(const Vector& x, Vector& r) {
  constexpr double gamma = 1000.0, damkoehler = 22.0, beta = 2.0, recycled = 0.96;
  const auto rate = [](double phi) { return std::exp(10.0 * phi / (1.0 + 10.0 * phi / gamma)); };
  r[0] = (1.0 - recycled) * (0.1 * damkoehler / (1.0 + beta) - x[0]) * rate(x[0]) - x[0];
  r[1] = (1.0 - recycled) * (0.1 * damkoehler - beta * x[0] - (1.0 + beta) * x[1]) * rate(x[1]) +
         x[0] - (1.0 + beta) * x[1];
  return true;
}

/// What five firms sell of one good if none gains by selling more or less: prices and costs are
/// powers, without a value below zero (Murphy, Sherali & Soyster 1982, Math. Program. 24, 92).
bool cournot(const Vector& q, Vector& r) {
  constexpr std::array<double, 5> cost = {10.0, 8.0, 6.0, 4.0, 2.0};
  constexpr std::array<double, 5> beta = {1.2, 1.1, 1.0, 0.9, 0.8};
  constexpr double gamma = 1.1;
  if (!(q.minCoeff() >= 0.0) || !(q.sum() > 0.0)) return false;
  const double price = std::pow(5000.0 / q.sum(), 1.0 / gamma);
  for (int i = 0; i < 5; ++i) {
    const auto k = static_cast<std::size_t>(i);
    r[i] = cost[k] + std::pow(q[i] / 5.0, 1.0 / beta[k]) - price * (1.0 - q[i] / (gamma * q.sum()));
  }
  return true;
}

/// The velocity [km/s] that brings a satellite from one place to another in an hour, by shooting
/// (Lambert's problem; Curtis 2005, Orbital Mechanics for Engineering Students, example 5.2); miss
/// [1000 km]. Starts as if to a circle.
Problem orbit(const char* name) {
  using Place = Eigen::Vector3d;
  constexpr double earth = 398600.0;  // [km^3/s^2]
  constexpr double seconds = 3600.0;
  constexpr int steps = 200;
  const Place from{5000.0, 10000.0, 2100.0};
  const Place to{-14600.0, 2500.0, 7000.0};
  const Place tangent = from.cross(to).cross(from).normalized();
  const Vector start = std::sqrt(earth / from.norm()) * tangent;
  return {name, false, start, [=](const Vector& u, Vector& r) {
            const auto pull = [](const Place& x) -> Place {
              return -earth / std::pow(x.norm(), 3) * x;
            };
            const double dt = seconds / steps;
            Place x = from;
            Place v = u;
            for (int step = 0; step < steps; ++step) {  // Runge & Kutta's, of fourth order
              const Place a1 = pull(x);
              const Place a2 = pull(x + 0.5 * dt * v);
              const Place a3 = pull(x + 0.5 * dt * v + 0.25 * dt * dt * a1);
              const Place a4 = pull(x + dt * v + 0.5 * dt * dt * a2);
              x += dt * v + dt * dt / 6.0 * (a1 + a2 + a3);
              v += dt / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            }
            r = 1e-3 * (x - to);
            return true;
          }};
}

/// Moles of ten species that hydrazine burns to, and the potentials of their three elements, at the
/// least free energy: logarithms of the moles (White, Johnson & Dantzig 1958, J. Chem. Phys. 28,
/// 751; from the start of Hock & Schittkowski 1981, no. 112).
bool hydrazine(const Vector& x, Vector& r) {
  constexpr std::array<double, 10> energy = {-6.089,  -17.164, -34.054, -5.914,  -24.721,
                                             -14.986, -24.1,   -10.708, -26.662, -22.179};
  constexpr std::array<std::array<double, 3>, 10> atoms = {{{1, 0, 0},
                                                            {2, 0, 0},
                                                            {2, 0, 1},
                                                            {0, 1, 0},
                                                            {0, 2, 0},  // H H2 H2O N N2
                                                            {1, 1, 0},
                                                            {0, 1, 1},
                                                            {0, 0, 1},
                                                            {0, 0, 2},
                                                            {1, 0, 1}}};  // NH NO O O2 OH
  if (!(x.head(10).minCoeff() > 0.0)) return false;
  const double total = x.head(10).sum();
  r.tail(3) = -Eigen::Vector3d(2.0, 1.0, 1.0);
  for (int i = 0; i < 10; ++i) {
    const Eigen::Map<const Eigen::Vector3d> contains(atoms[static_cast<std::size_t>(i)].data());
    r[i] = energy[static_cast<std::size_t>(i)] + std::log(x[i] / total) + contains.dot(x.tail(3));
    r.tail(3) += x[i] * contains;
  }
  return true;
}

Problem hydrazine_of(const char* name) {
  Vector start(13);
  start << Vector::Constant(10, 0.1), Vector::Zero(3);
  return {name, false, start, hydrazine};
}

}  // namespace

void add_fourth_set(std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  add_fourth_grids(problems);
  problems.push_back(cragg_levy_of("Cragg-Levy", 25));
  problems.push_back({"two tanks", false, Vector::Zero(2), two_tanks});
  problems.push_back({"Cournot", false, Vector::Constant(5, 10.0), cournot});
  problems.push_back(orbit("orbit"));
  problems.push_back(hydrazine_of("hydrazine"));
  add_fourth_mechanics(problems);
  problems.push_back(noisy(karman_plate("", 8, 5000.0), "noisy plate", false, 1e-6));
  problems.push_back(noisy(two_walls("", 12), "noisy walls", false, 1e-6));
  problems.push_back(in_other_units(tubular_reactor("", 40), "reactor, 10 decades", false, 10.0));
  problems.push_back(in_other_units(hexagons("", 10), "hexagons, 16 decades", false, 16.0));
  for (std::size_t i = before; i < problems.size(); ++i) problems[i].set = 4;
}

}  // namespace peers

#include "third_set.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace peers {
namespace {

/// Combustion of propane in air, ten products by five elements (Meintjes & Morgan 1990, ACM TOMS
/// 16, 143; MINPACK-2).
bool propane(const Vector& x, Vector& r) {
  constexpr double air = 10.0;
  const double p = 40.0;
  const double r5 = 1.930e-1, r6 = 2.597e-3 / std::sqrt(p), r7 = 3.448e-3 / std::sqrt(p);
  const double r8 = 1.799e-5 / p, r9 = 2.155e-4 / std::sqrt(p), r10 = 3.846e-5 / p;
  const double water = x[1] * x[2] * x[2], hydroxyl = r7 * x[1] * x[2], oxide = r9 * x[1] * x[3];
  r[0] = x[0] * x[1] + x[0] - 3.0 * x[4];
  r[1] = 2.0 * x[0] * x[1] + x[0] + 2.0 * r10 * x[1] * x[1] + water + hydroxyl + oxide + r8 * x[1] -
         air * x[4];
  r[2] = 2.0 * water + hydroxyl + 2.0 * r5 * x[2] * x[2] + r6 * x[2] - 8.0 * x[4];
  r[3] = oxide + 2.0 * x[3] * x[3] - 4.0 * air * x[4];
  r[4] = x[0] * x[1] + x[0] + r10 * x[1] * x[1] + water + hydroxyl + oxide + r8 * x[1] +
         r5 * x[2] * x[2] + r6 * x[2] + x[3] * x[3] - 1.0;
  return true;
}

/// Two dipoles in a heart by what electrodes around it see: sums of moments of p q^k, p = (a, c)
/// and (b, d), q = (t, v) and (u, w) as complex numbers (Nelson & Hodgkin 1981; experiment 791226
/// of Dennis, Gay & Vu 1985 in MINPACK-2).
bool heart_dipole(const Vector& x, Vector& r) {
  using Complex = std::complex<double>;
  constexpr std::array<Complex, 4> seen = {Complex{-0.69, -0.044}, Complex{-1.57, -1.31},
                                           Complex{-2.65, 2.0}, Complex{-12.6, 9.48}};
  const Complex q = {x[4], x[6]}, qq = {x[5], x[7]};
  Complex p = {x[0], x[2]}, pp = {x[1], x[3]};
  for (int k = 0; k < 4; ++k) {
    const Complex lack = p + pp - seen[static_cast<std::size_t>(k)];
    r[2 * k] = lack.real();
    r[2 * k + 1] = lack.imag();
    p *= q;
    pp *= qq;
  }
  return true;
}

/// Partial oxidation of methane at 20 atmospheres: mole fractions, oxygen per methane, moles
/// (Carnahan, Luther & Wilkes 1969).
bool methane(const Vector& x, Vector& r) {
  r[0] = 0.5 * x[0] + x[1] + 0.5 * x[2] - x[5] / x[6];
  r[1] = x[2] + x[3] + 2.0 * x[4] - 2.0 / x[6];
  r[2] = x[0] + x[1] + x[4] - 1.0 / x[6];
  r[3] = -28837.0 * x[0] - 139009.0 * x[1] - 78213.0 * x[2] + 18927.0 * x[3] + 8427.0 * x[4] +
         13492.0 / x[6] - 10690.0 * x[5] / x[6];
  r[4] = x[0] + x[1] + x[2] + x[3] + x[4] - 1.0;
  r[5] = 400.0 * x[0] * x[3] * x[3] * x[3] - 1.7837e5 * x[2] * x[4];
  r[6] = x[0] * x[2] - 2.6058 * x[1] * x[3];
  return true;
}

/// Cosines and sines of four joints of a robot with six (Morgan & Shapiro 1987, ACM TOMS 13, 152;
/// Floudas et al. 1999, problem 14.1.6).
bool robot(const Vector& x, Vector& r) {
  r[0] = 0.004731 * x[0] * x[2] - 0.3578 * x[1] * x[2] - 0.1238 * x[0] + x[6] - 0.001637 * x[1] -
         0.9338 * x[3] - 0.3571;
  r[1] = 0.2238 * x[0] * x[2] + 0.7623 * x[1] * x[2] + 0.2638 * x[0] - x[6] - 0.07745 * x[1] -
         0.6734 * x[3] - 0.6022;
  r[2] = x[5] * x[7] + 0.3578 * x[0] + 0.004731 * x[1];
  r[3] = -0.7623 * x[0] + 0.2238 * x[1] + 0.3461;
  for (int joint = 0; joint < 4; ++joint) {
    r[4 + joint] = x[2 * joint] * x[2 * joint] + x[2 * joint + 1] * x[2 * joint + 1] - 1.0;
  }
  return true;
}

/// Exponentials and sines of neighbours (Toint 1986, Math. Comput. 46, 175; "Trigexp 1" of Lukšan &
/// Vlček 1998): ones are a root.
bool trigexp(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  r.setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (i + 1 < n) {
      r[i] += 3.0 * x[i] * x[i] * x[i] + 2.0 * x[i + 1] - 5.0 +
              std::sin(x[i] - x[i + 1]) * std::sin(x[i] + x[i + 1]);
    }
    if (i > 0) r[i] += 4.0 * x[i] - x[i - 1] * std::exp(x[i - 1] - x[i]) - 3.0;
  }
  return true;
}

Problem trigexp_of(const char* name, int n) {
  Problem problem{name, false, Vector::Zero(n), trigexp};
  problem.root = Vector::Ones(n);
  return problem;
}

/// Voltages of the IEEE 14-bus network, from a flat start: angles of all buses but the first, then
/// the magnitudes that no generator holds (University of Washington, Power Systems Test Case
/// Archive; as MATPOWER has it).
Problem load_flow(const char* name) {
  struct Bus {
    double active, reactive;  // what flows in, per unit; reactive for buses without a generator
    double held;              // magnitude, 0: unknown
  };
  struct Branch {
    int from, to;
    double r, x, charging, tap;
  };
  static constexpr std::array<Bus, 14> buses = {{{0.0, 0.0, 1.06},
                                                 {0.183, 0.0, 1.045},
                                                 {-0.942, 0.0, 1.01},
                                                 {-0.478, 0.039, 0.0},
                                                 {-0.076, -0.016, 0.0},
                                                 {-0.112, 0.0, 1.07},
                                                 {0.0, 0.0, 0.0},
                                                 {0.0, 0.0, 1.09},
                                                 {-0.295, -0.166, 0.0},
                                                 {-0.09, -0.058, 0.0},
                                                 {-0.035, -0.018, 0.0},
                                                 {-0.061, -0.016, 0.0},
                                                 {-0.135, -0.058, 0.0},
                                                 {-0.149, -0.05, 0.0}}};
  constexpr std::array<Branch, 20> branches = {
      {{1, 2, 0.01938, 0.05917, 0.0528, 1.0}, {1, 5, 0.05403, 0.22304, 0.0492, 1.0},
       {2, 3, 0.04699, 0.19797, 0.0438, 1.0}, {2, 4, 0.05811, 0.17632, 0.034, 1.0},
       {2, 5, 0.05695, 0.17388, 0.0346, 1.0}, {3, 4, 0.06701, 0.17103, 0.0128, 1.0},
       {4, 5, 0.01335, 0.04211, 0.0, 1.0},    {4, 7, 0.0, 0.20912, 0.0, 0.978},
       {4, 9, 0.0, 0.55618, 0.0, 0.969},      {5, 6, 0.0, 0.25202, 0.0, 0.932},
       {6, 11, 0.09498, 0.1989, 0.0, 1.0},    {6, 12, 0.12291, 0.25581, 0.0, 1.0},
       {6, 13, 0.06615, 0.13027, 0.0, 1.0},   {7, 8, 0.0, 0.17615, 0.0, 1.0},
       {7, 9, 0.0, 0.11001, 0.0, 1.0},        {9, 10, 0.03181, 0.0845, 0.0, 1.0},
       {9, 14, 0.12711, 0.27038, 0.0, 1.0},   {10, 11, 0.08205, 0.19207, 0.0, 1.0},
       {12, 13, 0.22092, 0.19988, 0.0, 1.0},  {13, 14, 0.17093, 0.34802, 0.0, 1.0}}};
  using Complex = std::complex<double>;
  Eigen::MatrixXcd admittance = Eigen::MatrixXcd::Zero(14, 14);
  admittance(8, 8) = Complex(0.0, 0.19);  // a capacitor
  for (const Branch& branch : branches) {
    const Complex series = 1.0 / Complex(branch.r, branch.x);
    const Complex own = series + Complex(0.0, 0.5 * branch.charging);
    const int a = branch.from - 1, b = branch.to - 1;
    admittance(a, a) += own / (branch.tap * branch.tap);
    admittance(b, b) += own;
    admittance(a, b) -= series / branch.tap;
    admittance(b, a) -= series / branch.tap;
  }
  Vector start(22);
  start << Vector::Zero(13), Vector::Ones(9);
  return {name, false, start, [=](const Vector& u, Vector& r) {
            Eigen::VectorXcd voltage(14);
            Eigen::Index magnitude = 13;
            for (int i = 0; i < 14; ++i) {
              const double held = buses[static_cast<std::size_t>(i)].held;
              voltage[i] = std::polar(1.0, i == 0 ? 0.0 : u[i - 1]);
              voltage[i] *= held > 0.0 ? held : u[magnitude++];
            }
            const Eigen::VectorXcd current = admittance * voltage;
            Eigen::Index row = 13;
            for (int i = 1; i < 14; ++i) {
              const Bus& bus = buses[static_cast<std::size_t>(i)];
              const Complex power = voltage[i] * std::conj(current[i]);
              r[i - 1] = power.real() - bus.active;
              if (bus.held == 0.0) r[row++] = power.imag() - bus.reactive;
            }
            return true;
          }};
}

/// 0 <= x, 0 <= G(x), x G(x) = 0 by Fischer & Burmeister's sqrt(x^2 + G^2) - x - G (Kojima & Shindo
/// 1986, J. Oper. Res. Soc. Jpn. 29, 352): (1, 0, 3, 0) and, degenerate, (sqrt(3/2), 0, 0, 1/2).
bool kojima_shindo(const Vector& x, Vector& r) {
  const double a = x[0], b = x[1], c = x[2], d = x[3];
  const std::array<double, 4> G = {3.0 * a * a + 2.0 * a * b + 2.0 * b * b + c + 3.0 * d - 6.0,
                                   2.0 * a * a + a + b * b + 10.0 * c + 2.0 * d - 2.0,
                                   3.0 * a * a + a * b + 2.0 * b * b + 2.0 * c + 9.0 * d - 9.0,
                                   a * a + 3.0 * b * b + 2.0 * c + 3.0 * d - 3.0};
  for (int i = 0; i < 4; ++i) {
    const double g = G[static_cast<std::size_t>(i)];
    r[i] = std::hypot(x[i], g) - x[i] - g;
  }
  return true;
}

/// The problem as a program in single precision would pose it.
Problem in_single_precision(Problem problem) {
  problem.tolerance = 1e-4;
  problem.residual = [exact = problem.residual](const Vector& u, Vector& r) {
    if (!exact(u.cast<float>().cast<double>(), r)) return false;
    r = r.cast<float>().cast<double>().eval();
    return true;
  };
  return problem;
}

}  // namespace

void add_third_set(std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  add_third_grids(problems);
  problems.push_back({"propane", false, vector({0.005, 0.005, 0.05, 0.5, 0.05}), propane});
  problems.push_back({"heart dipole", false,
                      vector({-0.3, -0.39, 0.3, -0.344, -1.2, 2.69, 1.59, -1.5}), heart_dipole});
  problems.push_back({"methane", false, vector({0.5, 0.0, 0.0, 0.5, 0.0, 0.5, 2.0}), methane});
  // Each joint half way between its axes, as in KINSOL's example of this problem.
  problems.push_back({"robot", false, Vector::Constant(8, 0.5 * std::numbers::sqrt2), robot});
  problems.push_back(trigexp_of("trigexp", 100));
  problems.push_back(load_flow("load flow"));
  problems.push_back({"Kojima-Shindo", false, Vector::Zero(4), kojima_shindo});
  problems.back().root = vector({1.0, 0.0, 3.0, 0.0});
  add_third_mechanics(problems);
  problems.push_back(noisy(ornstein_zernike("", 60), "noisy liquid", false, 1e-6));
  problems.push_back(in_single_precision(ginzburg_landau("vortex, single", 12, 0.1)));
  problems.push_back(in_other_units(warm_cavity("", 8, 1e4), "warm cavity, 8 decades", false, 8.0));
  problems.push_back(in_other_units(diode("", 49, 10.0), "diode, 14 decades", false, 14.0));
  for (std::size_t i = before; i < problems.size(); ++i) problems[i].set = 3;
}

}  // namespace peers

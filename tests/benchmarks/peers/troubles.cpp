#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>

#include "problem.hpp"
#include "problems.hpp"

namespace peers {
namespace {

/// A frame of elastoplastic bars, pushed in one step from rest.
Problem truss(const char* name, bool for_tuning, int cells, double push, double hardening) {
  constexpr double yield = 1e-3;
  const auto frame = std::make_shared<jfnk_test::PlasticTruss>(cells, cells, yield, hardening);
  frame->push(push);
  return {name, for_tuning, Vector::Zero(frame->size()),
          [frame](const Vector& u, Vector& r) { return (*frame)(u, r) == jfnk::Evaluation::ok; }};
}

/// A membrane over an obstacle: min(u - obstacle, -Laplace(u) + 2) = 0, in units of each.
Problem obstacle(const char* name, bool for_tuning, int m) {
  const double h = 1.0 / (m + 1.0);
  return {name, for_tuning, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) {
              return i < 0 || j < 0 || i >= m || j >= m ? 0.0 : u[j * m + i];
            };
            for (int j = 0; j < m; ++j) {
              for (int i = 0; i < m; ++i) {
                const double x = (i + 1) * h - 0.5;
                const double y = (j + 1) * h - 0.5;
                const double load = 4.0 * at(i, j) - at(i - 1, j) - at(i + 1, j) - at(i, j - 1) -
                                    at(i, j + 1) + 8.0 * h * h;
                r[j * m + i] = std::min(at(i, j) - (-0.1 - 2.0 * (x * x + y * y)), load);
              }
            }
            return true;
          }};
}

/// A number in [-1, 1] that looks random and depends on the bits of u alone.
double scatter(double u, std::uint64_t seed) {
  std::uint64_t z = std::bit_cast<std::uint64_t>(u) + seed * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  z ^= z >> 31U;
  return 2.0 * static_cast<double>(z >> 11U) * 0x1p-53 - 1.0;
}

/// Deflection of a plate pulled by a voltage: -u'' = lambda / (1 - u)^2; the gap closes at u = 1.
Problem gap(const char* name, bool for_tuning, int n, double lambda) {
  const double h = 1.0 / (n + 1.0);
  return {name, for_tuning, Vector::Constant(n, 0.9), [=](const Vector& u, Vector& r) {
            for (int i = 0; i < n; ++i) {
              const double room = 1.0 - u[i];
              if (!(room > 0.0)) return false;
              r[i] = 2.0 * u[i] - (i > 0 ? u[i - 1] : 0.0) - (i + 1 < n ? u[i + 1] : 0.0) -
                     h * h * lambda / (room * room);
            }
            return true;
          }};
}

/// Diffusion with a reaction u log(u): without a value at u <= 0, NaN as std::log gives it.
Problem logarithm(const char* name, bool for_tuning, int n) {
  const double h = 1.0 / (n + 1.0);
  return {name, for_tuning, Vector::Constant(n, 1e-3), [=](const Vector& u, Vector& r) {
            for (int i = 0; i < n; ++i) {
              const double left = i > 0 ? u[i - 1] : 2.0;
              const double right = i + 1 < n ? u[i + 1] : 0.01;
              r[i] = 2.0 * u[i] - left - right + 50.0 * h * h * u[i] * std::log(u[i]);
            }
            return true;
          }};
}

/// Pressures of pipes in a row with turbulent friction: flow = sign(dp) sqrt(|dp|), leaks sqrt(p).
Problem pipes(const char* name, bool for_tuning, int n) {
  return {name, for_tuning, Vector::Constant(n, 1.0), [=](const Vector& p, Vector& r) {
            const auto flow = [](double dp) { return dp / std::sqrt(std::abs(dp) + 1e-6); };
            for (int i = 0; i < n; ++i) {
              if (!(p[i] >= 0.0)) return false;
              const double left = i > 0 ? p[i - 1] : 4.0;
              r[i] = flow(left - p[i]) - (i + 1 < n ? flow(p[i] - p[i + 1]) : 0.0) -
                     0.05 * std::sqrt(p[i]);
            }
            return true;
          }};
}

}  // namespace

Problem noisy(Problem problem, const char* name, bool for_tuning, double level) {
  problem.name = name;
  problem.for_tuning = for_tuning;
  problem.tolerance = 1e-4;
  problem.root.resize(0);
  problem.residual = [clean = problem.residual, level](const Vector& u, Vector& r) {
    if (!clean(u, r)) return false;
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      r[i] += level * scatter(u[i], static_cast<std::uint64_t>(i));
    }
    return true;
  };
  return problem;
}

Problem in_other_units(Problem problem, const char* name, bool for_tuning, double decades) {
  const Eigen::Index n = problem.start.size();
  problem.name = name;
  problem.for_tuning = for_tuning;
  problem.u_scale.resize(n);
  problem.f_scale.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    problem.u_scale[i] =
        std::pow(10.0, 0.5 * decades * std::sin(1.0 + 2.0 * static_cast<double>(i)));
    problem.f_scale[i] = std::pow(10.0, 0.5 * decades * std::cos(3.0 * static_cast<double>(i)));
  }
  problem.start.array() *= problem.u_scale.array();
  if (problem.root.size() > 0) problem.root.array() *= problem.u_scale.array();
  problem.residual = [plain = problem.residual, us = problem.u_scale, fs = problem.f_scale](
                         const Vector& u, Vector& r) {
    if (!plain(u.cwiseQuotient(us), r)) return false;
    r.array() *= fs.array();
    return true;
  };
  return problem;
}

void add_troubles(std::vector<Problem>& problems) {
  problems.push_back(truss("truss", true, 12, 0.02, 0.05));
  problems.push_back(truss("truss, soft", false, 14, 0.03, 0.01));
  problems.push_back(obstacle("obstacle", false, 24));
  std::vector<Problem> grids;
  add_grids(grids);
  std::vector<Problem> classics;
  add_classics(classics);
  const auto named = [](const std::vector<Problem>& list, const std::string& name) {
    for (const Problem& problem : list) {
      if (problem.name == name) return problem;
    }
    throw std::logic_error("no problem " + name);
  };
  problems.push_back(noisy(named(grids, "H-equation 0.9"), "noisy H-equation", true, 1e-6));
  problems.push_back(noisy(named(classics, "Broyden banded"), "noisy Broyden", false, 1e-5));
  problems.push_back(in_other_units(named(classics, "Broyden tridiagonal"), "8 decades", true, 8));
  problems.push_back(in_other_units(named(classics, "integral equation"), "16 decades", false, 16));
  problems.push_back(gap("closing gap", true, 60, 1.2));
  problems.push_back(logarithm("logarithm", false, 60));
  problems.push_back(pipes("pipes", true, 40));
}

}  // namespace peers

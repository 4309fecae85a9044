#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace peers {

using Vector = Eigen::VectorXd;

/// A system F(u) = 0 that every solver is given alike.
struct Problem {
  std::string name;
  /// Constants of libjfnk may be chosen by looking at these; the others report what came of it.
  bool for_tuning = true;
  Vector start;
  /// F(u) into r; false where F has no value.
  std::function<bool(const Vector& u, Vector& r)> residual;
  /// Solved when ||F / f_scale|| <= tolerance ||F(start) / f_scale||.
  double tolerance = 1e-6;
  /// Typical sizes of unknowns and residuals, for solvers that take them; empty: ones.
  Vector u_scale = {};
  Vector f_scale = {};
};

/// Partial differential equations on grids.
void add_grids(std::vector<Problem>& problems);
/// Moré, Garbow & Hillstrom 1981, and other systems of few unknowns.
void add_classics(std::vector<Problem>& problems);
/// Kinks, noise, units far apart, residuals that end somewhere.
void add_troubles(std::vector<Problem>& problems);

inline std::vector<Problem> all_problems() {
  std::vector<Problem> problems;
  add_grids(problems);
  add_classics(problems);
  add_troubles(problems);
  return problems;
}

}  // namespace peers

#pragma once

#include <Eigen/Core>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace peers {

using Vector = Eigen::VectorXd;

/// A system F(u) = 0 that every solver is given alike.
struct Problem {
  std::string name;
  /// Of the first set's half that constants of libjfnk were first chosen on.
  bool for_tuning = true;
  Vector start;
  /// F(u) into r; false where F has no value.
  std::function<bool(const Vector& u, Vector& r)> residual;
  /// Solved when ||F / f_scale|| <= tolerance ||F(start) / f_scale||.
  double tolerance = 1e-6;
  /// Typical sizes of unknowns and residuals, for solvers that take them; empty: ones.
  Vector u_scale = {};
  Vector f_scale = {};
  /// The set of problems: the first, of which some are for tuning, or a later one.
  int set = 1;
  /// A root, where one is known.
  Vector root = {};
};

/// The name of the set a problem belongs to.
inline const char* set_of(const Problem& problem) {
  if (problem.set == 5) return "tuning 2";
  if (problem.set == 4) return "held out 4";
  if (problem.set == 3) return "held out 3";
  if (problem.set == 2) return "held out 2";
  return problem.for_tuning ? "tuning" : "held out";
}

inline Vector vector(std::initializer_list<double> values) {
  return Eigen::Map<const Vector>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

/// The problem with noise of a given size added to every component, under another name.
Problem noisy(Problem problem, const char* name, bool for_tuning, double level);
/// The problem in units that spread over the given decades, rows and columns unlike.
Problem in_other_units(Problem problem, const char* name, bool for_tuning, double decades);

/// Partial differential equations on grids.
void add_grids(std::vector<Problem>& problems);
/// Moré, Garbow & Hillstrom 1981, and other systems of few unknowns.
void add_classics(std::vector<Problem>& problems);
/// Kinks, noise, units far apart, residuals that end somewhere.
void add_troubles(std::vector<Problem>& problems);
/// Problems of all these kinds, written when libjfnk's constants had first been chosen.
void add_second_set(std::vector<Problem>& problems);
/// Again of all these kinds, written after libjfnk's constants and rules had been judged by the
/// second set, by somebody who did not run any of the solvers compared on them.
void add_third_set(std::vector<Problem>& problems);
/// The same once more, written when the results of the third set were known.
void add_fourth_set(std::vector<Problem>& problems);
/// Lattices with eliminated unknowns and contact beams, written to mend what libjfnk lacked there.
void add_fifth_set(std::vector<Problem>& problems);

/// All of them; from starts perturbed by up to 1e-3 if the environment has a PEERS_SEED.
std::vector<Problem> all_problems();

}  // namespace peers

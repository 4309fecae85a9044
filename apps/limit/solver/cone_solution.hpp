#pragma once

#include <Eigen/Core>
#include <string>

namespace limit::solver {

/// How the cones are put before a solver, and which one that is.
enum class ConeForm {
  cones,       // as they are, before an interior-point method for cones (interior_point.hpp)
  inequality,  // before Ipopt, (d^2 + t^2) / s - s <= 0 and s >= 0, with s = strength - slope p
  quadratic,   // before Ipopt, d^2 + t^2 - s^2 <= 0 and s >= 0: the fall-back of `inequality`
  barrier,     // before Ipopt, a logarithmic barrier in the objective, weakened stage by stage
};

struct SolverOptions {
  ConeForm form = ConeForm::cones;
  double tolerance = 1e-8;     // Ipopt's, in the scaled problem
  int max_iterations = 300;    // over all stages
  double max_seconds = 600.0;  // of processor time, over all stages
  double gap = 1e-4;           // barrier: last duality gap over the objective's scale
  double cone_gap = 1e-5;      // cones: likewise
  bool wants_interior = true;  // cones: multipliers of an early stage, well inside
};

/// How the solver ended.
enum class SolverStatus {
  solved,
  acceptable,  // to a looser tolerance
  capped,      // by the limit on iterations
  timed_out,   // by the limit on time
  failed,      // restoration failed, a step could not be computed, ...
};

struct ConeSolution {
  Eigen::VectorXd variables;
  Eigen::VectorXd multipliers;           // of the equations
  Eigen::VectorXd interior_multipliers;  // of an early stage, well inside; not with inequalities
  SolverStatus status = SolverStatus::failed;
  std::string message;  // the solver's own word for it
  int iterations = 0;
  double work = 0.0;  // operations, roughly: what it cost, the same each time
};

}  // namespace limit::solver

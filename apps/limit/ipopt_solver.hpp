#pragma once

#include <Eigen/Core>
#include <string>

#include "limit/cone_program.hpp"

namespace limit {

/// How the cones are put before Ipopt.
enum class ConeForm {
  inequality,  // (d^2 + t^2) / s - s <= 0 and s >= 0, with s = strength - slope p
  quadratic,   // d^2 + t^2 - s^2 <= 0 and s >= 0: the fall-back of `inequality`
  barrier,     // a logarithmic barrier in the objective, weakened stage by stage
};

struct SolverOptions {
  ConeForm form = ConeForm::inequality;
  double tolerance = 1e-8;     // Ipopt's, in the scaled problem
  int max_iterations = 300;    // of Ipopt, over all stages
  double max_seconds = 600.0;  // of processor time, over all stages
  double gap = 1e-4;           // barrier: last duality gap over the objective's scale
};

/// How the solver ended.
enum class SolverStatus {
  solved,
  acceptable,  // to Ipopt's looser tolerance
  stopped,     // by the cap on iterations or time
  failed,      // restoration failed, a step could not be computed, ...
};

struct ConeSolution {
  Eigen::VectorXd variables;
  Eigen::VectorXd multipliers;           // of the equations
  Eigen::VectorXd interior_multipliers;  // barrier: those of an early stage, well inside
  SolverStatus status = SolverStatus::failed;
  std::string message;  // Ipopt's own word for it
  int iterations = 0;
};

/// Solves the program with Ipopt (Waechter & Biegler 2006), which sees it with columns scaled by
/// the cones and rows scaled to a largest entry of one. The best point reached is returned whatever
/// the status; it need not satisfy anything exactly.
[[nodiscard]] ConeSolution solve(const ConeProgram& program, const SolverOptions& options);

}  // namespace limit

#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

namespace jfnk {

/// Why a solve ended. Unless said otherwise u holds the iterate of the lowest ||F|| met.
enum class Status {
  converged,             ///< tolerances met; F was last evaluated at the returned u
  max_iterations,        ///< the schedule of iterations was used up; u updated if it improved
  evaluation_limit,      ///< max_evaluations was used up; u updated if it improved
  line_search_failed,    ///< no acceptable trial along the Newton direction; u updated if improved
  stagnated,             ///< Newton steps hardly lower ||F|| any more; u updated if it improved
  krylov_stalled,        ///< the linear solve gave no direction; u updated if improved
  linearisation_failed,  ///< the residual's own `linearise` declined; u updated if improved
  multisecant_stalled,   ///< multisecant alone lost its patience; u updated if it improved
  out_of_domain_at_start,  ///< F could not be evaluated at the first u; u is unchanged
  local_minimum,  ///< no direction lowers ||F||: J^T F = 0 but F is not; u updated if improved
  in_progress,    ///< `step` has not yet come to an end
  stopped,        ///< the residual or the observer asked to stop; u updated if improved
  noise_floor,    ///< ||F|| is at the noise or rounding of F, above the tolerance; u updated
  not_started,    ///< there has been no solve
  threw           ///< a callable threw an exception; `solution` is the best point before that
};

/// What the Newton step that failed at the lowest ||F|| showed.
enum class Trouble {
  none,            ///< no step failed
  flat,            ///< J v = 0 for all v tried: F does not change with u
  singular,        ///< the Krylov space is exhausted, and nothing in it lowers ||F + J du||
  krylov_capped,   ///< krylov.max_iterations products were too few to lower ||F + J du||
  action_failed,   ///< J v cannot be evaluated
  minimum,         ///< ||F|| falls for a tiny part of the step only, or rises on both sides
  broken_promise,  ///< F does not fall as J v promises, however short the step
  domain_edge,     ///< F has no value along the step, however short
  short_steps,     ///< steps have become shorter than the rounding of u
  indefinite       ///< J or P is not positive definite, as conjugate gradients need them
};

/// The name of a status as written in the enum.
[[nodiscard]] std::string_view to_string(Status status);

/// The name of a trouble as written in the enum.
[[nodiscard]] std::string_view to_string(Trouble trouble);

/// Which part of the strategy made an iteration.
enum class Phase { start, newton, multisecant, pseudo_transient };

/// The name of a phase as written in the enum.
[[nodiscard]] std::string_view to_string(Phase phase);

/// One line of the history: the state after one nonlinear iteration.
struct Iteration {
  int index = 0;  ///< 0 is the first u
  Phase phase = Phase::start;
  double residual_norm = 0.0;       ///< ||F(u)||
  double reference_norm = 0.0;      ///< scale of the relative tolerance at u
  double best_residual_norm = 0.0;  ///< lowest ||F|| so far
  double step_norm = 0.0;           ///< ||du|| of the step taken
  double step_length = 0.0;         ///< lambda of the step taken; below 1 if it was cut
  double forcing = 0.0;             ///< Newton: eta asked
  double linear_residual = 0.0;     ///< Newton: ||J du + F|| / ||F|| reached
  int krylov_iterations = 0;        ///< Newton: columns built
  int secant_pairs = 0;             ///< multisecant: pairs used
  int evaluations = 0;              ///< residuals + Jacobian actions so far
};

/// Work done, by purpose.
struct Counts {
  int start = 0;                  ///< residuals at the first u
  int newton_trials = 0;          ///< residuals at full Newton steps
  int line_search = 0;            ///< residuals at cut steps, of Newton and of multisecant
  int multisecant = 0;            ///< residuals at full multisecant steps
  int pseudo_transient = 0;       ///< residuals at pseudo-transient steps
  int noise = 0;                  ///< residuals spent on measuring the noise of F
  int difference_actions = 0;     ///< residuals spent on J v
  int user_actions = 0;           ///< calls of the residual's `apply_jacobian`
  int linearisations = 0;         ///< calls of the residual's `linearise`
  int preconditioner = 0;         ///< calls of the preconditioner's `apply`
  int preconditioner_setups = 0;  ///< calls of the preconditioner's `setup`
  int learning = 0;               ///< of the evaluations above, those that went into learning the
                                  ///< Jacobian and renewing it

  /// Residual evaluations of every purpose.
  [[nodiscard]] int residuals() const {
    return start + newton_trials + line_search + multisecant + pseudo_transient + noise +
           difference_actions;
  }
  /// What `Options::max_evaluations` bounds: residual evaluations and Jacobian actions.
  [[nodiscard]] int total() const { return residuals() + user_actions; }
};

/// One component of F.
struct Component {
  Eigen::Index index = -1;
  double residual = 0.0;  ///< F_i, over f_scale_i if there are scales
};

/// What happened, why, and at what cost.
struct Report {
  Status status = Status::not_started;
  std::string reason = "no solve was started";  ///< one sentence with numbers, and what to try
  double residual_norm = 0.0;                   ///< ||F|| at the returned u; NaN if never evaluated
  double initial_residual_norm = 0.0;           ///< ||F(u0)||; NaN if never evaluated
  double reference_norm = 0.0;        ///< scale of the relative tolerance at the returned u
  double tolerance = 0.0;             ///< ||F|| that was asked: max(absolute, relative * reference)
  Eigen::Index worst_component = -1;  ///< of the largest |F_i|, or of the first that is not
                                      ///< finite at the start; -1 if unknown
  std::vector<Component> worst;       ///< the three largest |F_i| of a failure, largest first
  int newton_iterations = 0;
  int multisecant_iterations = 0;
  int pseudo_transient_steps = 0;
  int krylov_iterations = 0;
  double last_linear_residual = 0.0;  ///< ||F + J du|| / ||F|| of the last linear solve
  double last_forcing = 0.0;          ///< what was asked of it
  double measured_noise = 0.0;        ///< ||noise of F||, if it was measured; else 0
  Trouble trouble = Trouble::none;
  Counts counts;
  std::vector<Iteration> history;  ///< the first entry is the first u

  /// True if and only if the tolerances are met at the returned u.
  [[nodiscard]] bool converged() const { return status == Status::converged; }
};

}  // namespace jfnk

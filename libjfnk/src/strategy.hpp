#pragma once

#include "broyden_memory.hpp"
#include "course.hpp"
#include "evaluator.hpp"
#include "jfnk/bicgstab.hpp"
#include "jfnk/conjugate_gradients.hpp"
#include "jfnk/gmres.hpp"
#include "jfnk/solver.hpp"
#include "secant_memory.hpp"

namespace jfnk::detail {

/// Vectors that live from solve to solve.
struct Workspace {
  Iterate base;   // where the stage stands
  Iterate trial;  // where it looks
  Iterate best;   // lowest norm so far
  Iterate first;  // where the solve began
  Iterate aside;  // of a round without the preconditioner: its start, then what it came to
  Vector step;
  Vector direction;
  Vector setup_point;  // of the preconditioner
  EvaluatorVectors evaluator;
  EvaluatorState evaluator_state;
  Gmres gmres;
  BiCGStab bicgstab;
  ConjugateGradients conjugate_gradients;
  SecantMemory secants;
  BroydenMemory broyden;
  Vector by_least_squares;  // H F at base by secants
  Vector by_broyden;        // and by broyden
  Vector image;
  Vector preconditioned;         // P F at base
  Vector preconditioned_before;  // and where it was before
};

/// One solve: the problem, the choices, the workspace and the record, shared by the stages.
struct Solve {
  const Options& options;
  Evaluator& evaluator;
  const ObserverRef& observer;
  Workspace& work;
  Course& course;
  Report& report;

  /// Adds a line to the history and shows it; false if the observer asks to stop.
  bool record(Iteration line, const Iterate& at) const;
  /// Makes base, just reached by a step of the given norm, the solver's own: tells the residual,
  /// keeps it if it is the best, writes the line.
  [[nodiscard]] Ending accept_base(const Iteration& line) const;
  /// Goes on from where the round without the preconditioner began; what it came to stays aside.
  void undo_round() const;
  /// Goes back to the best point.
  void return_to_best() const;
  /// Keeps what a step that failed at work.base showed, unless one failed at a lower ||F||.
  void note_trouble(Trouble trouble) const;
  /// Evaluations so far.
  [[nodiscard]] int evaluations() const { return report.counts.total(); }
};

/// The linear system of a Newton or pseudo-transient step: (J + shift I) du = -F at work.base.
struct LinearSolution {
  Ending ending = Ending::go_on;
  bool gmres = false;  ///< work.gmres knows the space
};
[[nodiscard]] LinearSolution find_direction(Solve& solve, double eta, double shift,
                                            Iteration& line);

/// Shortens work.direction until ||F|| falls enough; the accepted point becomes work.base.
[[nodiscard]] Ending globalise(Solve& solve, bool gmres, Iteration& line);

/// Whether the noise has still to be measured if anything looks like it.
[[nodiscard]] bool may_measure_noise(const Solve& solve);

/// Measures the noise of F near work.best and sets b by it; false if that told nothing new.
/// @param[out] ending  noise_floor if there is nothing to be had below it
[[nodiscard]] bool adapt_to_noise(Solve& solve, Ending& ending);

/// Whether an F that did not change over the length of a difference does over a longer way: one
/// that is computed in single precision, or whose unknowns are large. One residual.
[[nodiscard]] bool changes_farther_off(Solve& solve);

/// Whether the least squares of the multisecant stages are in the norm of P F.
[[nodiscard]] bool in_preconditioned_norm(const Solve& solve);

/// Whether P y is kept besides each y of a pair: P is then applied to F alone.
[[nodiscard]] bool keeps_images(const Solve& solve);

/// One iteration of each stage.
[[nodiscard]] Ending multisecant_step(Solve& solve);
[[nodiscard]] Ending newton_step(Solve& solve);
[[nodiscard]] Ending pseudo_transient_step(Solve& solve);

/// The beginning of each stage, from the best point.
void begin_multisecant(Solve& solve);
void begin_newton(Solve& solve, int steps);
/// The same from the first point, by line searches.
void begin_newton_afresh(Solve& solve, int steps);
void begin_pseudo_transient(Solve& solve);

/// Whether Newton steps are taken whole.
[[nodiscard]] bool by_full_steps(const Solve& solve);

/// Begins full steps from the first point if the last Newton step was cut short before anything has
/// failed and the caller's preconditioner can be set up at each; watched closely.
void try_full_steps_early(Solve& solve);
/// The same among the rescues, with any factors that can be had anew; false if it was tried.
[[nodiscard]] bool try_full_steps_amid_rescues(Solve& solve);
/// The same as the last rescue, watched as the options say.
[[nodiscard]] bool try_full_steps_at_last(Solve& solve);

/// The rounds of multisecant and Newton from the best point, remembering nothing.
void begin_rounds(Solve& solve);

/// Whether it is time to learn the Jacobian.
[[nodiscard]] bool wants_to_learn(const Solve& solve);
/// Learns it and begins the rounds anew with its factors, or goes on as before.
[[nodiscard]] Ending learn(Solve& solve);
/// Factors of J + shift I about work.base for those in use.
/// @param[out] usable  false if they are singular, or F has no value where it is needed
[[nodiscard]] Ending renew_learnt_jacobian(Solve& solve, double shift, bool& usable);
/// Makes the learnt Jacobian the preconditioner.
void use_learnt_jacobian(Workspace& work, const Options& options);

/// Begins the first stage.
void begin_schedule(Solve& solve);
/// One iteration of the present stage and the choice of the next; go_on unless the solve ends.
[[nodiscard]] Ending advance(Solve& solve);

}  // namespace jfnk::detail
